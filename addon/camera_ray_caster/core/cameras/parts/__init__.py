"""Code that several camera models share."""
