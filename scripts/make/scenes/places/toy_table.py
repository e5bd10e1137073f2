"""Toys on a photographer's backdrop."""

from __future__ import annotations

from math import cos, pi, radians, sin

from ..parts import add, ico_sphere, sun, uv_sphere
from ..solids import block, line, modified, monkey, turned

RED, TEAL, YELLOW, BLUE, PURPLE, PINK = "e2674a", "2a9d8f", "f0b941", "3f7cc0", "8a63b8", "d9809a"


def backdrop(scene) -> None:
    """Add a floor that curves up smoothly at the back, and two lights."""
    bend = [(6 + 3 * sin(radians(angle)), 3 - 3 * cos(radians(angle))) for angle in range(0, 91, 6)]
    profile = [(-14, 0), (2, 0), (4, 0), *bend, (9, 5), (9, 12)]
    floor = add(scene, "Backdrop", line("backdrop", [(-20, y, z) for y, z in profile]), color="d5d3ce", index=1)
    modified(floor, "SCREW", axis="X", angle=0, screw_offset=40, steps=1, render_steps=1)
    sun(scene, (44, 0, -42), 2.3, "fff2df")
    sun(scene, (58, 0, 62), 0.8, "cfe0ff")


def toy_table(scene) -> None:
    """Fill the scene with blocks, cylinders, balls, a cone, rings and a monkey, each with its own pass index."""
    backdrop(scene)
    monkey(scene, (0.05, 0.55, 1.03), (-18, 0, 12), 1.1, color=RED, index=2)
    block(scene, "Cube", (1.3, 1.3, 1.3), (-2.5, 1.0, 0.65), (0, 0, 28), edge=0.08, color=BLUE, index=3)
    block(scene, "Small cube", (0.66,) * 3, (1.25, -1.75, 0.33), (0, 0, -24), edge=0.05, color=YELLOW, index=4)
    turned(scene, "Cylinder", disc(0.62, 1.25, 0.07), (2.75, 0.75, 0), color=TEAL, index=5)
    turned(scene, "Small cylinder", disc(0.36, 0.6, 0.05), (-1.5, -1.6, 0.36), (90, 0, 52), color=PURPLE, index=6)
    add(scene, "Ball", uv_sphere(), (4.0, 2.8, 0.85), scale=0.85, color=PURPLE, index=7)
    add(scene, "Small ball", uv_sphere(), (-0.25, -2.35, 0.34), scale=0.34, color=TEAL, index=8)
    add(scene, "Marble", ico_sphere(), (3.0, -1.35, 0.26), scale=0.26, color=RED, index=9)
    cone = [(0, 0), (0.62, 0), (0.66, 0.05), (0.05, 1.5), (0, 1.52)]
    turned(scene, "Cone", cone, (-3.9, 2.5, 0), color=YELLOW, index=10)
    ring(scene, "Ring", 0.55, 0.2, (-3.0, -0.85, 0.2), color="eae1d0", index=11)
    ring(scene, "Upright ring", 0.46, 0.17, (1.95, 2.9, 0.63), (90, 0, 30), color=PINK, index=12)


def disc(radius: float, high: float, edge: float):
    """Return the profile of a cylinder with round edges."""
    arc = [(edge * sin(radians(angle)), edge * cos(radians(angle))) for angle in range(0, 91, 18)]
    upper = [(radius - edge + x, high - edge + z) for x, z in arc]
    return [(0, high), *upper, *((x, high - z) for x, z in reversed(upper)), (0, 0)]


def ring(scene, name: str, radius: float, thick: float, location, turn=(0, 0, 0), **look):
    """Add a torus."""
    circle = [(radius + thick * cos(2 * pi * k / 24), thick * sin(2 * pi * k / 24)) for k in range(25)]
    return turned(scene, name, circle, location, turn, steps=64, sharp=180, **look)
