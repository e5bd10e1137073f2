"""The plan of a cast: the work that a camera, shapes and a request need, determined before any ray is cast."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from .. import tuning
from ..camera.camera import Camera
from ..records import Shapes
from ..shapes import kinds
from ..shapes.in_camera import in_camera
from ..shapes.kind import ShapeSet, Visible
from ..shapes.windows import pixels_in
from .pixel_bounds import CameraPixelBounds
from .request import Request
from .target import RayTarget


@dataclass(frozen=True, eq=False)
class Plan:
    """The work of a cast; shapes and steps that are not in the plan cost nothing.

    Its pixels are those of the render window, counted from the window's corner, or those given to ``at_pixels``.
    """

    camera: Camera
    request: Request
    target: RayTarget
    pixels: CameraPixelBounds
    seen: np.ndarray
    """(m,) indices into ``Shapes``, ascending: the shapes that some pixel may see."""
    bounds: np.ndarray
    """(m, 4) int: x0, x1, y0, y1 in the pixels of the plan, x1 and y1 excluded."""
    near: np.ndarray
    """(m,): a lower bound of the t of each shape, -inf where none is known."""
    clips: bool
    """Whether anything that may be seen reaches beyond the clip end."""
    beyond: np.ndarray = field(default_factory=lambda: np.zeros(0, np.intp))
    """Indices into ``Shapes``: those in view that lie as a whole outside the clip range."""
    whole: Plan | None = None
    """The plan of all pixels, if this plan has only some columns and rows."""

    @property
    def shapes(self) -> Shapes:
        """All shapes."""
        return self.target.shapes

    @property
    def sets(self) -> Collection[ShapeSet]:
        """The shapes that may be seen, kind by kind, ready to be searched."""
        return self.set_of.values()

    @cached_property
    def set_of(self) -> dict[int, ShapeSet]:
        """The set of each kind, by the number of the kind."""
        sets = {}
        for kind, of_kind in kinds.by_kind(self.shapes.kind[self.seen]):
            visible = Visible(
                at=self.seen[of_kind],
                bounds=self.bounds[of_kind],
                near=self.near[of_kind],
                clip_start=self.camera.clip_start,
                from_eye=self.camera.from_eye(self.request.sampled),
                parallel=self.camera.parallel,
                pixels=self.pixels,
                whole=self.whole.set_of[kind.number] if self.whole else None,
            )
            sets[kind.number] = kind.shape_set(self.target.placed, visible)
        return sets

    def at_pixels(self, columns: np.ndarray, rows: np.ndarray) -> Plan:
        """Return the plan for only some of the columns and rows, (k,) and (l,) ascending; or (2, k) and (2, l): each of
        its columns and rows stands for those from a first one to a last one, both ascending.
        """
        pixels = self.pixels.at(columns, rows)
        bounds = pixels.within(self.bounds)
        here = (bounds[:, 0] < bounds[:, 1]) & (bounds[:, 2] < bounds[:, 3])
        return replace(self, whole=self, pixels=pixels, seen=self.seen[here], bounds=bounds[here], near=self.near[here])

    def of_shape(self, k: int) -> Plan:
        """Return the plan of the k-th of ``seen`` alone, in the window of its bounds."""
        x0, x1, y0, y1 = self.bounds[k].tolist()
        raster = self.camera.raster
        window = replace(raster, x0=raster.x0 + x0, x1=raster.x0 + x1, y0=raster.y0 + y0, y1=raster.y0 + y1)
        camera, only = replace(self.camera, raster=window), slice(k, k + 1)
        return replace(
            self, camera=camera, pixels=replace(self.pixels, camera=camera), seen=self.seen[only],
            bounds=np.array([[0, x1 - x0, 0, y1 - y0]]), near=self.near[only],
        )  # fmt: skip

    @cached_property
    def work(self) -> np.ndarray:
        """(rows,): the number of tests in each row of the render window, plus one per pixel, which stands for its ray
        and its passes.
        """
        height, width = self.camera.raster.shape
        change = np.zeros(height + 1)
        x0, x1, y0, y1 = self.bounds.T
        for edge, sign in ((y0, 1), (y1, -1)):
            change += sign * np.bincount(edge, x1 - x0, height + 1)
        return np.cumsum(change)[:height] + width

    @cached_property
    def is_layered(self) -> bool:
        """Whether the shapes that may be seen are few and large: their passes are then written shape by shape."""
        _, width, _, height = self.pixels.whole.tolist()
        return tuning.LAYER_PIXELS * len(self.seen) + pixels_in(self.bounds).sum() <= tuning.LAYERED * width * height

    @property
    def index_type(self) -> np.dtype:
        """The smallest integer type for the indices into ``Shapes`` and -1: every pixel stores an index."""
        return np.min_scalar_type(-max(len(self.shapes), 1))

    @property
    def unseen(self) -> int:
        """Number of shapes that no pixel can see."""
        return len(self.shapes) - len(self.seen)


def make_plan(camera: Camera, shapes: Shapes, request: Request) -> Plan:
    """Return the plan. Raises InputError, which names the shape, if a shape cannot be cast."""
    placed = in_camera(shapes, camera.pose)
    pixels = CameraPixelBounds(camera, request.sampled, request.cull)
    near, far = pixels.t_range(placed)
    bounds, seen = pixels.of_balls(placed.center, placed.radius)
    within = (near <= camera.clip_end) & (far >= camera.clip_start)
    beyond = np.flatnonzero(seen & ~within)
    if request.cull:
        seen &= within
    plan = Plan(
        camera=camera,
        request=request,
        target=RayTarget(placed, np.flatnonzero(seen), request),
        pixels=pixels,
        seen=np.flatnonzero(seen),
        bounds=bounds[seen],
        near=near[seen],
        beyond=beyond,
        clips=bool((far[seen] > camera.clip_end).any()),
    )
    _ = plan.set_of  # computed now, before threads share the plan
    return plan
