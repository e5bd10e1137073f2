"""The plan of a cast: what this camera, these shapes and these passes need, decided before any ray is cast."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .camera import Camera
from .records import INFINITE_PLANE, InputError, Shapes
from .shading import SHADINGS
from .shapes import SHAPES, Placed, place

TILE_PIXELS = 1 << 16
"""Pixels of a tile: its float64 temporaries stay in a core's cache."""

KIND_NAMES = ("sphere", "plane", "infinite plane")


@dataclass(frozen=True)
class Plan:
    """What the cast does. ``visible`` lists the shapes that some pixel may see, kind by kind; others cost nothing."""

    passes: tuple[str, ...]
    placed: Placed
    visible: np.ndarray
    """(m,) rows of the shapes, sorted by kind."""
    bounds: np.ndarray
    """(m, 4) int: x0, x1, y0, y1 in the render window, x1 and y1 not included."""
    tile_rows: int
    unseen: int
    """Shapes that no pixel can see."""
    missing_kinds: tuple[str, ...]
    """Kinds of shape whose code does not run."""
    spare_passes: tuple[str, ...]
    """Passes that were not asked for."""
    shading: str

    def left_out(self) -> list[str]:
        """Return what is not done, in words, for the report."""
        lines = []
        if self.unseen:
            lines.append(f"{self.unseen} of {self.unseen + len(self.visible)} shapes: no pixel can see them")
        if self.missing_kinds:
            lines.append(f"kernels of {', '.join(self.missing_kinds)}: no such shape is in view")
        if self.spare_passes:
            lines.append(f"passes {', '.join(self.spare_passes)}: not asked for")
        return lines


def make_plan(camera: Camera, shapes: Shapes, passes: Sequence[str], known: Sequence[str], shading: str, cull: bool) -> Plan:
    """Return the plan; InputError names an unknown pass and those that there are. Without ``cull`` all is tested."""
    unknown = [name for name in passes if name not in known]
    if unknown:
        raise InputError(f"no pass is called {', '.join(map(repr, unknown))}: choose from {', '.join(known)}")
    if shading not in SHADINGS:
        raise InputError(f"no shading is called {shading!r}: choose from {', '.join(SHADINGS)}")
    placed = place(shapes, camera.pose)
    placed.radius[shapes.kind == INFINITE_PLANE] = np.inf
    height, width = camera.raster.shape
    bounds = np.tile(np.array([0, width, 0, height]), (len(shapes), 1))
    seen = np.ones(len(shapes), bool)
    if cull and len(shapes):
        bounds, seen = _window_bounds(camera, shapes, placed)
    order = [np.flatnonzero(seen & np.isin(shapes.kind, shape.KINDS)) for shape in SHAPES]
    visible = np.concatenate(order)
    present = set(shapes.kind[visible].tolist())
    return Plan(
        passes=tuple(passes),
        placed=placed,
        visible=visible,
        bounds=bounds[visible],
        tile_rows=max(1, min(height, TILE_PIXELS // width)),
        unseen=len(shapes) - len(visible),
        missing_kinds=tuple(name for kind, name in enumerate(KIND_NAMES) if kind not in present),
        spare_passes=tuple(name for name in known if name not in passes),
        shading=shading,
    )


def _window_bounds(camera: Camera, shapes: Shapes, placed: Placed):
    """Return (n, 4) int bounds in the render window, and which of them hold a pixel."""
    raster = camera.raster
    endless = np.isinf(placed.radius)
    frame = camera.model.bounds(placed.centre, np.where(endless, 0.0, placed.radius))
    frame[endless] = (-np.inf, np.inf, -np.inf, np.inf)
    seen = ~np.isnan(frame).any(axis=1)
    low, high = np.array([raster.x0, raster.y0]), np.array([raster.x1, raster.y1])
    first = np.clip(np.floor(np.where(seen[:, None], frame[:, 0::2], 0)), low, high) - low
    last = np.clip(np.ceil(np.where(seen[:, None], frame[:, 1::2], 0)), low, high) - low
    seen &= (first < last).all(axis=1)
    bounds = np.stack((first[:, 0], last[:, 0], first[:, 1], last[:, 1]), axis=1).astype(np.int64)
    return bounds, seen
