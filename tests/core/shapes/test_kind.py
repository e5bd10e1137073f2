"""A kind of shape is a file and a word: toy kinds are cast beside the others, against brute force."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core import tuning
from camera_ray_caster.core.any_rays.door import cast_rays
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.pixels import passes_at
from camera_ray_caster.core.lesson.meetings import EQUATIONS, meetings, nearest
from camera_ray_caster.core.motion.landmarks import lit
from camera_ray_caster.core.records import INFINITE_PLANE, MESH, SPHERE, InputError
from camera_ray_caster.core.report.accuracy import accuracy
from camera_ray_caster.core.report.indices import indices_of
from camera_ray_caster.core.report.omitted import omitted
from camera_ray_caster.core.shape_records import KIND_NAMES
from camera_ray_caster.core.shapes import kinds

from ..cameras.model_examples import camera as camera_of
from ..casting.test_cast import shapes_of
from .disc import DISCS
from .tetrahedron import FACES, OFFSETS, TETRAHEDRA

PASSES = "shape_index", "distance", "position", "normal", "uv", "distance_bound", "normal_bound", "combined"
SIZE = {"resolution_x": 36, "resolution_y": 28, "clip_end": 1e9}
MODELS = "PERSP", "ORTHO", "EQUIRECTANGULAR", "PUSHBROOM"
SHIPPED = kinds.SHAPE_KINDS


@pytest.fixture(autouse=True)
def toy_kinds(monkeypatch):
    """Two kinds more."""
    monkeypatch.setattr(kinds, "SHAPE_KINDS", (*kinds.SHAPE_KINDS, DISCS, TETRAHEDRA))


def scene(camera, seed):
    """Shapes of the toy kinds and spheres all over the picture, no corner of them in a pixel's center, and a wall."""
    rng = np.random.default_rng(seed)
    rays = camera.rays()
    rows = []
    for kind in [DISCS.number] * 6 + [TETRAHEDRA.number] * 6 + [SPHERE] * 3:
        j, i = rng.integers(3, 25), rng.integers(3, 33)
        center = rays.origins[j, i] + rng.uniform(3, 9) * rays.directions[j, i] + rng.uniform(-0.1, 0.1, 3)
        turned = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        rows.append((kind, center, rng.uniform(0.3, 0.9) if kind == SPHERE else turned * rng.uniform(0.5, 2, 3)))
    rows.append((INFINITE_PLANE, rays.origins[14, 18] + 12 * rays.directions[14, 18], camera.pose.basis))
    return shapes_of(*rows)


def crossings(kind, q, d):
    """Yield the distance at which a ray from q along d meets a shape in its own frame, and what the normal is there."""
    if kind == SPHERE:
        b, c = q @ d, q @ q - 1
        if b * b > d @ d * c:
            for root in (-1, 1):
                t = (-b + root * np.sqrt(b * b - d @ d * c)) / (d @ d)
                yield t, q + t * d, 0
        return
    planes = zip(FACES, OFFSETS, strict=True) if kind == TETRAHEDRA.number else [(np.array([0, 0, 1.0]), 0.0)]
    for number, (normal, offset) in enumerate(planes):
        t = (offset - normal @ q) / (normal @ d)
        p = q + t * d
        corner = kind == TETRAHEDRA.number and (p >= -1e-12).all() and p.sum() <= 1 + 1e-12
        if kind == INFINITE_PLANE or (kind == DISCS.number and p @ p <= 1) or corner:
            yield t, normal, number


def brute_force(shapes, inverses, origin, direction):
    """The nearest (distance, shape, normal, uv) along a ray, None where there is none; uv only of the toy kinds."""
    best = None
    for k, (kind, center, inverse) in enumerate(zip(shapes.kind, shapes.center, inverses, strict=True)):
        q, d = inverse @ (origin - center), inverse @ direction
        for t, gradient, number in crossings(kind, q, d):
            if t > 0.1 and (best is None or t < best[0]):
                normal = inverse.T @ gradient
                normal *= -np.sign(normal @ direction) / np.linalg.norm(normal)
                p = q + t * d
                uv = {DISCS.number: (p[:2] + 1) / 2, TETRAHEDRA.number: (number, p[0])}.get(int(kind))
                best = t, k, normal, uv
    return best


@pytest.mark.parametrize("key", MODELS)
@pytest.mark.parametrize("small", [1, 1 << 13], ids=["one by one", "in batches"])
def test_toy_kinds_are_cast_as_brute_force_finds_them(monkeypatch, key, small):
    monkeypatch.setattr(tuning, "SMALL_PIXELS", small)
    monkeypatch.setattr(tuning, "BLOCK_PIXELS", 400)
    monkeypatch.setattr(tuning, "SEARCHED_PIXELS", 200)
    camera = camera_of(key, SIZE)
    shapes = scene(camera, 3)
    images, rays = cast(camera, shapes, passes=PASSES, dtype=np.float64), camera.rays()
    inverses, met = np.linalg.inv(shapes.axes), set()
    for j, i in np.ndindex(images["shape_index"].shape):
        ray = rays.origins[j, i], rays.directions[j, i]
        nearest = brute_force(shapes, inverses, *ray) if rays.valid[j, i] else None
        if nearest is None:
            assert images["shape_index"][j, i] == -1, (j, i)
            continue
        distance, shape, normal, uv = nearest
        assert images["shape_index"][j, i] == shape, (j, i)
        bound = images["distance_bound"][j, i]
        assert 0 < bound < 1e-9 * max(distance, 20)
        assert abs(images["distance"][j, i] - distance) <= 2 * bound + 1e-14 * distance
        assert np.abs(images["normal"][j, i] - normal).max() <= images["normal_bound"][j, i] + 1e-12
        if uv is not None:
            assert images["uv"][j, i, :2] == pytest.approx(uv, abs=1e-9)
        met.add(int(shapes.kind[shape]))
    assert met == {DISCS.number, TETRAHEDRA.number, SPHERE, INFINITE_PLANE}


