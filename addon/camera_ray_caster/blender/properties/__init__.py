"""The add-on's settings, which are stored in a .blend."""
