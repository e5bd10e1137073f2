"""The plan of a cast: what this camera, these shapes and these passes need, decided before any ray is cast."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..records import SPHERE, InputError, Shapes
from ..shapes import SHAPE_OF_KIND, Placed, place
from ..shapes.normals import NormalTable, normal_table
from .shading import SHADINGS

SMALL_PIXELS = 1 << 13
"""A shape with fewer pixels in its bounds is cast in a batch with others: numpy's call costs more than its pixels."""

SAMPLE_MARGIN = np.array([-0.5, 0.5, -0.5, 0.5])
"""Pixels by which bounds widen when samples lie all over the pixels."""

STORED, MANY_ORIGINS = 0.25, 8.0
"""What a pass costs, and a test where rays leave many points and go all ways, in tests of a pixel."""

PAINTED = 2.0
"""Pixels in the bounds of the shapes, for each of the picture, up to which painting them takes less than looking up."""

PRECISIONS = {"AUTOMATIC": np.float64, "ROBUST": np.float64, "FAST": np.float32}
"""What hits are searched with. float32 is for previews: it may miss what is smaller than 1e-7 of its distance, and its
bound is never within the rounding of a stored float32, so that AUTOMATIC has no picture for which it suffices. Nor does
it gain much: 1.03 to 1.28 times the speed of a whole cast, measured alternately, since memory and passes cost the rest.
"""

KIND_NAMES = ("sphere", "plane", "infinite plane")


@dataclass(frozen=True)
class Group:
    """Shapes of one kind that are tested alike; one row a shape."""

    kind: int
    simple: bool
    """Whether the origin is outside and nothing lies before the clip start: the near root alone decides."""
    small: bool
    """Whether they are cast many at once: sorted by the lowest row that they may be seen in."""
    at: np.ndarray
    """(m,) rows in ``Shapes``."""
    bounds: np.ndarray
    """(m, 4) int: x0, x1, y0, y1 in the render window, x1 and y1 not included."""
    near: np.ndarray
    """(m,): the least t that each may have, -inf where that is not known."""
    view: Any
    """The kernel's constants: the last axis counts the shapes."""

    @property
    def shape(self):
        """The module of this kind of shape."""
        return SHAPE_OF_KIND[self.kind]

    @cached_property
    def tallest(self) -> int:
        """The most rows that one of them may be seen in."""
        return int((self.bounds[:, 3] - self.bounds[:, 2]).max())

    def within(self, corner, shape):
        """Return which of them may be seen in a tile, (k,), and their bounds in it, (k, 4)."""
        some = slice(None)
        if self.small:
            ends = corner[1] - self.tallest, corner[1] + shape[0]
            some = slice(*np.searchsorted(self.bounds[:, 2], ends))
        (left, low), (high, wide) = corner, shape
        edges = np.maximum(self.bounds[some] - np.array((left, left, low, low)), 0)
        np.minimum(edges, np.array((wide, wide, high, high)), out=edges)
        here = np.flatnonzero((edges[:, 0] < edges[:, 1]) & (edges[:, 2] < edges[:, 3]))
        return here + (some.start or 0), edges[here]

    def constants(self, at, axes: int = 0):
        """Return the kernel's constants of one row, or of many with so many more axes behind them."""
        values = (getattr(self.view, name)[..., at] for name in self.view.__dataclass_fields__)
        return type(self.view)(*(value.reshape(*value.shape, *(1,) * axes) if axes else value for value in values))


