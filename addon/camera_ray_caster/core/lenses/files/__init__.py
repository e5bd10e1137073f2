"""One module for each format of lens files: how it is told, and its text to a ``Prescription``."""

from . import pbrt

READERS = ((pbrt.recognizes, pbrt.read),)
"""(recognizes(text, path), read(text, name)) of each format, the most specific first."""
