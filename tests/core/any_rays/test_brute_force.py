"""Rays beside a plain test of every triangle, and rays that aim at edges and vertices of a closed surface."""

import numpy as np
import pytest

import camera_ray_caster as crc

CLEAR = 1e-9
"""Distance from an edge, in barycentric coordinates, beyond which float64 cannot decide otherwise."""


def bumpy_ball(rows=24, columns=40):
    """Vertices (n, 3) and triangles (k, 3) of a closed surface around the origin, which folds over itself."""
    u, v = np.meshgrid(np.arange(columns) * 2 * np.pi / columns, np.linspace(0, np.pi, rows + 1)[1:-1])
    radius = 1 + 0.35 * np.sin(5 * u) * np.sin(v) * np.cos(4 * v)
    ring = np.stack((radius * np.sin(v) * np.cos(u), radius * np.sin(v) * np.sin(u), radius * np.cos(v)), axis=-1)
    vertices = np.concatenate((ring.reshape(-1, 3), ((0, 0, 1), (0, 0, -1)))).astype(np.float32)
    at = np.arange(rows - 1)[:, None] * columns + np.arange(columns)
    on = np.roll(at, -1, axis=1)
    caps = [(at[0], on[0], np.full(columns, len(vertices) - 2)), (on[-1], at[-1], np.full(columns, len(vertices) - 1))]
    sides = [(at[:-1], at[1:], on[1:]), (at[:-1], on[1:], on[:-1])]
    return vertices, np.concatenate([np.stack(three, axis=-1).reshape(-1, 3) for three in sides + caps])


VERTICES, FACES = bumpy_ball()
BALL = crc.mesh(VERTICES, FACES)


def crossings(origin, direction):
    """t of every crossing of rays (n, 3) with every triangle, (n, k), inf for none; and which rays pass no edge."""
    a, b, c = (VERTICES.astype(float)[corner] for corner in FACES.T)
    normal = np.cross(b - a, c - a)
    t = ((a * normal).sum(1) - origin @ normal.T) / (direction @ normal.T)
    point = origin[:, None] + t[..., None] * direction[:, None]
    area = (normal * normal).sum(1)
    parts = [(np.cross(end - start, point - start) * normal).sum(2) / area for start, end in ((a, b), (b, c), (c, a))]
    inner = np.min(parts, axis=0)
    return np.where((inner >= 0) & (t >= 0), t, np.inf), (np.abs(inner) > CLEAR).all(axis=1)


@pytest.mark.full
def test_random_rays_beside_a_plain_test_of_each_triangle():
    rng = np.random.default_rng(3)
    for _ in range(20):
        origin, direction = rng.uniform(-2, 2, (500, 3)), rng.normal(size=(500, 3))
        t, clear = crossings(origin, direction)
        assert clear.mean() > 0.99
        nearest, hits = t.min(axis=1), np.isfinite(t).sum(axis=1)
        images = crc.cast_rays(origin, direction, BALL, passes=("depth", "face_index"))
        hit = clear & np.isfinite(nearest)
        np.testing.assert_array_equal(np.isfinite(images["depth"])[clear], np.isfinite(nearest)[clear])
        np.testing.assert_allclose(images["depth"][hit], nearest[hit], rtol=1e-11)
        np.testing.assert_array_equal(images["face_index"][hit], t.argmin(axis=1)[hit])
        every = crc.cast_rays(origin, direction, BALL, passes="depth", all_hits=True)
        np.testing.assert_array_equal(every["count"][clear], hits[clear])
        ordered = np.sort(t, axis=1)
        for ray in np.flatnonzero(clear & (hits > 1))[:50]:
            np.testing.assert_allclose(every["depth"][every["ray"] == ray], ordered[ray, : hits[ray]], rtol=1e-11)
        reach = rng.uniform(0.5, 3, (500, 1))
        hidden = crc.occluded(origin, origin + reach * direction, BALL)
        away = clear & (np.abs(t - reach).min(axis=1) > CLEAR)
        np.testing.assert_array_equal(hidden[away], (nearest < reach[:, 0])[away])


@pytest.mark.full
def test_no_ray_slips_through_an_edge_or_a_vertex():
    """A million and a half, from within a closed surface at points on its edges and at its vertices, which hit it there
    or before, and from outside through these places.
    """
    rng, count = np.random.default_rng(4), 1 << 18
    corners = VERTICES.astype(float)[FACES]
    for kind in ("edges", "vertices", "next to vertices"):
        which, first = rng.integers(len(FACES), size=count), rng.integers(3, size=count)
        share = np.zeros(count) if kind == "vertices" else rng.uniform(size=count)
        share = 10 ** (14 * share - 17) if kind == "next to vertices" else share
        start, end = corners[which, first], corners[which, (first + 1) % 3]
        aim = start + share[:, None] * (end - start)
        origin = rng.uniform(-0.2, 0.2, (count, 3))
        hits = crc.cast_rays(origin, aim - origin, BALL, passes=("depth", "valid"))
        assert (hits["depth"] <= 1 + 1e-9).all(), kind
        outside = 3 * aim / np.linalg.norm(aim, axis=1, keepdims=True)
        hits = crc.cast_rays(outside, origin - outside, BALL, passes="depth")
        assert (hits["depth"] < 1).all(), kind