@dataclass(frozen=True)
class Plan:
    """What the cast does. What is not in it costs nothing."""

    camera: Camera
    shapes: Shapes
    passes: tuple[str, ...]
    shading: str
    placed: Placed
    groups: tuple[Group, ...]
    unseen: int
    """Shapes that no pixel can see."""
    spare_passes: tuple[str, ...]
    """Passes that were not asked for."""
    clips: bool
    """Whether anything that may be seen reaches beyond the clip end."""
    real: type
    """What hits are searched with: float64 or float32."""

    @cached_property
    def work(self) -> np.ndarray:
        """(rows,) of the render window: about how many pixels are tested in each; a pass counts as STORED of a test, a
        test as MANY_ORIGINS where rays have neither a point nor a direction in common.
        """
        height, width = self.camera.raster.shape
        change = np.zeros(height + 1)
        for x0, x1, y0, y1 in (group.bounds.T for group in self.groups):
            for edge, sign in ((y0, 1), (y1, -1)):
                change += sign * np.bincount(edge, x1 - x0, height + 1)
        tested = np.cumsum(change)[:height]
        simple = self.camera.model.central or self.camera.parallel is not None
        return (1.0 if simple else MANY_ORIGINS) * tested + STORED * len(self.passes) * width

    @property
    def row_type(self) -> np.dtype:
        """The smallest integers that hold every row in ``Shapes``, and -1: each pixel has one."""
        return np.min_scalar_type(-max(len(self.shapes), 1))

    @cached_property
    def object_index(self) -> np.ndarray:
        """(n + 1,): the shapes' object indices, and 0 for what sees none."""
        return np.append(self.shapes.object_index, np.int32(0))

    @cached_property
    def material_index(self) -> np.ndarray:
        """(n + 1,): the shapes' material indices, and 0 for what sees none."""
        return np.append(self.shapes.material_index, np.int32(0))

    @cached_property
    def colors(self) -> np.ndarray:
        """(4, n + 1) float64: the shapes' colors, and transparent black for what sees none."""
        return np.hstack((self.shapes.color.T, np.zeros((4, 1)))).astype(np.float64, order="C")

    @cached_property
    def normals(self) -> NormalTable:
        """The constants of the normals, made when a pass first asks for them."""
        seen = np.concatenate([np.zeros(0, np.intp), *(group.at for group in self.groups)])
        return normal_table(self.shapes, self.placed, self.camera.pose, seen)

    @cached_property
    def is_painted(self) -> bool:
        """Whether the shapes in view are few and large: what is theirs is painted, not looked up by every pixel."""
        height, width = self.camera.raster.shape
        pixels = sum(pixels_in(group.bounds).sum() for group in self.groups)
        return pixels <= PAINTED * height * width and not any(group.small for group in self.groups)

    @property
    def eye_outside(self) -> bool:
        """Whether the eye is outside of every sphere in view: then every tabled normal faces the rays from it."""
        return all(group.simple or group.kind != SPHERE for group in self.groups)

    def left_out(self) -> list[str]:
        """Return what is not done, in words, for the report."""
        seen = sum(len(group.at) for group in self.groups)
        kinds = {group.kind for group in self.groups}
        lines = []
        if self.unseen:
            lines.append(f"{self.unseen} of {self.unseen + seen} shapes: no pixel can see them")
        missing = [name for kind, name in enumerate(KIND_NAMES) if kind not in kinds]
        if missing:
            lines.append(f"kernels of {', '.join(missing)}: no such shape is in view")
        if self.camera.model.central:
            lines.append("origins of rays: all leave the eye")
        if not self.clips:
            lines.append("the clip end: nothing in view reaches beyond it")
        if self.spare_passes:
            lines.append(f"passes {', '.join(self.spare_passes)}: not asked for")
        return lines


