"""Which search finds the nearest hits of a picture: that of tiles, or the tree of bodies, ray by ray."""

from collections.abc import Callable

import numpy as np

from ..casting.hits import Hits
from ..casting.plan import Plan
from ..casting.rays import TileRays
from ..casting.search import HitSearch, nearest_hits
from ..maths.vector import matvec, norm
from .body_search import search_of

TRIANGLES, TRIANGLES_OF_SHAPE = 10_000, 40
"""Number of triangles from which the tree, with its making, pays for a model without bounds, and as how many a shape
counts. With 160 x 90 to 1280 x 720 pixels 14,400 triangles take 0.2 to 0.7 of the processor time, 3,600 0.6 to 2.2;
1,000 spheres 0.1 to 0.2, 100 spheres 0.8 to 1.2.
"""

TRIANGLES_OF_TABLE, NEARBY = 40_000, 1 / 128
"""The same for a model with wide bounds whose origins are within this part of the median distance of shapes: ray tables
take 0.8 to 0.85 of the time in a street of 49,000 triangles, 0.77 in a room of 79,000, and 1.5 to 1.6 where 25,000
triangles are on a table; with origins twice as far apart 1.3 in the room; with those within 40 cm 1.3, 0.7 and 2.3.
"""

PROBES = 8
"""Number of points whose bounds show whether a model has any."""


def search_for(plan: Plan) -> HitSearch:
    """Return the search for the rays of a plan."""
    return _by_tree if uses_tree(plan) else nearest_hits


def uses_tree(plan: Plan) -> bool:
    """Whether rays are searched one by one: where the search of tiles cannot tell which pixels may see a shape.

    For scanners whose beams have origins of their own it bounds shapes by balls around all origins and azimuths: a
    street and a room take 0.4 to 0.5 times the processor time by the tree, a table 0.5 to 1.2 times. For models whose
    ``bounds`` tell nothing, such as formulas that iterate, it tests every shape at every pixel: a street and a room of
    85,000 triangles take 0.3 times. The tree is in the world: far from its origin hits round as world coordinates do.
    """
    model, shapes, placed = plan.camera.model, plan.shapes, plan.target.placed
    if not model.differentiable:
        return not model.central
    triangles = sum(map(len, shapes.meshes))
    if not plan.request.cull or triangles + TRIANGLES_OF_SHAPE * len(shapes) < TRIANGLES:
        return False
    points = placed.center[np.isfinite(placed.radius)]
    if not len(points):
        return False
    nearby = NEARBY * float(np.median(norm(points.T)))
    if model.bounds_are_wide and triangles >= TRIANGLES_OF_TABLE and model.formula_reach <= nearby:
        return True
    points = points[:PROBES]
    return bool(np.isinf(model.bounds(points, np.zeros(len(points)))).all())


def _by_tree(plan: Plan, rays: TileRays, listen: Callable[[], object]) -> Hits:
    camera, shape, bodies = plan.camera, rays.shape, search_of(plan.shapes)
    origin, direction = (
        np.array([np.broadcast_to(component, shape).reshape(-1) for component in matvec(camera.pose.basis, vector)])
        for vector in (rays.origin, rays.direction)
    )
    origin += camera.pose.eye[:, None]
    t, body = bodies.nearest(origin, direction, camera.clip_start, camera.clip_end)
    listen()
    return bodies.hits_of(plan.target, rays, t.reshape(shape), body.reshape(shape))
