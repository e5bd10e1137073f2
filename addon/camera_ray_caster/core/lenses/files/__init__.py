"""One module for each format of lens files: how it is told, and its text to a ``Prescription``."""

from . import isetcam, optical_bench, optiland, pbrt, rayoptics, zemax

MODULES = optical_bench, isetcam, rayoptics, optiland, zemax, pbrt
READERS = tuple((module.recognizes, module.read) for module in MODULES)
"""(recognizes(text, path), read(text, name)) of each format, the most specific first."""
