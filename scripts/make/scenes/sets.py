"""The two places of most pictures in the gallery, so that cameras can be compared."""

from __future__ import annotations

from math import cos, degrees, pi, sin

import bpy

from .parts import add, camera, ico_sphere, render, square, sun, uv_sphere

BALLS = (
    ("Red", (0, 3.2, 1.3), 1.3, "e2674a"),
    ("Teal", (2.9, 1.6, 0.9), 0.9, "2a9d8f"),
    ("Yellow", (-2.4, 1.2, 0.7), 0.7, "f0b941"),
    ("Blue", (-4.3, -1.6, 1.1), 1.1, "3f7cc0"),
    ("Cream", (4.4, -2.2, 1.2), 1.2, "eae1d0"),
    ("Purple", (-1.8, -4.6, 0.9), 0.9, "8a63b8"),
    ("Lamp", (1.4, 0.6, 4.6), 0.5, "f2a65a"),
    ("Moon", (-2.2, 3.0, 4.2), 0.7, "c65d7b"),
)
"""Name, center, radius and color of each ball in the room."""


def room(scene) -> None:
    """Fill the scene with a room, |x| <= 6, |y| <= 6, 0 <= z <= 6: panels with square grid cells of 1/2, and balls."""
    panels = (
        ("Front", (0, 6, 3), (90, 0, 0), "8fabc4"),
        ("Back", (0, -6, 3), (90, 0, 180), "c3a5a0"),
        ("Left", (-6, 0, 3), (90, 0, 90), "a3bfa8"),
        ("Right", (6, 0, 3), (90, 0, -90), "d6b98c"),
        ("Floor", (0, 3, 0), (0, 0, 0), "ddd6c9"),
        ("Floor", (0, -3, 0), (0, 0, 0), "ddd6c9"),
        ("Ceiling", (0, 3, 6), (180, 0, 0), "eceae6"),
        ("Ceiling", (0, -3, 6), (180, 0, 0), "eceae6"),
    )
    for index, (name, location, turn, color) in enumerate(panels, 1):
        overlapping = 6.001, 3.001, 1  # so that no ray escapes between panels
        add(scene, name, square(), location, turn, overlapping, color=color, index=index)
    for index, (name, location, radius, color) in enumerate(BALLS, len(panels) + 1):
        add(scene, name, uv_sphere(), location, (12 * index, 0, 31 * index), radius, color=color, index=index)
    sun(scene, (40, 0, -38), 2.0, "fff0d9")
    sun(scene, (140, 0, 140), 1.0, "dfe9ff")


def clear_middle(scene) -> None:
    """Remove the balls in the middle of the room, to make space for other objects."""
    for name in ("Red", "Teal", "Yellow", "Lamp"):
        bpy.data.objects.remove(scene.objects[name])


def meadow(scene) -> None:
    """Fill the scene with an infinite ground, grid cells of 2, a ring of trees around the origin, hills and clouds."""
    ground = add(scene, "Ground", square(), scale=(24, 12, 1), color="a9c08a", index=1)
    ground.camera_ray_caster.primitive = "INFINITE_PLANE"
    for k in range(11):
        angle, away = 2 * pi * (k + 0.3) / 11, 9 + 2.5 * sin(2.4 * k)
        x, y, tall = away * cos(angle), away * sin(angle), 1.7 + 0.5 * sin(1.7 * k)
        crown = ("4f8f63", "6fa35a", "d98a4a")[k % 3]
        add(scene, "Trunk", ico_sphere(), (x, y, 1), scale=(0.22, 0.22, 1.4), color="8a6a52", index=2)
        add(scene, "Tree", uv_sphere(), (x, y, 1.6 + tall), scale=(1.2, 1.2, tall), color=crown, index=3)
    for k in range(9):
        angle, wide = 2 * pi * k / 9, 11 + 3 * sin(2 * k)
        location = 34 * cos(angle), 34 * sin(angle), -1
        add(scene, "Hill", uv_sphere(), location, scale=(wide, wide, 6 + 2 * cos(3 * k)), color="7fa08c", index=4)
    for k in range(7):
        angle = 2 * pi * (k + 0.5) / 7
        location = 30 * cos(angle), 30 * sin(angle), 15 + 3 * sin(3 * k)
        add(scene, "Cloud", uv_sphere(), location, (90, 0, degrees(angle)), (3.2, 2.2, 6), color="fbfbf8", index=5)
    sun(scene, (42, 0, -40), 2.2, "fff3df")


def photograph(
    scene,
    location,
    target,
    width: int = 480,
    height: int = 300,
    *,
    world="9aa0aa",
    addon=None,
    shading="GRID",
    **settings,
):
    """Set up the picture: add the camera, with its settings in ``addon``, and set size, shading, 16 samples."""
    made = camera(scene, location, target, **settings)
    for name, value in (addon or {}).items():
        setattr(made.data.camera_ray_caster, name, value)
    render(scene, width, height, world)
    scene.render.image_settings.compression = 100
    scene.camera_ray_caster.shading, scene.camera_ray_caster.samples = shading, 16
    return made
