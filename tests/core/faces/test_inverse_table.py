"""The table of a camera's inverse, beside its projection of random directions."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.faces.faces import turn_of
from camera_ray_caster.core.faces.inverse_table import inverse_table

POSE = crc.look_at((1.0, 2.0, 3.0), (0.0, 0.5, 0.2))


def looked_up(table, directions):
    """Places of directions (n, 3) and whether they are known, by the four texels around."""
    side = table.texels.shape[0]
    x, y, z = directions.T
    across, up = ((values / (1 + abs(z)) / table.reach + 1) / 2 * side - 0.5 for values in (x, y))
    square = side * (z > 0)
    inside = (across >= 0) & (across < side - 1) & (up >= 0) & (up < side - 1) & (table.has_behind | (z <= 0))
    i, j = (np.where(inside, at, 0).astype(int) for at in (across, up))
    right, above = (across - i)[:, None], (up - j)[:, None]
    at = [[table.texels[j + k, i + square * inside + m] for m in (0, 1)] for k in (0, 1)]
    low, high = (row[0] * (1 - right) + row[1] * right for row in at)
    mean = low * (1 - above) + high * above
    return mean[:, :2], inside & (mean[:, 2] > 0.9999)


@pytest.mark.parametrize(("model", "error", "settings"), [
    ("FISHEYE_STEREOGRAPHIC", 1e-9, {}), ("OPENCV_FISHEYE", 0.05, {"fx": 150.0, "fy": 151.0, "cx": 160.0, "cy": 120.0}),
    ("DOME_MASTER", 0.05, {}), ("EQUIRECTANGULAR", 0.5, {}),
])  # fmt: skip
def test_places_between_texels_are_within_the_error(model, error, settings):
    camera = crc.camera(model, (320, 240), POSE, **settings)
    table, size = inverse_table(camera), np.array(camera.raster.size)
    assert table.error <= error
    directions = np.random.default_rng(1).normal(size=(20000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    wanted = camera.project(camera.pose.eye + directions @ turn_of(camera).T)
    places, known = looked_up(table, directions)
    seen = ((wanted > 1) & (wanted < size - 1)).all(axis=1)
    assert known[seen].mean() > 0.98
    assert np.abs(places * size - wanted)[seen & known].max() <= 1.1 * table.error + 1e-4  # and float32


def test_many_origins_are_refused():
    slit = [(0.0, 0.0, 8.0), (0.0, 1.0, 0.0)]
    with pytest.raises(crc.InputError, match="no single viewpoint"):
        inverse_table(crc.camera("PUSHBROOM", (32, 24), slit_1=slit))
