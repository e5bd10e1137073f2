"""Cameras without a single eye. Slits are empties and paths are curves: the picture follows when they are moved."""

from __future__ import annotations

from math import cos, pi, radians, sin

import bpy

from .parts import add, uv_sphere
from .sets import clear_middle, photograph, room

BEHIND, AHEAD = (0, -5.2, 2.5), (0, 6, 2.5)


def slit(scene, name: str, location, turn=(0, 0, 0)):
    """Add an empty whose X axis is a slit, with arrows of length 3."""
    made = add(scene, name, None, location, turn)
    made.empty_display_type, made.empty_display_size = "ARROWS", 3
    return made


def circle(scene, center, radius: float, corners: int = 128):
    """Add a closed curve, counterclockwise as seen from above, that starts at -Y of its center."""
    data = bpy.data.curves.new("Path", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("POLY")
    spline.points.add(corners - 1)
    spline.use_cyclic_u = True
    for k, point in enumerate(spline.points):
        angle = 2 * pi * k / corners - pi / 2
        point.co = radius * cos(angle), radius * sin(angle), 0, 1
    return add(scene, "Path", data, center)


def general_linear(scene):
    """All rays are affine combinations of three rays. In this bilinear case, no two lines meet all of the rays, and
    straight edges appear curved.
    """
    room(scene)
    rays = {"ray_1": (-0.6, -0.9, -1.3, -1.2), "ray_2": (1.4, -0.3, 1.9, -0.9), "ray_3": (-1.4, 0.9, -1.8, 1.0)}
    photograph(scene, BEHIND, AHEAD, addon={"model": "GENERAL_LINEAR", **rays})


def pushbroom(scene):
    """The viewpoint moves along a horizontal slit. Near balls are larger in height, but the width of every ball is
    independent of its distance.
    """
    room(scene)
    settings = {"model": "PUSHBROOM", "slit_1": slit(scene, "Slit", BEHIND)}
    photograph(scene, BEHIND, AHEAD, addon=settings, lens=24, ortho_scale=11.6)


def cross_slit(scene):
    """All rays meet two slits; the vertical one is farther behind than the horizontal one. With distance, heights
    shrink more than widths.
    """
    room(scene)
    upright = slit(scene, "Upright slit", (0, -16, 0), (0, -90, 0))
    settings = {"model": "CROSS_SLIT", "slit_1": upright, "slit_2": slit(scene, "Level slit", (0, -8.4, 2.5))}
    photograph(scene, (0, -5.1, 2.5), AHEAD, addon=settings, lens=5.6)


def pencil(scene):
    """Each row of the picture has its own viewpoint on a slit. The upper rows are seen from the left, and the lower
    rows from the right.
    """
    room(scene)
    settings = {"model": "PENCIL", "slit_1": slit(scene, "Slit", BEHIND), "pencil_slide": -4.0}
    photograph(scene, BEHIND, AHEAD, addon=settings, lens=22)


def twisted_orthographic(scene):
    """The rays of each row are parallel. Their direction turns along a vertical axis: to the left in the upper rows, to
    the right in the lower rows.
    """
    room(scene)
    settings = {"model": "TWISTED_ORTHOGRAPHIC", "slit_1": slit(scene, "Axis", (0, 0, 2.5), (0, -90, 0)), "twist": 0.08}
    photograph(scene, BEHIND, AHEAD, addon=settings, ortho_scale=7.5)


def strip(scene):
    """Each column is seen from another point on a circle around a figure. All sides of the figure are unrolled, with
    the room in the background.
    """
    room(scene)
    clear_middle(scene)
    add(scene, "Body", uv_sphere(), (0, 0, 1.3), scale=(0.9, 0.6, 1.3), color="e2674a", index=20)
    add(scene, "Head", uv_sphere(), (0, 0, 3.1), scale=0.62, color="f0b941", index=21)
    for angle, color in ((-90, "2b2d42"), (0, "2a9d8f"), (90, "8a63b8"), (180, "3f7cc0")):
        location = 0.55 * cos(radians(angle)), 0.55 * sin(radians(angle)), 3.2
        add(scene, "Eye", uv_sphere(), location, scale=0.22, color=color, index=22)
    settings = {"model": "STRIP", "path": circle(scene, (0, 0, 2), 3.4), "follow_path": True}
    photograph(scene, (0, -3.4, 2), (0, 0, 2), 480, 336, addon=settings, lens=14)
