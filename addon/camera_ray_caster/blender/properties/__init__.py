"""What the add-on stores in a .blend."""
