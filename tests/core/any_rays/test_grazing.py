"""Rays within the planes of triangles and tangent to spheres, which begin on them: where rounding decides, a hit is on
its surface, and the same in any company.
"""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays import body_search
from camera_ray_caster.core.shapes.mesh.triangles import crossing

RANDOM = np.random.default_rng(12)
COUNT = 600
LATTICE = RANDOM.integers(-2, 3, (40, 3, 3)) / 3 + 100.7
TRIANGLES = crc.mesh(LATTICE.reshape(-1, 3), np.arange(120).reshape(-1, 3))
CENTERS, RADII = RANDOM.integers(-2, 3, (20, 3)) / 3 + 5.3, RANDOM.integers(1, 4, 20) / 3
SPHERES = crc.spheres(CENTERS, RADII)


def in_planes():
    """Origins at vertices, on edges, within triangles and beside them, and directions in their planes."""
    a, b, c = LATTICE[RANDOM.integers(40, size=COUNT)].swapaxes(0, 1)
    origin = np.choose(np.arange(COUNT)[:, None] % 4, (a, (a + b) / 2, (a + b + c) / 3, a - 3 * (b - a)))
    steps = RANDOM.integers(-3, 4, (2, COUNT, 1))
    direction = steps[0] * (b - a) + steps[1] * (c - a)
    moves = (direction != 0).any(axis=1)
    return origin[moves], direction[moves]


def tangents():
    """Origins on spheres, and tangents there; along axes for half of them."""
    outward = RANDOM.normal(size=(COUNT, 3))
    outward[::2] = np.eye(3)[RANDOM.integers(3, size=(COUNT + 1) // 2)]
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    direction = np.cross(outward, RANDOM.normal(size=(COUNT, 3)))
    direction[::4] = np.roll(outward, 1, axis=1)[::4]
    sphere = np.arange(COUNT) % 20
    return CENTERS[sphere] + RADII[sphere, None] * outward, direction


RAYS = {"in planes": (TRIANGLES, *in_planes()), "tangents": (SPHERES, *tangents())}


def cast(order, rays, **settings):
    """The nearest hit and all hits of each ray, as bytes by ray."""
    shapes, origin, direction = rays
    settings["passes"] = "depth", "face_index", "shape_index"
    nearest = crc.cast_rays(origin[order], direction[order], shapes, **settings)
    every = crc.cast_rays(origin[order], direction[order], shapes, all_hits=True, **settings)
    ends = np.cumsum(every["count"])[:-1]
    columns = [*nearest.values(), *(np.split(every[name], ends) for name in nearest)]
    return {ray: [column[k].tobytes() for column in columns] for k, ray in enumerate(order.tolist())}


@pytest.mark.parametrize("near", [0.0, 0.1, 0.5])
@pytest.mark.parametrize("kind", RAYS)
def test_grazing_rays_hit_the_same_in_any_company(monkeypatch, kind, near):
    count = len(RAYS[kind][1])
    monkeypatch.setattr("camera_ray_caster.core.any_rays.bundle.MOST_PAIRS", 1e9)
    monkeypatch.setattr(body_search, "BUNDLED", np.inf)
    by_tree = cast(np.arange(count), RAYS[kind], near=near)
    assert cast(RANDOM.permutation(count), RAYS[kind], near=near) == by_tree
    for ray in range(0, count, 30):
        assert cast(np.array([ray]), RAYS[kind], near=near)[ray] == by_tree[ray]
    monkeypatch.setattr(body_search, "BUNDLED", 0.0)
    assert cast(np.arange(count), RAYS[kind], near=near) == by_tree


def test_rays_in_a_plane_hit_a_triangle_where_it_is():
    shapes, origin, direction = RAYS["in planes"]
    hits = crc.cast_rays(origin, direction, shapes, passes=("position", "face_index"), all_hits=True)
    assert len(hits["position"]) > COUNT
    corners = LATTICE[hits["face_index"]]
    assert (hits["position"] >= corners.min(axis=1) - 1e-7).all()
    assert (hits["position"] <= corners.max(axis=1) + 1e-7).all()


def test_tangents_hit_a_sphere_where_it_is():
    shapes, origin, direction = RAYS["tangents"]
    hits = crc.cast_rays(origin, direction, shapes, passes=("position", "shape_index"), all_hits=True)
    assert len(hits["position"]) > COUNT
    away = np.linalg.norm(hits["position"] - CENTERS[hits["shape_index"]], axis=1)
    np.testing.assert_allclose(away, RADII[hits["shape_index"]], atol=1e-7)


def test_a_ray_without_all_of_its_direction_meets_no_plane():
    corners = LATTICE[0][:, :, None]
    for direction in ((np.nan, np.nan, -1.0), (1.0, np.nan, 0.0), (np.nan,) * 3):
        with np.errstate(all="ignore"):
            assert np.isnan(crossing(corners, None, np.array(direction)[:, None])).all()
