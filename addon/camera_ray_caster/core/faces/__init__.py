"""A camera's picture as a warp of a few perspective pictures from its eye."""