@pytest.mark.parametrize("key", MODELS)
def test_toy_kinds_are_culled_sampled_and_asked_at_given_pixels_as_all_others(key):
    camera = camera_of(key, SIZE)
    shapes = scene(camera, 3)
    culled, unculled = (cast(camera, shapes, passes=PASSES, dtype=np.float64, cull=cull) for cull in (True, False))
    columns, rows = np.array([3, 17, 30]), np.array([0, 14, 15, 27])
    some = passes_at(camera, shapes, columns, rows, PASSES)
    for name in PASSES:
        assert np.array_equal(culled[name], unculled[name]), name
        assert np.array_equal(some[name], culled[name][np.ix_(rows, columns)]), name
    assert accuracy(camera, shapes, culled.plan).worst("relative_distance") < 1e-11
    assert np.isfinite(cast(camera, shapes, passes=("combined",), samples=3)["combined"]).all()


def test_kinds_that_are_not_in_view_are_named():
    camera = camera_of("PERSP", SIZE)
    lines = "\n".join(omitted(cast(camera, shapes_of((DISCS.number, (0, 0, -5), 1.0)), passes=("depth",)).plan))
    others = ", ".join(kind.name for kind in kinds.SHAPE_KINDS if kind is not DISCS)
    assert f"kernels of {others}: no such shape" in lines
    assert "sphere, plane, infinite plane, mesh" in lines


def test_every_kind_that_ships_has_a_number_a_name_and_an_equation_of_its_own():
    numbers = [kind.number for kind in SHIPPED]
    free = min(set(range(len(numbers) + 1)) - set(numbers))
    for kind in SHIPPED:
        assert numbers.count(kind.number) == 1, f"the number {kind.number} of {kind.name} is taken: {free} is free"
        named = KIND_NAMES[kind.number : kind.number + 1] == (kind.name,)
        assert named, f"KIND_NAMES in core/shape_records.py has no {kind.name!r} at {kind.number}"
        assert kind.number in EQUATIONS, f"EQUATIONS in core/lesson/meetings.py has no equation of {kind.name}"
    assert len(EQUATIONS) == len(numbers)
    assert len({kind.name for kind in SHIPPED}) == len(SHIPPED)


@pytest.mark.parametrize("kind", [kind for kind in SHIPPED if kind.number != MESH], ids=lambda kind: kind.name)
def test_the_equation_of_a_kind_that_ships_meets_what_a_cast_meets(kind):
    camera = camera_of("PERSP", SIZE)
    turned = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0] * (0.9, 1.1, 1.0)
    shapes = shapes_of((kind.number, (0.2, 0.1, -6), turned))
    distance, rays = cast(camera, shapes, passes="distance", dtype=np.float64)["distance"], camera.rays()
    hits = {True: 0, False: 0}
    for j, i in np.ndindex(distance.shape):
        met = nearest(meetings(camera, shapes, rays.origins[j, i], rays.directions[j, i]))
        assert (met is None) == np.isinf(distance[j, i])
        hits[met is not None] += 1
        assert met is None or met[1].t == pytest.approx(distance[j, i], rel=1e-12)
    assert hits[True] > 20
    assert hits[False] > 20 or kind.number == INFINITE_PLANE


def test_reports_name_a_kind_by_its_number_not_by_its_place():
    shapes = shapes_of((TETRAHEDRA.number, (0, 0, -5), 1.0), (INFINITE_PLANE, (0, 0, -9), 1.0))
    assert [run["kind"] for run in indices_of(shapes)["shape_index"]] == ["TETRAHEDRON", "INFINITE_PLANE"]


def test_the_motion_of_a_kind_is_judged_by_the_corners_of_its_cube():
    points = lit((camera_of("PERSP", SIZE), shapes_of((TETRAHEDRA.number, (0, 0, -5), 1.0))))
    assert np.array_equal(points.min(axis=0), (-1, -1, -6))
    assert np.array_equal(points.max(axis=0), (1, 1, -4))


def test_bodies_are_what_rays_without_a_camera_meet():
    rays = (0.2, 0.2, 0), (0, 0, -1)
    assert cast_rays(*rays, shapes_of((DISCS.number, (0, 0, -5), 1.0)))["distance"] == 5
    with pytest.raises(InputError, match="do not meet shapes of the kind tetrahedron: leave these out"):
        cast_rays(*rays, shapes_of((TETRAHEDRA.number, (0, 0, -5), 1.0)))
