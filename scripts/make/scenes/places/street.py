"""A street of narrow houses along x, 30 meters long, with fronts at y = 4."""

from __future__ import annotations

from math import sin

from ..parts import add, square, sun, uv_sphere
from ..solids import assembled, block, prism, repeated, soft, stand, turned
from .tree import tree

GROUND, HOUSE, WINDOW, DOOR, LAMP, CAR, ROOF = range(1, 8)
WHITE, GLASS, IRON = "f2efe8", "4f6f86", "3a4048"

HOUSES = (
    (4.4, 7.0, "steps", "b5563f", 3), (3.8, 6.2, "bell", "d9b56a", 3), (5.0, 7.4, "point", "5f7f8f", 4),
    (4.0, 6.6, "steps", "c98f6a", 3), (4.6, 5.8, "bell", "8aa07f", 3), (3.8, 7.2, "point", "a8485a", 3),
    (4.4, 6.4, "steps", "e2cfa6", 3),
)  # fmt: skip
"""Width, height of the eaves, gable, color and number of windows per floor of each house."""

GABLES = {"steps": 2.2, "bell": 2.0, "point": 2.4}
"""Height of each kind of gable."""


def street(scene) -> None:
    """Fill the scene."""
    add(scene, "Lawn", square(), (0, 0, -0.2), scale=90, color="8faa72", index=GROUND)
    block(scene, "Road", (60, 7, 0.2), (0, -2.3, -0.1), edge=0, color="77777c", index=GROUND)
    dash = block(scene, "Dash", (1.2, 0.12, 0.01), (-24, -2.3, 0.005), edge=0, color=WHITE, index=GROUND)
    repeated(dash, (21, (2.4, 0, 0)))
    paving = block(scene, "Paving", (0.78, 0.78, 0.2), (-25.6, 1.6, 0.02), edge=0.015, color="c3b8a6", index=GROUND)
    repeated(paving, (65, (0.8, 0, 0)), (4, (0, 0.8, 0)))
    windows = window(scene)
    x = -sum(width for width, *_ in HOUSES) / 2
    for k, (width, eaves, gable, color, count) in enumerate(HOUSES):
        house(scene, k, x + width / 2, width, eaves, gable, color, count, windows)
        x += width
    for k, x in enumerate((-13.4, -5.2, 3.6, 12.2)):
        tree(scene, (x, 1.7, 0.1), 1.5 + 0.2 * sin(2 * k), k)
    lantern = assembled(scene, "Lantern", [
        turned(scene, "Post", [(0, 0), (0.14, 0), (0.14, 0.1), (0.06, 0.25), (0.045, 2.8), (0.12, 2.9), (0, 2.9)],
               steps=16, color=IRON, index=LAMP),
        add(scene, "Globe", uv_sphere(), (0, 0, 3.1), scale=0.22, color="fff0c0", index=LAMP),
        turned(scene, "Cap", [(0.26, 3.28), (0.05, 3.46), (0, 3.48)], steps=16, color=IRON, index=LAMP),
    ])  # fmt: skip
    for k in range(6):
        tree(scene, (-5 + 4.6 * k, -8.6 - 0.8 * sin(2 * k), -0.2), 1.5 + 0.3 * sin(1.7 * k), k + 1)
    for x in (-9.2, -0.8, 8.0):
        stand(scene, lantern, (x, 1.5, 0.1))
    for name, x, color in (("Red car", -7.6, "d1493f"), ("Blue car", 6.2, "3f7cc0")):
        car(scene, name, (x, 0.1, 0), color)
    sun(scene, (48, 0, -40), 2.2, "fff0d8")
    sun(scene, (80, 0, 12), 0.6, "ffe6cc")


def window(scene):
    """Return a collection with a window, 0.9 by 1.4, centered at the origin."""
    return assembled(scene, "Window", [
        block(scene, "Glass", (0.86, 0.04, 1.36), edge=0, color=GLASS, index=WINDOW),
        repeated(block(scene, "Upright", (0.06, 0.1, 1.4), (-0.42, -0.02, 0), edge=0.008, color=WHITE, index=WINDOW),
                 (3, (0.42, 0, 0))),
        repeated(block(scene, "Bar", (0.9, 0.1, 0.06), (0, -0.02, -0.68), edge=0.008, color=WHITE, index=WINDOW),
                 (3, (0, 0, 0.68))),
        block(scene, "Sill", (1.06, 0.2, 0.07), (0, -0.05, -0.75), color="d8cfc0", index=WINDOW),
    ])  # fmt: skip


