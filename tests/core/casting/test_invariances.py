"""What holds for any camera and any shapes: properties over random scenes, sizes and places."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.maths.exact import FLAT, invert
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE, BlenderCamera

from ...tiers import examples
from ..errors.extreme_cases import camera_from, pose, shapes_of
from ..truth import truth

PASSES = (
    "depth", "distance", "position", "normal", "shape_index", "ray_origin", "ray_direction",
    "distance_bound", "position_bound", "normal_bound",
)  # fmt: skip

numbers = st.floats(-1, 1, allow_subnormal=False).map(lambda value: value if abs(value) > 1e-30 else 0.0)
vectors = st.tuples(numbers, numbers, numbers)
exponents = st.floats(-4, 4)


@st.composite
def matrices(draw):
    """Axes that span space: a rotation, sizes over six decades, and some shear."""
    turn = rotation(draw(vectors), draw(st.floats(0, 2 * np.pi)))
    shear = np.eye(3) + 0.8 * np.triu(np.array([draw(vectors) for _ in range(3)]), 1)
    return turn @ shear @ np.diag([10 ** draw(st.floats(-2, 1)) * draw(st.sampled_from([-1, 1])) for _ in range(3)])


def rotation(axis, angle):
    """A rotation matrix, orthogonal to some EPS (Rodrigues)."""
    x, y, z = np.divide(axis, np.linalg.norm(axis)) if np.any(axis) else (0.0, 0.0, 1.0)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


@st.composite
def scenes(draw):
    """A camera, as Blender has it, and one to four shapes around it."""
    rows = []
    for _ in range(draw(st.integers(1, 4))):
        kind = draw(st.sampled_from([SPHERE, SPHERE, PLANE, INFINITE_PLANE]))
        axes = draw(matrices())
        if not invert(axes[None])[2][0] < FLAT / 1e6:
            axes = np.eye(3)
        rows.append((kind, 10 * np.array(draw(vectors)), axes))
    raw = BlenderCamera(
        name="Camera",
        type=draw(st.sampled_from(["PERSP", "ORTHO"])),
        matrix_world=pose(rotation(draw(vectors), draw(st.floats(0, 7))), 5 * np.array(draw(vectors))),
        lens=draw(st.floats(8, 100)), ortho_scale=draw(st.floats(1, 20)), resolution_x=8, resolution_y=6,
        clip_start=0.0078125, clip_end=2.0**40,
    )  # fmt: skip
    return raw, shapes_of(rows)


def pictures(raw, shapes):
    return cast(camera_from(raw), shapes, passes=PASSES, dtype=np.float64)


# the same for everyone: a failure is a change's
few = settings(max_examples=examples(100), deadline=None, derandomize=True)


@few
@given(scenes(), vectors, st.floats(0, 7), vectors)
def test_a_rigid_motion_of_everything_changes_no_distance(scene, axis, angle, move):
    raw, shapes = scene
    turn, move = rotation(axis, angle), 10 * np.array(move)
    moved_raw = replace(raw, matrix_world=pose(turn, move) @ raw.matrix_world)
    moved = replace(shapes, center=shapes.center @ turn.T + move, axes=turn @ shapes.axes)
    here, there = pictures(raw, shapes), pictures(moved_raw, moved)
    same = (here["shape_index"] == there["shape_index"]) & (here["shape_index"] >= 0)
    # the moved numbers are rounded, too: each by some EPS of 60, the farthest that anything is, as the bounds of casts
    # are of numbers a tenth of that
    bound = 10 * (here["distance_bound"] + there["distance_bound"])[same]
    assert (np.abs(here["distance"][same] - there["distance"][same]) <= bound + 60 * 64 * EPS).all()


@few
@given(scenes(), st.integers(-40, 40))
def test_a_scale_by_a_power_of_two_is_exact(scene, power):
    raw, shapes = scene
    sizes = np.abs(np.concatenate((shapes.axes.ravel(), raw.matrix_world.ravel())))
    assume(((sizes == 0) | (sizes > 1e-30)).all())  # no scale keeps what becomes subnormal exact
    k = 2.0**power
    matrix = raw.matrix_world.copy()
    matrix[:3, 3] *= k
    scaled_raw = replace(
        raw, matrix_world=matrix, ortho_scale=k * raw.ortho_scale, clip_start=k * raw.clip_start,
        clip_end=k * raw.clip_end,
    )  # fmt: skip
    axes = np.where((shapes.kind == INFINITE_PLANE)[:, None, None], 1.0, k) * shapes.axes
    here, there = pictures(raw, shapes), pictures(scaled_raw, replace(shapes, center=k * shapes.center, axes=axes))
    for name in ("depth", "distance", "position"):
        assert np.array_equal(k * here[name], there[name]), name
    for name in ("shape_index", "normal"):
        assert np.array_equal(here[name], there[name]), name


@few
@given(scenes())
def test_hits_lie_on_the_ray_and_on_the_shape_and_normals_face_the_ray(scene):
    raw, shapes = scene
    images = pictures(raw, shapes)
    for pixel in zip(*np.nonzero(images["shape_index"] >= 0), strict=True):
        position, bound = truth.exact(images["position"][pixel]), images["position_bound"][pixel]
        origin, direction = (truth.exact(images[name][pixel]) for name in ("ray_origin", "ray_direction"))
        along = truth.along(origin, direction, images["distance"][pixel])
        assert truth.norm(truth.minus(along, position)) <= bound + images["distance_bound"][pixel]

        k = images["shape_index"][pixel]
        to_shape = truth.inverse(truth.exact(shapes.axes[k]))
        q = truth.times(to_shape, truth.minus(position, truth.exact(shapes.center[k])))
        off = abs(truth.norm(q) - 1) if shapes.kind[k] == SPHERE else abs(q[2])
        size = truth.mp.sqrt(sum(truth.dot(row, row) for row in to_shape))
        assert off <= bound * size
        if shapes.kind[k] == PLANE:
            assert max(abs(q[0]), abs(q[1])) <= 1 + bound * size

        facing = images["normal"][pixel] @ images["ray_direction"][pixel]
        assert facing <= images["normal_bound"][pixel] + 4 * EPS
        assert abs(np.linalg.norm(images["normal"][pixel]) - 1) <= 8 * EPS


@few
@given(scenes())
def test_no_nearer_hit_exists(scene):
    raw, shapes = scene
    camera, images = camera_from(raw), pictures(raw, shapes)
    rows, columns = camera.raster.rows()[:, 0], camera.raster.columns()[0]
    for pixel in [(0, 0), (1, 6), (3, 4), (5, 2)]:
        ray = truth.ray(raw, columns[pixel[1]], rows[pixel[0]])
        exact = truth.nearest(shapes, ray, camera.clip_start, camera.clip_end)
        distance, bound = images["distance"][pixel], images["distance_bound"][pixel]
        if exact is None or images["shape_index"][pixel] < 0:
            continue  # hit or miss has its own test, with the bound of its decision
        nearer = distance - bound
        assert exact.distance >= nearer
