"""The passes and the error bounds of the hits of given rays, written by the code that writes those of pictures."""

from __future__ import annotations

import numpy as np

from ..casting.hit_values import HitValues
from ..casting.hits import NOTHING, Hits
from ..casting.passes import PASSES
from ..casting.pixel_bounds import CameraPixelBounds
from ..casting.plan import Plan
from ..casting.rays import TileRays
from ..casting.request import Request
from ..casting.store import store
from ..maths.speed import Scratch
from ..records import MESH
from ..shapes.mesh.nearest import SeenTriangles
from .given import camera_of
from .search import Found, RayHits

Span = tuple[float, float]
"""The least and the largest t of hits."""

CHUNK = 1 << 15
"""Number of rays whose passes are written at once."""


def write(search: Found, origin, direction, t, body, images: dict[str, np.ndarray], rays, span: Span) -> None:
    """Write the passes of hits, one for each ray (3, n), at the places ``rays``, (n,), of images with one row."""
    plan, scratch = _plan(search, origin, direction, span, tuple(images)), Scratch()
    with np.errstate(all="ignore"):  # NaN and inf mean no ray and no hit
        for first in range(0, len(t), CHUNK):
            part = slice(first, first + CHUNK)
            outs = {name: PASSES[name].empty((1, len(rays[part])), image.dtype) for name, image in images.items()}
            store(_hits(plan, search, part, t, body, scratch), outs)
            for name, out in outs.items():
                images[name][:, rays[part]] = out


def t_errors(search: Found, origin, direction, hits: RayHits) -> np.ndarray:
    """Return the error bounds of the t of hits, one for each ray (3, n)."""
    plan, scratch = _plan(search, origin, direction, (0.0, 1.0), ()), Scratch()
    error = np.full(hits.t.shape, np.inf)
    for first in range(0, len(error), CHUNK):
        part = slice(first, first + CHUNK)
        for where, own in HitValues(_hits(plan, search, part, hits.t, hits.body, scratch)).errors:
            error[part][where[0]] = own.t_error
    return error


def _plan(search: Found, origin, direction, span: Span, passes: tuple[str, ...]) -> Plan:
    """Return the plan for the passes of rays (3, n): that of a picture in which every shape may be seen."""
    camera, shapes = camera_of(origin, direction, *span), search.shapes
    request = Request(passes, tuple(PASSES), cull=False)
    pixels = CameraPixelBounds(camera, sampled=False, cull=False)
    bounds, _ = pixels.of_balls(search.placed.center, search.placed.radius)
    near = np.full(len(shapes), -np.inf)
    return Plan(camera, shapes, request, search.placed, pixels, np.arange(len(shapes)), bounds, near, clips=False)


def _hits(plan: Plan, search: Found, part: slice, t, body, scratch: Scratch) -> Hits:
    """Return the hits of some rays, given t and bodies of all, -1 for none."""
    x = np.arange(len(t))[None, part] + 0.5
    origin, direction = plan.camera.model.rays(x, 0.5)
    t, body = t[None, part], body[None, part]
    rays = TileRays(x, np.array([[0.5]]), (0, 0), False, origin, direction, scratch)
    index = np.full(body.shape, NOTHING)
    some = body >= 0
    index[some] = search.at[body[some]]
    some &= search.is_triangle[body]
    met, place = np.unique(body[some], return_inverse=True)
    of_pixel = np.zeros(body.shape, np.int32)
    of_pixel[some] = place
    return Hits(plan, rays, t, index, {MESH: SeenTriangles(search.at[met], search.number[met], of_pixel)})
