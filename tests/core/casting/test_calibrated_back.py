"""A chessboard is cast through three lenses, and OpenCV's calibration finds the lenses again in the pictures.

Corners found in gray pictures err by 0.04 pixels (cv2.cornerSubPix), more than what is asked here: so the pictures tell
of each pixel which place of the board it sees, as the screens do that laboratories calibrate with.
"""

import cv2
import numpy as np
import pytest

import camera_ray_caster as crc

COLUMNS, ROWS, SIDE = 11, 8, 0.1
SIZE = 640, 480
NEAR = 0.01
"""Pixels."""
LENSES = {
    "wide": ("OPENCV_PINHOLE", 0.9, {"fx": 500.0, "fy": 505.0, "k1": -0.2, "k2": 0.05, "p1": 1e-3, "p2": -5e-4}),
    "long": ("OPENCV_PINHOLE", 1.6, {"fx": 900.0, "fy": 898.0, "k1": 0.05, "k2": -0.1, "p1": -1e-3, "p2": 5e-4}),
    "fisheye": ("OPENCV_FISHEYE", 0.5, {"fx": 260.0, "fy": 261.0, "k1": 0.02, "k2": -0.004, "k3": 1e-3, "k4": -2e-4}),
}
"""Model, distance from the board, settings."""


def board():
    """Black and white squares in the plane z = 0, its middle the origin."""
    u, v = np.meshgrid(np.arange(COLUMNS + 1), np.arange(ROWS + 1))
    places = np.stack(((u - COLUMNS / 2) * SIDE, (v - ROWS / 2) * SIDE, 0.0 * u), axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    squares = (j * (COLUMNS + 1) + i)[..., None] + np.array((0, 1, COLUMNS + 2, COLUMNS + 1))
    even = (i + j) % 2 == 0
    return crc.join(crc.mesh(places, squares[even], name="black"), crc.mesh(places, squares[~even], name="white"))


def views(name, count=14):
    """Of each picture: places of the board (n, 3), and the pixels that see them (n, 2), OpenCV's, every eighth."""
    model, distance, settings = LENSES[name]
    random, shapes = np.random.default_rng(5), board()
    for _ in range(count):
        towards = random.normal(size=3) * (0.5, 0.5, 0) + (0, 0, 1)
        eye = towards / np.linalg.norm(towards) * distance * random.uniform(0.8, 1.2)
        pose = crc.look_at(eye, random.uniform(-0.2, 0.2, 3) * (1, 1, 0), up=(random.normal() * 0.3, 1, 0))
        camera = crc.camera(model, SIZE, pose, cx=322.3, cy=236.1, **settings)
        images = crc.cast(camera, shapes, passes=("position", "shape_index"), dtype=np.float64)
        seen = np.zeros(SIZE[::-1], bool)
        seen[::8, ::8] = images["shape_index"][::8, ::8] >= 0
        rows, columns = np.nonzero(seen)
        yield images["position"][seen], np.stack((columns, SIZE[1] - 1.0 - rows), axis=-1)


@pytest.mark.full
@pytest.mark.parametrize("name", LENSES)
def test_opencv_finds_the_lens_again(name):
    model, _, settings = LENSES[name]
    places, pixels = zip(*views(name), strict=True)
    guess = np.array([[settings["fx"] * 1.1, 0, 319.5], [0, settings["fx"] * 1.1, 239.5], [0, 0, 1.0]])
    if model == "OPENCV_PINHOLE":
        views_seen = [np.float32(array) for array in places], [np.float32(array) for array in pixels]
        flags = cv2.CALIB_FIX_K3 | cv2.CALIB_USE_INTRINSIC_GUESS
        _, K, D, *_ = cv2.calibrateCamera(*views_seen, SIZE, guess, np.zeros(5), flags=flags)
        names = ("k1", "k2", "p1", "p2")
    else:
        views_seen = [array[None] for array in places], [array[None] for array in pixels]
        names = vars(cv2.fisheye if hasattr(cv2.fisheye, "CALIB_FIX_SKEW") else cv2)  # OpenCV 5 has them in cv2
        flags = names["CALIB_USE_INTRINSIC_GUESS"] | names["CALIB_RECOMPUTE_EXTRINSIC"] | names["CALIB_FIX_SKEW"]
        _, K, D, *_ = cv2.fisheye.calibrate(*views_seen, SIZE, guess, np.zeros(4), flags=flags)
        names = ("k1", "k2", "k3", "k4")
    expected = [settings["fx"], settings["fy"], 322.3, 236.1]
    np.testing.assert_allclose((K[0, 0], K[1, 1], K[0, 2], K[1, 2]), expected, atol=NEAR)
    terms = dict(zip(names, D.ravel().tolist(), strict=False))
    theirs = crc.camera(model, SIZE, fx=K[0, 0], fy=K[1, 1], cx=K[0, 2], cy=K[1, 2], **terms)
    ours = crc.camera(model, SIZE, cx=322.3, cy=236.1, **settings)
    rays = ours.rays()
    away = np.linalg.norm(theirs.project(rays.directions[rays.valid]) - np.argwhere(rays.valid)[:, ::-1] - 0.5, axis=1)
    assert np.nanmax(away) <= NEAR
