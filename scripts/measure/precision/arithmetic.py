"""Textbook and robust arithmetic in float32 and float64, compared with the exact picture; no culling, one thread."""

from dataclasses import replace

import numpy as np
from tests.core.errors.decisions import decision
from tests.core.errors.extreme_cases import CASES, Case, around
from tests.core.truth import truth

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import INFINITE_PLANE, SPHERE
from camera_ray_caster.core.shapes.in_camera import in_camera

from .points import Point, timed

SIDE = 320
"""Width and height of the timed pictures, in pixels."""

COMPARED = 64
"""Number of pixels that are compared with the exact picture."""

METHODS = ("float32 textbook", "float64 textbook", "float64 robust")

FAR = [
    Case(f"a sphere {n:g} radii away", "", [(SPHERE, (0, 0, -n), 1.0)], {"lens": 12.0 * n, "clip_end": 1e30})
    for n in (10.0, 1e3, 1e5, 1e7, 1e9)
]
EVERYDAY = Case("everyday: spheres and planes around", "", around())
NAMES = (
    "a planet, 2 above", "a plane met at 1e-9 rad", "a disc of 1e6 : 1", "axes 1e-12 rad apart",
    "a world offset of 1e7, turned",
)  # fmt: skip
DEFAULT = [EVERYDAY, *FAR, *(next(case for case in CASES if case.name == name) for name in NAMES)]


def textbook(camera, shapes, real):
    """Return distances and shape indices by the quadratic formula and t = -o_z / d_z, in the float type ``real``."""
    rays = camera.rays()
    origins, directions = (a.reshape(-1, 3).astype(real) for a in (rays.origins, rays.directions))
    distance, index = np.full(len(directions), real(camera.clip_end)), np.full(len(directions), -1)
    with np.errstate(all="ignore"):
        for k, (kind, center, axes) in enumerate(zip(shapes.kind, shapes.center, shapes.axes, strict=True)):
            to_shape = np.linalg.inv(axes).astype(real)
            o, d = (origins - center.astype(real)) @ to_shape.T, directions @ to_shape.T
            if kind == SPHERE:
                a, b, c = (d * d).sum(axis=1), (o * d).sum(axis=1), (o * o).sum(axis=1) - real(1)
                root = np.sqrt(b * b - a * c)
                near, far = (-b - root) / a, (-b + root) / a
                t = np.where(near >= camera.clip_start, near, far)
            else:
                t = -o[:, 2] / d[:, 2]
                if kind != INFINITE_PLANE:
                    t = np.where((np.abs(o + t[:, None] * d)[:, :2] <= 1).all(axis=1), t, np.nan)
            closer = (t >= camera.clip_start) & (t < distance)
            distance[closer], index[closer] = t[closer], k
    return distance.reshape(rays.valid.shape), index.reshape(rays.valid.shape)


def caster(camera, shapes):
    """Return distances and shape indices by this caster."""
    images = cast(camera, shapes, passes=("distance", "shape_index"), dtype=np.float64, cull=False, threads=1)
    return images["distance"], images["shape_index"]


def small(raw):
    """Return a camera whose picture has about SIDE x SIDE pixels at most, with the same aspect ratio."""
    fraction = SIDE / (raw.resolution_x * raw.resolution_y) ** 0.5
    return replace(raw, resolution_percentage=max(1, min(raw.resolution_percentage, int(100 * fraction))))


def measure(case) -> list[Point]:
    """Return a point per method for an extreme case at SIDE x SIDE pixels."""
    raw = replace(case.raw, resolution_x=SIDE, resolution_y=SIDE)
    return measured(case.name, raw, case.shapes)


def measured(name, raw, shapes) -> list[Point]:
    """Return a point per method for a camera record of Blender and shapes."""
    camera = camera_from(raw)
    runs = [
        lambda: textbook(camera, shapes, np.float32),
        lambda: textbook(camera, shapes, np.float64),
        lambda: caster(camera, shapes),
    ]
    results = timed(runs, [camera.raster.shape[0] * camera.raster.shape[1]] * len(runs))
    exact = list(_exact(raw, camera, shapes))
    points = []
    for method, ((distance, index), seconds, spread) in zip(METHODS, results, strict=True):
        errors, wrong = [], 0
        for pixel, hit in exact:
            if (hit is None) != (index[pixel] < 0):
                wrong += 1
            elif hit is not None:
                errors.append(float(abs(truth.mpf(float(distance[pixel])) - hit.distance) / hit.distance))
        worst = 1.0 if wrong else max(errors, default=0.0)
        middle = float(np.median([*errors, *[1.0] * wrong])) if errors or wrong else 0.0
        points.append(
            Point("arithmetic", name, method, middle, worst, "of the distance", seconds, spread, wrong, len(exact))
        )
    return points


def _exact(raw, camera, shapes):
    """Yield (pixel, exact hit) for pixels spread over the picture; pixels that rounding could decide are left out."""
    height, width = camera.raster.shape
    placed = in_camera(shapes, camera.pose)
    flat = np.unique(np.linspace(0, height * width - 1, COMPARED).round().astype(int))
    for j, i in zip(*np.unravel_index(flat, (height, width)), strict=True):
        x, y = camera.raster.columns()[0, i], camera.raster.rows()[j, 0]
        ray = truth.ray(raw, x, y)
        sure = (decision(camera, placed, k, np.array([[x]]), np.array([[y]])) for k in range(len(shapes)))
        if ray is not None and all(abs(value[0, 0]) > bound[0, 0] for value, bound in sure):
            yield (j, i), truth.nearest(shapes, ray, camera.clip_start, camera.clip_end)
