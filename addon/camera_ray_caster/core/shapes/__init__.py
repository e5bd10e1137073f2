"""The shapes, one file each: a kernel and uv. A new shape is its file and one word in SHAPES."""

from __future__ import annotations

from . import plane, sphere
from .in_camera import Placed, place

SHAPES = (sphere, plane)
"""Every shape: a module with ``KINDS``, ``view``, ``intersect`` and ``uv``."""

SHAPE_OF_KIND = {kind: shape for shape in SHAPES for kind in shape.KINDS}

__all__ = ["SHAPES", "SHAPE_OF_KIND", "Placed", "place"]
