"""Time as a dimension of the picture: each row, column or pixel has its own frame. Drivers move the scene."""

from __future__ import annotations

from math import cos, pi, radians, sin

import bpy
import numpy as np

from .parts import add, square, uv_sphere
from .sets import clear_middle, photograph, room

STAND, AHEAD = (0, -5.4, 2.6), (0, 6, 2.6)


def driven(thing, path: str, axis: int, expression: str) -> None:
    """Drive a coordinate of an object by an expression of ``frame``."""
    thing.driver_add(path, axis).driver.expression = expression


def tower(scene, location, half: float = 1.1, high: float = 2.4):
    """Add a square tower of four walls; return the empty that turns it."""
    axis = add(scene, "Tower", None, location)
    for k, color in enumerate(("e2674a", "f0b941", "2a9d8f", "8a63b8")):
        angle = pi / 2 * k
        side = half * sin(angle), -half * cos(angle), high
        turn, scale = (90, -90, 90 * k), (high, half, 1)
        add(scene, "Wall", square(), side, turn, scale, color=color, index=20 + k, parent=axis)
    return axis


def slit_scan_rows(scene):
    """Each row is later than the row below it. A square tower that turns once in 48 frames appears as a twisted column.
    """
    room(scene)
    clear_middle(scene)
    driven(tower(scene, (0, 1.8, 0.3)), "rotation_euler", 2, f"frame * {pi / 24:.6f}")
    settings = {"time_mode": "ROWS", "time_start": 1, "time_end": 37}
    photograph(scene, STAND, AHEAD, addon=settings, lens=22)


def slit_scan_columns(scene):
    """Each column is later than the one on its left. Balls that move with the scan are stretched, and those that move
    against it are narrowed.
    """
    room(scene)
    clear_middle(scene)
    flights = (4.5, 0.22, "e2674a"), (3.2, 0.11, "f0b941"), (1.9, 0.0, "eae1d0"), (0.62, -0.3, "2a9d8f")
    for index, (height, speed, color) in enumerate(flights, 30):
        ball = add(scene, "Ball", uv_sphere(), (0, 0.2, height), (0, 0, 40), 0.62, color=color, index=index)
        driven(ball, "location", 0, f"(frame - 13) * {speed}")
    settings = {"time_mode": "COLUMNS", "time_start": 1, "time_end": 25}
    photograph(scene, STAND, AHEAD, addon=settings, lens=22)


def time_displacement(scene):
    """A grayscale image of rings sets the frame of each pixel, from early (black) to late (white). A turning tower
    looks as if seen through water.
    """
    room(scene)
    clear_middle(scene)
    driven(tower(scene, (0, 1.8, 0.3)), "rotation_euler", 2, f"frame * {pi / 24:.6f}")
    settings = {"time_mode": "IMAGE", "time_image": rings(240, 150), "time_start": 1, "time_end": 7}
    photograph(scene, STAND, AHEAD, addon=settings, lens=22)


def rings(width: int, height: int):
    """Return a packed image of three waves from its center to its sides, in 32 grays: each gray needs its own cast."""
    y, x = np.mgrid[:height, :width]
    away = np.hypot(x + 0.5 - width / 2, y + 0.5 - height / 2) / (width / 2)
    gray = np.rint((1 - np.cos(6 * pi * away)) / 2 * 31) / 31
    image = bpy.data.images.new("Rings", width, height)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(np.stack((gray, gray, gray, np.ones_like(gray)), axis=-1).astype(np.float32).ravel())
    image.pack()
    return image


def rolling_shutter(scene):
    """The sensor reads its rows one after another. The blades of a fan that turns once in two frames look bent and
    differ in width.
    """
    room(scene)
    clear_middle(scene)
    fan = add(scene, "Fan", None, (0, 1.5, 2.7), (90, 0, 0))
    for k in range(5):
        angle = 72 * k
        location = 1.25 * cos(radians(angle)), 1.25 * sin(radians(angle)), 0
        blade = location, (90, 0, 90 + angle), (0.3, 0.06, 1.05)
        add(scene, "Blade", uv_sphere(), *blade, color="f0b941" if k else "e2674a", index=40, parent=fan)
    add(scene, "Hub", uv_sphere(), (0, 1.3, 2.7), scale=0.4, color="2b2d42", index=41)
    add(scene, "Post", uv_sphere(), (0, 1.9, 1.2), scale=(0.14, 0.14, 1.5), color="eae1d0", index=42)
    driven(fan, "rotation_euler", 1, f"-frame * {pi:.6f}")
    scene.render.motion_blur_shutter = 1
    scene.cycles.rolling_shutter_duration = 0
    photograph(scene, STAND, AHEAD, addon={"time_mode": "ROLLING_SHUTTER"}, lens=22)
