"""What a scene does not need is not done: shown by taking it away, and by pictures that are the same without it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core import tuning
from camera_ray_caster.core.camera.camera import Camera
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting import hit_values, target
from camera_ray_caster.core.casting.passes import PASSES
from camera_ray_caster.core.casting.request import SHADINGS
from camera_ray_caster.core.motion.evaluations import Motion
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE
from camera_ray_caster.core.shapes.plane import Plane
from camera_ray_caster.core.shapes.sphere import Sphere

from ..cameras.model_examples import camera as camera_of
from .neighbors import at_rest
from .test_cast import camera_at, random_shapes, shapes_of

BALLS = shapes_of(*[(SPHERE, (x, y, -6 - x), 0.4) for x in range(-3, 4) for y in range(-3, 4)])
WALLS = shapes_of((PLANE, (0, 0, -5), 2.0), (INFINITE_PLANE, (0, -1, 0), [[1, 0, 0], [0, 0, 1], [0, -1, 0]]))
EVERY = "depth", "normal", "position", "uv", "object_index", "shape_index", "distance_bound"


def forbidden(*_, **__):
    raise AssertionError("this was not needed")


@pytest.mark.parametrize(("shapes", "other"), [(BALLS, Plane), (WALLS, Sphere)])
def test_kinds_that_are_not_there_are_not_tested(monkeypatch, shapes, other):
    for name in ("constants", "intersect", "normals", "errors"):
        monkeypatch.setattr(other, name, forbidden)
    images = cast(camera_at(), shapes, passes=EVERY)
    assert (images["shape_index"] >= 0).any()


def test_a_kind_out_of_view_is_not_tested(monkeypatch):
    monkeypatch.setattr(Plane, "intersect", forbidden)
    behind = shapes_of((SPHERE, (0, 0, -6), 1.0), (PLANE, (0, 0, 5), 2.0), (PLANE, (90, 0, -5), 2.0))
    images = cast(camera_at(), behind, passes=EVERY)
    assert images.plan.unseen == 2
    assert set(np.unique(images["shape_index"])) == {-1, 0}


@pytest.mark.parametrize("passes", [("depth",), ("depth", "shape_index")])
def test_depth_needs_no_normals_error_bounds_indices_and_colors(monkeypatch, passes):
    monkeypatch.setattr(target, "normal_table", forbidden)
    monkeypatch.setattr(hit_values, "HitErrors", forbidden)
    bare = replace(BALLS, object_index=None, material_index=None, color=None)
    assert list(cast(camera_at(), bare, passes=passes)) == list(passes)


def test_the_clip_end_is_asked_only_where_something_reaches_beyond_it():
    ball = shapes_of((SPHERE, (0, 0, -5), 1.0))
    for end, clips, hit in ((100.0, False, 4.0), (5.5, True, 4.0), (3.9, False, np.inf)):
        images = cast(camera_at(clip_end=end), ball, passes=("depth",), dtype=np.float64)
        assert images.plan.clips is clips
        assert images["depth"][16, 16] == hit
    walls = shapes_of((PLANE, (0, 0, -5), [[9, 0, 0], [0, 1, -1], [0, 1, 1]]))  # it rises towards the camera
    images = cast(camera_at(clip_end=5.0), walls, passes=("depth", "shape_index"), dtype=np.float64)
    assert images.plan.clips
    assert images["depth"][np.isfinite(images["depth"])].max() <= 5.0
    assert ((images["shape_index"] >= 0) == np.isfinite(images["depth"])).all()
    whole = cast(camera_at(), walls, passes=("shape_index",))["shape_index"] == 0
    assert 0 < np.isfinite(images["depth"]).sum() < whole.sum()


def test_position_needs_no_normals(monkeypatch):
    monkeypatch.setattr(target, "normal_table", forbidden)
    assert np.isfinite(cast(camera_at(), BALLS, passes=("position",))["position"]).all()


def test_one_sample_needs_no_lens_and_one_time_no_motion(monkeypatch):
    monkeypatch.setattr(Camera, "sample_rays", forbidden)
    monkeypatch.setattr(Camera, "at", forbidden)
    monkeypatch.setattr(Motion, "at", forbidden)
    assert np.isfinite(cast(camera_at(), BALLS, passes=("combined",))["combined"]).all()


def test_normals_of_near_balls_come_with_unit_length_and_only_those_of_far_ones_are_given_it():
    near, far = (shapes_of((SPHERE, (0, 0, -distance), 1.0)) for distance in (50.0, 1e6))
    for shapes, unit in ((near, True), (far, False)):
        camera = camera_at(lens=18.0 * -shapes.center[0, 2] / 2, clip_end=1e7)
        images = cast(camera, shapes, passes=("normal", "shape_index"), dtype=np.float64)
        assert images.plan.target.normals.unit is unit
        length = np.linalg.norm(images["normal"], axis=-1)[images["shape_index"] >= 0]
        assert length.size > 100
        assert np.abs(length - 1).max() < 1e-12


@pytest.mark.parametrize("shading", SHADINGS)
@pytest.mark.parametrize(
    "shapes",
    [
        BALLS,
        shapes_of((SPHERE, (0, 0, -5), [[2, 0, 0], [0, 1, 0], [0, 0, 1]]), (SPHERE, (1, 1, -4), 0.5)),
        shapes_of((SPHERE, (0, 0, 0), 3.0), (SPHERE, (0, 0, -2), 0.5)),
        random_shapes(np.random.default_rng(5), 30),
    ],
    ids=["balls", "an ellipsoid and a ball", "around the eye", "all kinds"],
)
def test_a_pass_is_the_same_alone_and_among_all_others(shapes, shading):
    """Passes share working arrays: none may find what another left there."""
    camera, shapes = at_rest(camera_at(), shapes)
    every = cast(camera, shapes, passes=tuple(PASSES), dtype=np.float64, shading=shading)
    backwards = cast(camera, shapes, passes=tuple(reversed(PASSES)), dtype=np.float64, shading=shading)
    for name in PASSES:
        assert np.array_equal(backwards[name], every[name], equal_nan=True), name
        alone = cast(camera, shapes, passes=(name,), dtype=np.float64, shading=shading)[name]
        assert np.array_equal(alone, every[name], equal_nan=True), name


@pytest.mark.parametrize("key", ["PERSP", "ORTHO", "EQUIRECTANGULAR", "PUSHBROOM"])
def test_passes_made_in_many_blocks_are_those_made_at_once(monkeypatch, key):
    camera = camera_of(key, {"resolution_x": 64, "resolution_y": 80})
    camera, shapes = at_rest(camera, random_shapes(np.random.default_rng(3), 40))
    once = cast(camera, shapes, passes=tuple(PASSES), dtype=np.float64)
    monkeypatch.setattr(tuning, "BLOCK_PIXELS", 300)
    for order in (tuple(PASSES), tuple(reversed(PASSES))):
        for name, image in cast(camera, shapes, passes=order, dtype=np.float64).items():
            assert np.array_equal(image, once[name], equal_nan=True), name


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
def test_a_row_a_column_and_a_pixel_are_those_of_the_picture(model):
    """Bit for bit, though whether rays are a row and a column, or shapes small, then differs."""
    camera = camera_of(model.key, {"resolution_x": 64, "resolution_y": 80})
    shapes = random_shapes(np.random.default_rng(3), 40)
    whole = cast(camera, shapes, passes=EVERY, dtype=np.float64)
    for rows, columns in ((slice(33, 34), slice(0, 64)), (slice(0, 80), slice(21, 22)), (slice(50, 51), slice(40, 41))):
        edges = {"x0": columns.start, "x1": columns.stop, "y0": rows.start, "y1": rows.stop}
        alone = cast(replace(camera, raster=replace(camera.raster, **edges)), shapes, passes=EVERY, dtype=np.float64)
        for name in EVERY:
            assert np.array_equal(alone[name], whole[name][rows, columns], equal_nan=True), name


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.key)
@pytest.mark.parametrize("seed", range(2))
def test_every_model_sees_the_same_with_and_without_culling(model, seed):
    """Large shapes, and small ones, which are cast in batches: without culling all are as large as the picture. A scene
    whose large shapes hide all small ones is drawn again.
    """
    rng = np.random.default_rng([seed, *map(ord, model.key)])
    camera = camera_of(model.key, {"resolution_x": 96, "resolution_y": 64})
    for _ in range(5):
        large = random_shapes(rng, 12)
        dust = shapes_of(*[(SPHERE, rng.normal(size=3) * 6, rng.uniform(0.02, 0.2)) for _ in range(300)])
        shapes = type(large)(**{
            name: np.concatenate((getattr(large, name), getattr(dust, name)))
            for name in ("kind", "center", "axes", "object_index", "material_index", "color", "name_index")
        })  # fmt: skip
        culled, unculled = (cast(camera, shapes, passes=EVERY, dtype=np.float64, cull=cull) for cull in (True, False))
        for name in EVERY:
            assert np.array_equal(culled[name], unculled[name], equal_nan=True), name
        if (culled["shape_index"] > 12).any():
            return
    pytest.fail("no small shape is seen in five scenes")