def house(scene, number, x, width, eaves, gable, color, count, windows) -> None:
    """Add a house to the row."""
    half, top = width / 2, eaves + GABLES[gable]
    right = {
        "steps": [(half * (1 - 0.225 * k), eaves + 0.55 * (k + j)) for k in range(4) for j in (0, 1)],
        "bell": [(half * (0.52 + 0.48 * (1 - u / 6) ** 2.2), eaves + 0.25 * u) for u in range(7)]
        + [(half * 0.5 * (1 - u * u) ** 0.5, eaves + 1.5 + 0.5 * u) for u in (0.3, 0.6, 0.85, 0.97)],
        "point": [(half, eaves), (0.25, top - 0.1), (0.25, top)],
    }[gable]
    outline = [(-half, 0), (half, 0), *right, *((-a, b) for a, b in reversed(right))]
    prism(scene, f"Front {number}", outline, 0.4, (x, 4.2, 0), edge=0, color=color, index=HOUSE)
    roof = [(-half, 0), (half, 0), (half, eaves - 0.2), (0, top - 0.5), (-half, eaves - 0.2)]
    prism(scene, f"Behind {number}", roof, 7, (x, 7.8, 0), edge=0, color="7a5650", index=ROOF)
    block(scene, "Plinth", (width - 0.06, 0.1, 0.5), (x, 3.97, 0.25), color="a39a8e", index=HOUSE)
    block(scene, "Cornice", (width - 0.02, 0.16, 0.14), (x, 3.95, eaves - 0.12), edge=0.03, color=WHITE, index=HOUSE)
    gap, floors = (width - 0.3) / count, 2 if eaves < 6.5 else 3
    rise = (eaves - 2.7) / (floors - 1)
    for row in range(floors):
        for column in range(count):
            at = x + (column - (count - 1) / 2) * gap
            if row == 0 and column == number % count:
                entry(scene, at, ("2f5d50", "7a3038", "31486b")[number % 3])
            else:
                stand(scene, windows, (at, 3.98, 1.55 + rise * row), scale=(0.95, 1, 1))
    middle, rim = ((x, 4.0, eaves + 0.75), (90, 0, 0)), [(0, 0.02), (0.32, 0.02), (0.32, 0.08), (0.4, 0.08), (0.4, 0)]
    turned(scene, "Oculus", rim, *middle, steps=32, color=WHITE, index=WINDOW)
    turned(scene, "Pane", [(0, 0.035), (0.3, 0.035)], *middle, steps=32, color=GLASS, index=WINDOW)


def entry(scene, x: float, color: str) -> None:
    """Add a door with a step in front of it."""
    block(scene, "Door frame", (1.14, 0.12, 2.36), (x, 3.97, 1.28), color=WHITE, index=DOOR)
    block(scene, "Door", (0.9, 0.12, 2.1), (x, 3.94, 1.2), color=color, index=DOOR)
    add(scene, "Knob", uv_sphere(), (x + 0.35, 3.85, 1.15), scale=0.05, color="e0b040", index=DOOR)
    block(scene, "Step", (1.3, 0.6, 0.16), (x, 3.75, 0.18), color="a39a8e", index=DOOR)


def car(scene, name: str, location, color: str) -> None:
    """Add a small car parallel to x."""
    x, y, _ = location
    soft(scene, name, (3.9, 1.6, 0.66), (x, y, 0.58), crease=0.5, color=color, index=CAR)
    outline = [(-1.25, 0), (1.05, 0), (0.45, 0.55), (-0.95, 0.55)]
    cabin = prism(scene, "Cabin", outline, 1.36, (x - 0.1, y, 0.84), edge=0.12, color="bcd3e0", index=CAR)
    roof = [(-0.95, 0.53), (0.45, 0.53), (0.38, 0.62), (-0.88, 0.62)]
    prism(scene, "Roof", roof, 1.3, cabin.location, edge=0.04, color=color, index=CAR)
    tire = [(0.2, 0.1), (0.34, 0.1), (0.37, 0.05), (0.37, -0.05), (0.34, -0.1), (0.2, -0.1)]
    hub = [(0, 0.09), (0.14, 0.11), (0.21, 0.08), (0.21, -0.08), (0.14, -0.11), (0, -0.09)]
    for side in (-1.1, 1.1):
        for across in (-0.7, 0.7):
            at = (x + side, y + across, 0.37), (90, 0, 0)
            turned(scene, "Tire", tire, *at, steps=32, color=IRON, index=CAR)
            turned(scene, "Hub", hub, *at, steps=24, color="d5d8dc", index=CAR)
