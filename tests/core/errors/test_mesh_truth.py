"""Distance, position and normal of hits of meshes against 60 digits, and the bounds that they come with."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast

from ..cameras.model_examples import EXAMPLES, raw_of
from ..shapes.meshes import ball, shapes_of, soup
from ..truth import truth
from ..truth.truth import cross, dot, exact, minus, norm

PASSES = (
    "distance", "position", "normal", "shape_index", "face_index", "distance_bound", "position_bound", "normal_bound",
)  # fmt: skip
PIXELS = 12
AXES = np.array([[1, 0.2, 0], [0, -0.5, 0.1], [0.3, 0, 2]])


def corners_of(shapes, row, triangle):
    """The corners in the world, and the normals there: of unit length in the world unless the mesh is shared."""
    mesh = shapes.meshes[shapes.mesh[row]]
    axes, center, middle = exact(shapes.axes[row]), exact(shapes.center[row]), exact(mesh.middle)
    places = [exact(mesh.vertices[:, k]) for k in mesh.triangles[:, triangle]]
    places = [[c + dot(line, minus(v, middle)) for c, line in zip(center, axes, strict=True)] for v in places]
    if mesh.normals is None:
        return places, None
    to_world = list(zip(*truth.inverse(axes), strict=True))
    normals = [exact(mesh.normals[k]) for k in mesh.loops[:, triangle]]
    normals = [[dot(line, normal) for line in to_world] for normal in normals]
    if not shapes.shared[row]:
        normals = [[x / norm(normal) for x in normal] for normal in normals]
    return places, normals


def hit(shapes, row, triangle, ray):
    """Distance, position and normal where the ray meets the plane of a triangle, and the least of its three weights."""
    (a, b, c), normals = corners_of(shapes, row, triangle)
    area = cross(minus(b, a), minus(c, a))
    t = dot(area, minus(a, ray.origin)) / dot(area, ray.direction)
    point = [o + t * d for o, d in zip(ray.origin, ray.direction, strict=True)]
    weights = [dot(cross(minus(q, p), minus(point, p)), area) / dot(area, area) for p, q in ((b, c), (c, a), (a, b))]
    normal = area
    if normals is not None:
        normal = [sum(w * n[i] for w, n in zip(weights, normals, strict=True)) for i in range(3)]
        outward = dot(normal, area)  # of a mirrored mesh the area looks in
        area = area if outward > 0 else [-x for x in area]
    side = -1 if dot(area, ray.direction) > 0 else 1
    return t * ray.length, point, [side * x / norm(normal) for x in normal], min(weights)


@pytest.mark.parametrize("key", [model.key for model in MODELS])
def test_no_bound_is_exceeded(key):
    """Of a soup of triangles and slivers, a smooth mirrored ball, and two that share a mesh."""
    rng = np.random.default_rng(7)
    shared = ball(6, 9)
    shapes = shapes_of(
        (soup(rng, 80), (0.3, -0.2, -2), 1.5),
        (ball(7, 8), (1, 0, -5), AXES),
        (shared, (-2, 1, -3), AXES),
        (shared, (2, -1, -4), np.diag([1, 0.2, 1])),
        shared=np.array([False, False, True, True]),
    )
    for settings in EXAMPLES[key]:
        raw = raw_of(key, settings | {"resolution_x": 40, "resolution_y": 30})
        camera = camera_from(raw)
        if camera.pixel_time is not None:
            continue
        images = cast(camera, shapes, passes=PASSES, dtype=np.float64)
        hits = np.argwhere(images["shape_index"] >= 0)
        for j, i in rng.permutation(hits)[:PIXELS].tolist():
            ray = truth.ray(raw, camera.raster.x0 + i + 0.5, camera.raster.y0 + j + 0.5)
            cast_values = {name: images[name][j, i] for name in PASSES}
            distance, point, normal, least = hit(shapes, cast_values["shape_index"], cast_values["face_index"], ray)
            assert least > -1e-9
            assert abs(exact([cast_values["distance"]])[0] - distance) <= cast_values["distance_bound"]
            assert norm(minus(exact(cast_values["position"]), point)) <= cast_values["position_bound"]
            assert norm(minus(exact(cast_values["normal"]), normal)) <= cast_values["normal_bound"]
        assert not len(hits) or np.median(images["distance_bound"][images["shape_index"] >= 0]) < 1e-11
