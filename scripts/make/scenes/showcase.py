"""The main picture of the project."""

from __future__ import annotations

from math import cos, pi, sin

from .parts import add, camera, ico_sphere, lamp, points, render, spheres_of_points, square, sun, uv_sphere


def spheres_and_planes(scene):
    """The scene has every kind of shape: UV and ico spheres, ellipsoids, a point cloud, a floor and walls. There are
    two lights.
    """
    add(scene, "Floor", square(), (0, 0, 0), scale=(7, 6, 1), color="d9d2c6", index=1)
    add(scene, "Back wall", square(), (-1.5, 6, 1.5), (90, 0, 0), (5.5, 1.5, 1), color="64819f", index=2)
    add(scene, "Side wall", square(), (-7, 1.5, 1.5), (90, 0, 90), (4.5, 1.5, 1), color="9db5a2", index=3)

    add(scene, "Planet", uv_sphere(), (-1.5, 1.4, 1.6), scale=1.6, color="e2674a", index=4)
    add(scene, "Ico sphere", ico_sphere(), (1.45, -0.2, 0.9), scale=0.9, color="2a9d8f", index=5)
    add(scene, "Coarse ico sphere", ico_sphere(2), (2.9, -1.9, 0.5), scale=0.5, color="f0b941", index=6)
    add(scene, "Pebble", uv_sphere(), (-0.45, -2.1, 0.4), scale=(0.85, 0.6, 0.4), color="eae1d0", index=7)
    add(scene, "Egg", uv_sphere(), (4.0, 1.9, 1.45), (0, 24, 20), (0.62, 0.62, 1.55), color="8a63b8", index=8)
    add(scene, "Marble", uv_sphere(24, 12), (-2.9, -1.5, 0.4), scale=0.4, color="3f7cc0", index=9)
    add(scene, "Bead", ico_sphere(), (1.05, -2.7, 0.26), scale=0.26, color="d14b5a", index=10)
    add(scene, "Far ball", uv_sphere(), (-5.2, 3.2, 0.85), scale=0.85, color="e0c070", index=11)

    count = 84
    angles = [2 * pi * k / count for k in range(count)]
    ring = points(
        [(2.45 * cos(angle), 2.45 * sin(angle), 0) for angle in angles],
        [0.075 + 0.045 * sin(3 * angle) for angle in angles],
    )
    spheres_of_points(add(scene, "Ring", ring, (-1.5, 1.4, 1.6), (14, 16, 0), color="f1e8d8", index=12))

    sun(scene, (46, 0, -46), 2.1, "fff0d9")
    lamp(scene, (4.5, -3.5, 4.0), 105, "ffd2a1")
    camera(scene, (1.4, -11.5, 4.0), (0.05, 0, 1.4), lens=42)
    render(scene, 1920, 1080, world="a3b8cd")
