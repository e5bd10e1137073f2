"""A biplane on a runway."""

from __future__ import annotations

from math import cos, pi, radians, sin

from ..parts import add, square, sun, uv_sphere
from ..solids import block, modified, prism, repeated, sheet, soft, tube, turned


def airfield(scene):
    """Fill the scene with a biplane on a runway, nose to -y; return the empty that turns the propeller."""
    add(scene, "Grass", square(), scale=90, color="93b06f", index=1)
    block(scene, "Runway", (12, 90, 0.02), (0, 30, 0.01), edge=0, color="85888c", index=1)
    repeated(block(scene, "Dash", (0.3, 3, 0.01), (0, 4, 0.025), edge=0, color="f2efe8", index=1), (10, (0, 7, 0)))
    body = [(0, 0), (0.42, 0.02), (0.66, 0.2), (0.74, 0.6), (0.74, 1.6), (0.66, 3.0), (0.42, 4.8), (0.2, 6.2), (0, 6.3)]
    height = 1.65
    hull = turned(scene, "Fuselage", body, (0, 0, height), (-90, 0, 0), sharp=50, color="e2674a", index=2)
    modified(hull, "SUBSURF", levels=1, render_levels=1)
    turned(
        scene,
        "Cowling",
        [(0.45, -0.03), (0.56, -0.03), (0.7, 0.12), (0.75, 0.45), (0.76, 0.5)],
        (0, 0, height),
        (-90, 0, 0),
        color="eae1d0",
        index=2,
    )
    add(scene, "Canopy", uv_sphere(), (0, 2.0, height + 0.55), scale=(0.42, 0.95, 0.5), color="8fc0d8", index=3)
    wing(scene, "Lower wing", 4.3, 1.4, (0, 0.75, height - 0.5), 4)
    wing(scene, "Upper wing", 4.6, 1.4, (0, 0.5, height + 1.25), 4)
    wing(scene, "Tail", 1.6, 0.8, (0, 5.5, height + 0.1), 0)
    prism(
        scene,
        "Fin",
        [(0, 0), (1.0, 0), (0.95, 1.0), (0.6, 1.15), (0.35, 0.9)],
        0.08,
        (0, 5.3, height),
        (0, 0, 90),
        edge=0.03,
        color="f0b941",
        index=5,
    )
    for side in (-1, 1):
        for x, lean in ((2.9, 0.1), (0.45, 0.05)):
            strut = [(side * x, 0.45, height - 0.4 + 0.06 * x), (side * (x + lean), 0.3, height + 1.2 + 0.06 * x)]
            tube(scene, "Strut", strut, 0.035, color="8b6242", index=6)
        tube(scene, "Leg", [(side * 0.4, 0.7, height - 0.5), (side * 0.85, 0.6, 0.42)], 0.05, color="8b6242", index=6)
        tire = [(0.2, 0.11), (0.38, 0.11), (0.42, 0.05), (0.42, -0.05), (0.38, -0.11), (0.2, -0.11)]
        wheel = (side * 0.92, 0.6, 0.42), (0, 90, 0)
        turned(scene, "Tire", tire, *wheel, steps=32, color="2b2d42", index=7)
        hub = [(0, 0.1), (0.2, 0.1), (0.2, -0.1), (0, -0.1)]
        turned(scene, "Hub", hub, *wheel, steps=24, color="eae1d0", index=7)
    for k in range(7):
        angle = pi / 2 + 0.42 * (k - 3)
        location = 70 * cos(angle), 70 * sin(angle), 20 + 6 * sin(2.4 * k)
        add(scene, "Cloud", uv_sphere(), location, scale=(9, 4, 2.6 + sin(k)), color="f7f7f4", index=8)
        hill = (75 * cos(angle + 0.2), 75 * sin(angle + 0.2), -3), (0, 0, 0), (22, 12, 9 + 3 * sin(3 * k))
        add(scene, "Hill", uv_sphere(), *hill, color="7f9f88", index=8)
    sun(scene, (52, 0, -36), 2.2, "fff0d8")
    sun(scene, (80, 0, 50), 0.6, "dfe8ff")
    axis = add(scene, "Propeller", None, (0, -0.3, height))
    sections = (0.05, 0.07, 0.06), (0.5, 0.12, 0.07), (1.0, 0.13, 0.05), (1.35, 0.1, 0.03), (1.5, 0.03, 0.01)
    places = [(side * half, -side * twist, z) for z, half, twist in sections for side in (-1, 0, 1)]
    blade = sheet("blade", places, 3)
    for k in range(3):
        made = add(scene, "Blade", blade, turn=(0, 120 * k, 0), color="4a4f5c", index=9, parent=axis)
        modified(modified(made, "SUBSURF", levels=2, render_levels=2), "SOLIDIFY", thickness=0.04)
    spinner = [(0, -0.42), (0.1, -0.38), (0.2, -0.2), (0.24, 0.06), (0.2, 0.2)]
    turned(scene, "Spinner", spinner, turn=(-90, 0, 0), sharp=180, color="f0b941", index=9, parent=axis)
    return axis


def wing(scene, name: str, half: float, deep: float, location, raised: float) -> None:
    """Add a wing: two subdivided slabs with round tips that rise outward by ``raised`` degrees."""
    for side in (-1, 1):
        at = (
            location[0] + side * half / 2 * cos(radians(raised)),
            location[1],
            location[2] + half / 2 * sin(radians(raised)),
        )
        size, turn = (half + 0.1, deep, 0.16), (0, -side * raised, 0)
        soft(scene, name, size, at, turn, crease=0.3, color="f0b941", index=5)
