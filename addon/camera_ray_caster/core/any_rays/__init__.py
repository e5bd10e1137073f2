"""Rays that are given as arrays, not by a camera: their nearest hits, all hits, and what lies between two points."""
