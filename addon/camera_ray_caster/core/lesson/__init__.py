"""The lesson of a pixel: from its place in the picture to its color, each step with its formula and its numbers."""
