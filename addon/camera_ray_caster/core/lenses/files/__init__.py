"""One module for each format of lens files: how it is told, and its text to a ``Prescription``."""

from . import isetcam, optical_bench, pbrt, rayoptics, zemax

READERS = tuple((module.recognizes, module.read) for module in (optical_bench, isetcam, rayoptics, zemax, pbrt))
"""(recognizes(text, path), read(text, name)) of each format, the most specific first."""
