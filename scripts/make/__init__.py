"""What the example scenes are made of."""
