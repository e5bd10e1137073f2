"""The distance in pixels between the images of the same points in two states of a scene, such as an interpolated and an
evaluated one: the error of the first."""

from dataclasses import replace
from itertools import product

import numpy as np

from ..camera.camera import Camera
from ..maths.vector import cross, dot
from ..records import INFINITE_PLANE, MESH, PLANE, Shapes
from .deformation import alike, changed, vertices
from .interpolation import State

ALONG = 2 / 3
"""Place of the rays that are tested, as a fraction of the way from the middle of the picture to its end."""

AHEAD = 10.0
"""Distance, in Blender units, of the points on these rays that say how the camera moves where they hit nothing."""

ENDLESS = 1e6
"""Half the side of the part of an infinite plane on which landmarks are looked for, in lengths of its axes."""

LIT = 1 << 12
"""Maximum number of points at which light is compared."""


def apart(state: State, truth: State) -> float:
    """Return the largest distance in pixels between the images of two states' landmarks: see ``_landmarks``, vertices
    of meshes that deform, and points on some of the true camera's rays; and between the ends of the two pictures within
    the frame.

    Landmarks that the true camera does not see in or near its picture are ignored; if the numbers of shapes differ, the
    distance is infinite.
    """
    shapes, true_shapes = state[1], truth[1]
    if len(shapes) != len(true_shapes):
        return np.inf
    camera, true_camera = (replace(state_of[0], pixel_time=None) for state_of in (state, truth))
    deforming = changed(shapes, true_shapes) if alike(shapes.meshes, true_shapes.meshes) else np.zeros(0, int)
    size = np.array(true_camera.raster.size)
    with np.errstate(all="ignore"):
        origins, directions = rays = _rays(true_camera)
        local = _landmarks(true_shapes, *rays)
        here, there = (
            eye.project(np.concatenate((
                _places(_boxed(scene), local).reshape(-1, 3), vertices(scene, deforming), origins + AHEAD * directions
            )))
            for eye, scene in ((camera, shapes), (true_camera, true_shapes))
        )  # fmt: skip
    counts = (there >= -size).all(axis=-1) & (there <= 2 * size).all(axis=-1)
    ends = np.hypot(*(camera.model.outline - true_camera.model.outline).T)
    distance = np.concatenate((np.hypot(*(here - there).T)[counts], ends))
    return float(np.where(np.isnan(distance), np.inf, distance).max(initial=0.0))


def lit(state: State) -> np.ndarray:
    """Return points of the shapes at which light may fall, (n, 3): landmarks other than centers, at most LIT."""
    camera, shapes = state
    with np.errstate(all="ignore"):
        local = _landmarks(shapes, *_rays(replace(camera, pixel_time=None)))
        points = _places(shapes, local[:, 1:]).reshape(-1, 3)
    points = points[np.isfinite(points).all(axis=1)]
    return points[:: -(-len(points) // LIT) or 1]


def _rays(camera: Camera) -> tuple[np.ndarray, np.ndarray]:
    """Return origins and directions of rays that are spread over the picture, (9, 3) each."""
    start, ends = camera.model.outline[0], camera.model.outline
    rays = camera.rays_at(*(start + ALONG * (ends - start)).T)
    return np.broadcast_to(rays.origins, rays.directions.shape), rays.directions


def _places(shapes: Shapes, local: np.ndarray) -> np.ndarray:
    """Return points in the shapes' frames, (n, m, 3), as points in the world."""
    return shapes.center[:, None] + np.einsum("nij,nmj->nmi", shapes.axes, local)


def _boxed(shapes: Shapes) -> Shapes:
    """Return the shapes; those whose meshes are between evaluations about the middles of their bounding boxes."""
    center = shapes.center.copy()
    for k, mesh in enumerate(shapes.meshes):
        if mesh.own_middle is not None:
            rows = shapes.mesh == k
            center[rows] += shapes.axes[rows] @ (mesh.box_middle - mesh.own_middle)
    return replace(shapes, center=center)


def _landmarks(shapes: Shapes, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Return landmarks of shapes in their own frames, (n, 18, 3): the center, the corners of the bounding box, and the
    points at which rays meet the box; NaN where a ray misses it or the frame is flat.
    """
    half = np.ones((len(shapes), 1, 3))
    half[(shapes.kind == PLANE) | (shapes.kind == INFINITE_PLANE), :, 2] = 0.0
    if shapes.meshes:
        is_mesh = shapes.kind == MESH
        half[is_mesh, 0] = np.array([mesh.half_size for mesh in shapes.meshes])[shapes.mesh[is_mesh]]
    corners = half * np.array([(0.0, 0.0, 0.0), *product((-1.0, 1.0), repeat=3)])
    first, second, third = (shapes.axes[:, :, k].T for k in range(3))
    rows = np.array([cross(second, third), cross(third, first), cross(first, second)])
    inverse = (rows / dot(first, rows[0])).transpose(2, 0, 1)
    start = (origins - shapes.center[:, None]) @ inverse.swapaxes(1, 2)
    along = directions @ inverse.swapaxes(1, 2)
    half[shapes.kind == INFINITE_PLANE, :, :2] = ENDLESS
    sides = (-half - start) / along, (half - start) / along
    enter, leave = np.fmin(*sides).max(axis=-1), np.fmax(*sides).min(axis=-1)
    t = np.where(enter > 0, enter, leave)[..., None]
    meets = (leave >= np.maximum(enter, 0))[..., None]
    return np.concatenate((corners, np.where(meets, np.clip(start + t * along, -half, half), np.nan)), axis=1)
