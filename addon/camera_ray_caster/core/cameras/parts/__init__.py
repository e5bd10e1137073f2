"""What several camera models share."""