def make_plan(
    camera: Camera,
    shapes: Shapes,
    passes: Sequence[str],
    known: Sequence[str],
    shading: str,
    cull: bool,
    sampled: bool,
    precision: str = "AUTOMATIC",
) -> Plan:
    """Return the plan; InputError names an unknown pass, shading or precision and those that there are.

    Without ``cull`` every shape is tested at every pixel. ``sampled``: for rays all over the pixels and the aperture.
    """
    unknown = [name for name in passes if name not in known]
    if unknown:
        raise InputError(f"no pass is called {', '.join(map(repr, unknown))}: choose from {', '.join(known)}")
    if shading not in SHADINGS:
        raise InputError(f"no shading is called {shading!r}: choose from {', '.join(SHADINGS)}")
    if precision not in PRECISIONS:
        raise InputError(f"no precision is called {precision!r}: choose from {', '.join(PRECISIONS)}")
    real = PRECISIONS[precision]
    placed = place(shapes, camera.pose)
    height, width = camera.raster.shape
    bounds = np.tile(np.array([0, width, 0, height]), (len(shapes), 1))
    seen = np.ones(len(shapes), bool)
    near, far = _reach(camera, placed, sampled)
    if cull:
        bounds, seen = _window_bounds(camera, placed, sampled)
        seen &= (near <= camera.clip_end) & (far >= camera.clip_start)
    simple = near >= camera.clip_start
    small = pixels_in(bounds) < SMALL_PIXELS
    groups = []
    alike = 4 * shapes.kind + 2 * simple + small
    for code in np.unique(alike[seen]).tolist():
        kind, is_simple, is_small = code // 4, bool(code & 2), bool(code & 1)
        at = np.flatnonzero(seen & (alike == code))
        if is_small:
            at = at[np.argsort(bounds[at, 2], kind="stable")]
        view = _rounded(SHAPE_OF_KIND[kind].view(placed, at, camera.parallel), real)
        groups.append(Group(kind, is_simple, is_small, at, np.asfortranarray(bounds[at]), near[at], view))
    return Plan(
        camera=camera,
        shapes=shapes,
        passes=tuple(passes),
        shading=shading,
        placed=placed,
        groups=tuple(groups),
        unseen=int(np.count_nonzero(~seen)),
        spare_passes=tuple(name for name in known if name not in passes),
        clips=bool((far[seen] > camera.clip_end).any()),
        real=real,
    )


def pixels_in(bounds) -> np.ndarray:
    """Return how many pixels lie in bounds (n, 4), each x0, x1, y0, y1."""
    return (bounds[:, 1] - bounds[:, 0]) * (bounds[:, 3] - bounds[:, 2])


def _rounded(view, real):
    """Return a kernel's constants as what is calculated with; NaN, which hits nothing, where float32 does not reach."""
    if real is np.float64:
        return view
    largest = np.finfo(real).max
    values = (getattr(view, name) for name in view.__dataclass_fields__)
    return type(view)(*(np.where(np.abs(value) <= largest, value, np.nan).astype(real) for value in values))


def _reach(camera: Camera, placed: Placed, sampled: bool):
    """Return the least and the greatest t that a shape may have, (n,) each: unbounded where that is not known."""
    reach = placed.radius
    if camera.model.planar:
        middle, reach = -placed.center[:, 2], placed.reach
    elif camera.model.central and camera.is_rigid and not (sampled and camera.aperture):
        middle = np.sqrt((placed.center * placed.center).sum(axis=1))
    else:
        return np.full(len(reach), -np.inf), np.full(len(reach), np.inf)
    reach = reach * (1 + 8 * np.finfo(float).eps)
    return middle - reach, middle + reach


def _window_bounds(camera: Camera, placed: Placed, sampled: bool):
    """Return (n, 4) int bounds in the render window, and which of them hold a pixel center."""
    raster = camera.raster
    endless = np.isinf(placed.radius)
    with np.errstate(all="ignore"):
        radius = np.where(endless, 0.0, placed.radius)
        if sampled and camera.aperture is not None:
            away = -placed.center[:, 2] if camera.model.planar else np.sqrt((placed.center**2).sum(axis=1))
            radius = radius + camera.aperture.blur(away, radius)
        frame = camera.model.bounds(placed.center, radius)
        if sampled:
            frame = frame + SAMPLE_MARGIN
    frame[endless] = (-np.inf, np.inf, -np.inf, np.inf)
    seen = ~np.isnan(frame).any(axis=1)
    corner, size = np.array([raster.x0, raster.y0]), raster.shape[::-1]
    frame = np.where(seen[:, None], frame, 0.0)
    first = np.clip(np.ceil(frame[:, 0::2] - 0.5) - corner, 0, size)  # pixel centers, not pixels
    last = np.clip(np.floor(frame[:, 1::2] + 0.5) - corner, 0, size)
    seen &= (first < last).all(axis=1)
    return np.stack((first[:, 0], last[:, 0], first[:, 1], last[:, 1]), axis=1).astype(np.int64), seen
