"""Camera and shapes over time, from a few evaluations of the scene."""
