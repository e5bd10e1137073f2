"""Transparent points are no hits: against every crossing of plain equations, for every camera model."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.any_rays.door import cast_rays
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.visibility import Visibility, visible
from camera_ray_caster.core.lesson.lesson import lesson
from camera_ray_caster.core.materials.surface import Surface
from camera_ray_caster.core.materials.values import OBJECT, UV, Coordinates, constant, function_of
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE

from ..shapes import meshes
from ..shapes.test_mesh import examples
from .neighbors import with_others
from .test_cast import camera_at, shapes_of

BOUNDS = "distance", "distance_bound", "shape_index"
ON_EDGES = {"OPENCV_PINHOLE", "FOV", "STEREOGRAPHIC_PANORAMA", "DOME_MASTER", "PENCIL", "STRIP"}
"""Models with an example of which whole columns or rows of pixels lie on the edges between stripes."""
each_model = pytest.mark.parametrize(
    "key",
    [
        pytest.param(model.key, marks=[] if model.key in {"PERSP", "PUSHBROOM"} else pytest.mark.full)
        for model in MODELS
    ],
)


def striped(coordinates, count, axis=0):
    """A surface with stripes along an axis of its coordinates, every second one transparent."""
    stripe = function_of(lambda p: np.floor(p[axis : axis + 1] * count) % 2, Coordinates(coordinates))
    return Surface(constant(1, 1, 1), alpha=stripe)


def stripe_at(value, count):
    """Whether a point is opaque, and whether rounding cannot decide it."""
    return np.floor(value * count) % 2 == 1, np.abs(value * count - np.rint(value * count)) > 1e-9


def assert_nearest(cam, shapes, crossings):
    """Each pixel has the nearest of all crossings, (t, is_opaque, is_sure) for each shape, k times (m,) each."""
    images, rays = cast(cam, shapes, passes=BOUNDS, dtype=float), cam.rays()
    origins = np.broadcast_to(rays.origins, rays.directions.shape)[rays.valid]
    nearest, row = np.full(len(origins), np.inf), np.full(len(origins), -1)
    sure = np.ones(len(origins), bool)
    for k in range(len(shapes)):
        for t, opaque, own_sure in crossings(k, origins, rays.directions[rays.valid]):
            t = np.where(t >= cam.clip_start, t, np.inf)
            sure &= own_sure | ~np.isfinite(t)
            nearer = opaque & (t < nearest)
            nearest[nearer], row[nearer] = t[nearer], k
    assert sure.mean() > (0.6 if cam.model.key in ON_EDGES else 0.9)
    distance, bound, index = (images[name][rays.valid][sure] for name in BOUNDS)
    np.testing.assert_array_equal(index, row[sure])
    met = np.isfinite(distance)
    assert (np.abs(distance[met] - nearest[sure][met]) <= bound[met]).all()
    assert met.any()
    by_rays = cast_rays(origins[sure], rays.directions[rays.valid][sure], shapes, passes=BOUNDS)
    beyond = cam.clip_start + 1e-9 < by_rays["distance"]  # the clip start may be a plane
    np.testing.assert_array_equal(by_rays["shape_index"][beyond], index[beyond])


@each_model
def test_of_exact_shapes_the_nearest_opaque_crossing_is_the_hit(key):
    """A ball in front of others, which shows its far side through its near one, a card and a floor."""
    shapes = shapes_of(
        (SPHERE, (0.2, 0.1, -4), 1.5), (SPHERE, (-2, 1, 3), 1.0), (PLANE, (0, 0, -2), 1.2), (SPHERE, (3, 0, -1), 1.0),
        (INFINITE_PLANE, (0, 0, -9), 1.0), (SPHERE, (0, 0, 0), 30.0),
        surfaces=(striped(UV, 16), striped(UV, 5, 1)), surface=np.array([0, 1, 1, 0, 0, -1], np.int32),
    )  # fmt: skip
    counts = {0: (16, 0), 1: (5, 1)}

    def crossings(k, origins, directions):
        inverse = np.linalg.inv(shapes.axes[k])
        at, along = (origins - shapes.center[k]) @ inverse.T, directions @ inverse.T
        if shapes.kind[k] == SPHERE:
            a, b, c = (along**2).sum(1), (at * along).sum(1), (at**2).sum(1) - 1
            root = np.sqrt(b * b - a * c)
            roots = [(-b - root) / a, (-b + root) / a]
        else:
            roots = [-at[:, 2] / along[:, 2]]
        for t in roots:
            q = (at + t[:, None] * along).T
            if shapes.kind[k] == SPHERE:
                uv = np.arctan2(q[1], q[0]) / (2 * np.pi) + 0.5, np.arctan2(q[2], np.hypot(q[0], q[1])) / np.pi + 0.5
            else:
                uv = (q[:2] + 1) / 2
            inside = (np.abs(q[:2]) <= 1).all(axis=0) | (shapes.kind[k] != PLANE)
            t = np.where(inside & np.isfinite(t), t, np.inf)
            if shapes.surface[k] < 0:
                yield t, np.ones(len(t), bool), np.ones(len(t), bool)
            else:
                count, axis = counts[shapes.surface[k]]
                yield (t, *stripe_at(uv[axis], count))

    with np.errstate(all="ignore"):
        for cam in examples(key):
            assert_nearest(cam, shapes, crossings)


@each_model
def test_of_meshes_the_nearest_opaque_crossing_is_the_hit(key):
    """Nested balls and a soup of triangles, each with stripes in its own space."""
    rng = np.random.default_rng(3)
    parts = [meshes.ball(8, 10), meshes.ball(6, 8), meshes.soup(rng, 30)]
    shapes = meshes.shapes_of(
        (parts[0], (0.3, 0.1, -5), 2 * np.eye(3)), (parts[1], (0, 0, -5), np.diag([1.0, 1.5, 1.0])),
        (parts[2], (0, 0, 0), 3 * np.eye(3)), (parts[0], (0, 0, 0), 20 * np.eye(3)),
        surfaces=(striped(OBJECT, 6),), surface=np.array([0, 0, 0, -1], np.int32),
    )  # fmt: skip

    def crossings(k, origins, directions):
        t, inside = meshes.every_hit(shapes, k, origins, directions)
        point = origins[:, None] + np.where(np.isfinite(t), t, 0.0)[..., None] * directions[:, None]
        mesh = shapes.meshes[shapes.mesh[k]]
        in_mesh = (point - shapes.center[k]) @ np.linalg.inv(shapes.axes[k]).T + mesh.middle
        opaque, clear = stripe_at(in_mesh[..., 0].astype(float), 6)
        if shapes.surface[k] < 0:
            opaque, clear = np.ones_like(opaque), np.ones_like(clear)
        sure = (np.abs(inside) > 1e-9).all(axis=1)
        for triangle in range(t.shape[1]):
            yield t[:, triangle].astype(float), opaque[:, triangle], clear[:, triangle] & sure

    for cam in examples(key)[:1]:
        assert_nearest(cam, shapes, crossings)


def card_before_wall():
    """A card of unit size at depth 2, transparent on its left half, before a wall at depth 4."""
    left = function_of(lambda uv: (uv[:1] >= 0.5) * 1.0, Coordinates(UV))
    return shapes_of(
        (PLANE, (0, 0, -2), 1.0), (PLANE, (0, 0, -4), 9.0),
        surfaces=(Surface(constant(0, 1, 0), alpha=left),), surface=np.array([0, -1], np.int32),
    )  # fmt: skip


def test_a_point_behind_a_transparent_point_is_seen():
    points = [(-0.5, 0, -3), (0.5, 0, -3), (-0.5, 0, -2), (-0.5, 0, -5)]
    is_visible = visible(camera_at(), card_before_wall(), points)
    assert is_visible.tolist() == [Visibility.SEEN, Visibility.HIDDEN, Visibility.SEEN, Visibility.HIDDEN]


def test_flow_is_that_of_what_is_seen_through_the_card():
    """The wall and the camera rest, the card moves: what is seen through it has no flow, and is hidden by the card."""
    camera, shapes = camera_at(), card_before_wall()
    moved = card_before_wall()
    moved.center[0, 0] -= 1.0
    camera, shapes = with_others(camera, shapes, camera, moved)
    images = cast(camera, shapes, passes=("shape_index", "flow_forward", "flow_hidden", "position"), dtype=float)
    wall = images["shape_index"] == 1
    through = wall & (np.abs(images["position"][..., 0] + 1) < 0.9) & (np.abs(images["position"][..., 1]) < 1.9)
    assert through.any()
    np.testing.assert_allclose(images["flow_forward"][wall], 0, atol=1e-9)
    assert images["flow_hidden"][through, 0].all()


def test_a_threshold_is_met_by_the_same_alpha_and_constants_are_all_or_nothing():
    shapes = card_before_wall()
    for alpha, seen in ((0.5, 0), (np.nextafter(0.5, 0), 1)):
        surfaces = (Surface(constant(0, 1, 0), alpha=constant(alpha)),)
        both = shapes_of((PLANE, (0, 0, -2), 9.0), (PLANE, (0, 0, -4), 99.0), surfaces=surfaces, surface=shapes.surface)
        assert (cast(camera_at(), both, passes="shape_index")["shape_index"] == seen).all()


@pytest.mark.parametrize("kind", ["plane", "mesh"])
def test_step_by_step_a_transparent_point_does_not_count(kind):
    """With the true color of what is seen through it: half its own, of a surface that glows."""
    camera, shapes = camera_at(), card_before_wall()
    glowing = Surface(constant(1, 0, 0), glow=constant(0, 0.25, 0))
    shapes = replace(shapes, surfaces=(*shapes.surfaces, glowing), surface=np.array([0, 1], np.int32))
    if kind == "mesh":
        sheet = meshes.grid(1, 1, lambda u, v: (2 * u - 1, 2 * v - 1, 0 * u))
        left = function_of(lambda points: (points[:1] >= 0) * 1.0, Coordinates(OBJECT))
        shapes = meshes.shapes_of(
            (sheet, (0, 0, -2), 1.0), (sheet, (0, 0, -4), 9.0),
            surfaces=(Surface(constant(0, 1, 0), alpha=left), glowing), surface=shapes.surface,
        )  # fmt: skip
    for column, seen in ((12, 1), (20, 0)):
        steps = lesson(camera, shapes, column, 16)
        text = "\n".join(steps.lines())
        assert ("transparent there" in text) == (seen == 1)
        assert ("emission (0, 0.25, 0)" in text) == (seen == 1)
        image = cast(camera, shapes, passes=("combined", "shape_index"), dtype=float)
        assert image["shape_index"][16, column] == seen
        np.testing.assert_array_equal(steps.color, image["combined"][16, column])
