"""Volumes of rays and edges against exact fractions: with corners relative to the rays' origins, and with moments."""

from fractions import Fraction

import numpy as np
import pytest

from camera_ray_caster.core.maths.vector import cross
from camera_ray_caster.core.shapes.mesh.triangles import VOLUME_ROUNDING, edge_vectors, volumes

COUNT = 300


def exact(vector):
    return [Fraction(float(component)) for component in vector]


def exact_volume(a, b, o, d):
    """d . ((a - o) x (b - o)) of vectors of floats."""
    a, b, o, d = map(exact, (a, b, o, d))
    x, y, z = cross([p - q for p, q in zip(a, o, strict=True)], [p - q for p, q in zip(b, o, strict=True)])
    return d[0] * x + d[1] * y + d[2] * z


@pytest.mark.parametrize("spread", [1.0, 1e-3, 1e-9])
@pytest.mark.parametrize("away", [0.0, 1.0, 1e3])
def test_volumes_are_right_to_their_bound(spread, away):
    """Also of triangles that are small, far from the origins and nearly edge-on."""
    rng = np.random.default_rng(3)
    corners = rng.normal(size=(1, 3, COUNT)) + spread * rng.normal(size=(3, 3, COUNT))
    origin = away * rng.normal(size=(3, COUNT))
    d = corners.mean(axis=0) - origin + spread * rng.normal(size=(3, COUNT))
    length = np.linalg.norm(corners, axis=1).max(axis=0) + np.linalg.norm(origin, axis=0)
    bound = VOLUME_ROUNDING * np.linalg.norm(d, axis=0) * length**2
    rays = np.concatenate((d, cross(origin, d)))
    by_moments = (edge_vectors(corners, from_eye=False) * rays).sum(axis=1)
    for triple in (volumes(corners - origin, d), by_moments):
        for (i, j), volume in zip(((1, 2), (2, 0), (0, 1)), triple, strict=True):
            for k in range(COUNT):
                true = exact_volume(corners[i, :, k], corners[j, :, k], origin[:, k], d[:, k])
                assert abs(Fraction(float(volume[k])) - true) <= Fraction(float(bound[k]))
