"""The picture that stands for the program."""

from __future__ import annotations

from math import cos, pi, sin

from .parts import add, camera, ico_sphere, lamp, points, render, spheres_of_points, square, sun, uv_sphere


def spheres_and_planes(scene):
    """every kind of shape at once: UV and ico spheres, ellipsoids, a point cloud, a floor and walls, two lights."""
    wide = (7, 5, 1)
    add(scene, "Floor", square(), (0, 0, 0), scale=wide, colour="c9cdd2", index=1)
    add(scene, "Back wall", square(), (-2.2, 5, 2.6), (90, 0, 0), (4.8, 2.6, 1), colour="8fa3b5", index=2)
    add(scene, "Side wall", square(), (-7, 0, 1.6), (90, 0, 90), (5, 1.6, 1), colour="a7b59e", index=3)

    add(scene, "Planet", uv_sphere(), (-1.4, 1.2, 1.6), scale=(1.6,) * 3, colour="d8694c", index=4)
    add(scene, "Ico sphere", ico_sphere(), (1.5, 0.1, 0.9), scale=(0.9,) * 3, colour="2f8f8b", index=5)
    add(scene, "Coarse ico sphere", ico_sphere(2), (3.1, -1.3, 0.5), scale=(0.5,) * 3, colour="e3b448", index=6)
    add(scene, "Pebble", uv_sphere(), (-0.3, -1.9, 0.4), scale=(0.85, 0.6, 0.4), colour="e9e3d5", index=7)
    add(scene, "Egg", uv_sphere(), (3.4, 1.9, 1.45), (0, 24, 20), (0.62, 0.62, 1.55), colour="7d5ba6", index=8)
    add(scene, "Marble", uv_sphere(24, 12), (-2.6, -1.7, 0.36), scale=(0.36,) * 3, colour="3a6ea5", index=9)
    add(scene, "Bead", ico_sphere(), (1.0, -2.3, 0.24), scale=(0.24,) * 3, colour="c8553d", index=10)
    add(scene, "Far ball", uv_sphere(), (-5.0, 3.0, 0.8), scale=(0.8,) * 3, colour="ddb967", index=11)

    count = 84
    angles = [2 * pi * k / count for k in range(count)]
    ring = points(
        [(2.45 * cos(angle), 2.45 * sin(angle), 0) for angle in angles],
        [0.07 + 0.045 * sin(3 * angle) for angle in angles],
    )
    spheres_of_points(add(scene, "Ring", ring, (-1.4, 1.2, 1.6), (18, 14, 0), colour="f2e9dc", index=12))

    sun(scene, (38, -28, 0), 1.7, "fff1dc")
    lamp(scene, (3.5, -4, 4), 160, "ffd9b0")
    camera(scene, (1.2, -11.5, 3.3), (0.1, 0, 1.35), lens=45)
    render(scene, 1920, 1080, world="b9c6d3")
