"""Annotations of pictures for machine learning: boxes, masks and key points."""
