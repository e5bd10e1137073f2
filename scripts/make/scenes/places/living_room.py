"""A living room: |x| <= 3.2, |y| <= 3, 0 <= z <= 2.7. Each kind of object has its own pass index."""

from __future__ import annotations

from math import cos, pi, sin

import bpy

from ..parts import add, ico_sphere, lamp, square, sun, uv_sphere
from ..solids import (
    assembled,
    block,
    drawn,
    line,
    modified,
    monkey,
    prism,
    repeated,
    sheet,
    soft,
    stand,
    tube,
    turned,
)  # fmt: skip
from ..textures import (
    evening,
    grained,
    mapped,
    packed,
    rosette,
    seen_from_above,
    slope,
    textured,
    wallpaper,
    wood,
)  # fmt: skip

WALLS, FLOOR, WINDOW, OUTSIDE, DOOR, TABLE, CHAIRS, SOFA, SHELF = range(1, 10)
BOOKS, LAMPS, PLANT, DISHES, PICTURE, FIGURE = range(10, 16)
WOOD, DARK_WOOD, WHITE = "b98a5e", "8b6242", "f2efe8"


def living_room(scene) -> None:
    """Fill the scene."""
    shell(scene)
    outside(scene)
    dining(scene)
    bookshelf(scene)
    lounge(scene)
    plant(scene, (-2.55, 2.4, 0))
    entrance(scene)
    textured(WOOD, packed("Wood", wood(WOOD)))
    for thing in (thing for thing in bpy.data.objects if WOOD in thing.material_slots):
        grained(thing)
    sun(scene, (50, 0, -58), 1.9, "fff1dc")
    sun(scene, (118, 0, 130), 0.8, "e6ecff")
    lamp(scene, (-0.3, 0, 1.6), 25, "ffdfb0")


def shell(scene) -> None:
    """Add floor boards, walls, a window with curtains, and a ceiling with beams."""
    add(scene, "Ground", square(), (0, 0, -0.03), scale=(3.3, 3.1, 1), color="5b4532", index=FLOOR)
    for k, color in enumerate(("c29669", "b58859", "caa075")):
        plank = block(scene, "Plank", (1.29, 0.194, 0.03), (-3.63 + 0.43 * k, -2.9 + 0.2 * k, -0.015), edge=0.004,
                      color=color, index=FLOOR)  # fmt: skip
        repeated(grained(plank), (7, (1.3, 0, 0)), (10, (0, 0.6, 0)))
        for copies in plank.modifiers[-2:]:  # no two neighbors show the same part of the image
            copies.offset_u, copies.offset_v = 0.37, 0.43
        textured(color, packed("Plank", wood(color, k)))
    for name, location, turn, half, color in (
        ("Back wall", (0, 3, 1.35), (90, 0, 0), 3.2, "eae4d6"),
        ("Front wall", (0, -3, 1.35), (90, 0, 180), 3.2, "e9dfce"),
        ("Right wall", (3.2, 0, 1.35), (90, 0, -90), 3.0, "d3ddd6"),
    ):
        wall = add(scene, name, square(), location, turn, (half + 0.01, 1.36, 1), color=color, index=WALLS)
        mapped(wall, (2, 0, 0), (0, 2, 0))
        textured(color, packed("Wallpaper", wallpaper(color)))
        skirting = block(scene, "Skirting", (2 * half, 0.02, 0.09), location, turn, color=WHITE, index=WALLS)
        skirting.rotation_euler.x, skirting.location.z = 0, 0.045
    add(scene, "Ceiling", square(), (0, 0, 2.7), (180, 0, 0), (3.21, 3.01, 1), color=WHITE, index=WALLS)
    repeated(block(scene, "Beam", (6.4, 0.14, 0.16), (0, -2.25, 2.63), color=DARK_WOOD, index=WALLS), (4, (0, 1.5, 0)))
    corners = [(-3, 0), (3, 0), (3, 2.7), (-3, 2.7), (-1.3, 0.85), (1.3, 0.85), (1.3, 2.3), (-1.3, 2.3)]
    sides = [(k, (k + 1) % 4, (k + 1) % 4 + 4, k + 4) for k in range(4)]
    wall = drawn("wall with a window", [(0, y, z) for y, z in corners], faces=sides)
    wall.shade_flat()
    left = add(scene, "Left wall", wall, (-3.2, 0, 0), color="e6dfd0", index=WALLS)
    modified(mapped(left, (0, 2, 0), (0, 0, 2)), "SOLIDIFY", thickness=0.2)
    textured("e6dfd0", packed("Wallpaper", wallpaper("e6dfd0")))
    panes = [(0, 1.3 * a / 2, 1.575 + 0.725 * b) for a in range(-2, 3) for b in range(-1, 2)]
    frame = add(scene, "Window", sheet("panes", panes, 3), (-3.27, 0, 0), color=WHITE, index=WINDOW)
    modified(frame, "WIREFRAME", thickness=0.07)
    block(scene, "Sill", (0.3, 2.8, 0.04), (-3.12, 0, 0.85), color=WHITE, index=WINDOW)
    cloth = line("curtain", [(0.035 * sin(0.7 * k), 0.01 * k, 0) for k in range(47)])
    for y in (-1.75, 1.29):
        curtain = add(scene, "Curtain", cloth, (-3.1, y, 0.12), color="d98f6c", index=WINDOW)
        modified(curtain, "SCREW", angle=0, screw_offset=2.28, steps=1, render_steps=1)
    tube(scene, "Rod", [(-3.1, -2, 2.42), (-3.1, 0, 2.42), (-3.1, 2, 2.42)], 0.018, color=DARK_WOOD, index=WINDOW)


def outside(scene) -> None:
    """Add the view from the window: a meadow, hills and trees."""
    add(scene, "Meadow", square(), (-60, 0, -0.4), scale=56, color="a9c47f", index=OUTSIDE)
    for k in range(5):
        hill = (-34 - 4 * sin(2 * k), -26 + 13 * k, -2), (0, 0, 0), (9, 11, 3.4 + cos(2 * k))
        add(scene, "Hill", uv_sphere(), *hill, color="c4dcc0", index=OUTSIDE)
    for k, (x, y) in enumerate(((-9, -4), (-12, 1.5), (-8, 4.6), (-14, 8), (-13, -9))):
        turned(scene, "Fir", [(0, 0.5), (1.3, 0.6), (0.5, 1.9), (0.9, 2.0), (0.3, 3.1), (0.6, 3.2), (0, 4.6)],
               (x, y, -0.4), (0, 0, 9 * k), steps=16, color="7fbb86", index=OUTSIDE)  # fmt: skip


RUG = (
    (1.80, 0, 0, "3f6f8f"), (1.68, 0.03, 48, "2f5877"), (1.62, 0.03, 48, "3f6f8f"), (1.55, 0, 0, "e9dcc3"),
    (1.45, 0, 0, "5f8fa8"), (1.27, 0.09, 16, "e9dcc3"), (1.24, 0.09, 16, "2f5877"), (1.04, 0.1, 16, "d98f6c"),
    (0.94, 0.1, 16, "e9dcc3"), (0.78, 0, 0, "5f8fa8"), (0.55, 0.16, 8, "e9dcc3"), (0.5, 0.16, 8, "2f5877"),
    (0.3, -0.08, 8, "d98f6c"), (0.12, 0, 0, "e9dcc3"),
)  # fmt: skip
"""The pattern, from the outside in: radius, wave, number of waves and color."""


def dining(scene) -> None:
    """Add a rug, a laid table, four chairs and a lamp above the table."""
    at = -0.3, 0
    pattern = packed("Rug", rosette(RUG, 3.6))
    for radius, high, color in ((1.75, 0.008, "3f6f8f"), (1.55, 0.012, "e9dcc3"), (1.45, 0.016, "5f8fa8")):
        edge = [(0, high), (radius, high), (radius, 0)]
        seen_from_above(turned(scene, "Rug", edge, (*at, 0), steps=64, color=color, index=FLOOR), 3.6)
        textured(color, pattern)
    block(scene, "Table top", (1.7, 0.95, 0.05), (*at, 0.735), edge=0.015, color=WOOD, index=TABLE)
    block(scene, "Apron", (1.5, 0.75, 0.08), (*at, 0.67), color=DARK_WOOD, index=TABLE)
    leg = [(0, 0), (0.022, 0), (0.04, 0.55), (0.03, 0.57), (0.045, 0.6), (0.045, 0.7)]
    legs = turned(scene, "Leg", leg, (at[0] - 0.74, at[1] - 0.37, 0), steps=20, color=DARK_WOOD, index=TABLE)
    repeated(legs, (2, (1.48, 0, 0)), (2, (0, 0.74, 0)))
    chair = assembled(scene, "Chair", [
        soft(scene, "Seat", (0.46, 0.46, 0.07), (0, 0, 0.46), color="2a9d8f", index=CHAIRS),
        repeated(block(scene, "Leg", (0.04, 0.04, 0.45), (-0.19, -0.19, 0.225), color=WOOD, index=CHAIRS),
                 (2, (0.38, 0, 0)), (2, (0, 0.38, 0))),
        repeated(block(scene, "Post", (0.04, 0.035, 0.5), (-0.19, 0.215, 0.68), (-6, 0, 0), color=WOOD, index=CHAIRS),
                 (2, (0.38, 0, 0))),
        repeated(block(scene, "Slat", (0.36, 0.018, 0.06), (0, 0.2, 0.6), (-6, 0, 0), color=WOOD, index=CHAIRS),
                 (3, (0, 0, 0.13))),
    ])  # fmt: skip
    for x, y, turn in ((-0.75, 0.72, 4), (0.2, 0.7, -8), (-0.7, -0.75, 172), (0.95, -0.12, -72)):
        stand(scene, chair, (x, y, 0.016), (0, 0, turn))
    bowl = [(0, 0), (0.07, 0), (0.07, 0.015), (0.13, 0.04), (0.17, 0.1), (0.16, 0.1), (0.12, 0.05), (0, 0.025)]
    turned(scene, "Bowl", bowl, (*at, 0.76), color="3f7cc0", index=DISHES)
    for k, color in enumerate(("e2674a", "f0b941", "e2674a", "a5b84a")):
        angle = pi / 2 * k + 0.4
        add(scene, "Fruit", uv_sphere(), (at[0] + 0.065 * cos(angle), at[1] + 0.065 * sin(angle), 0.86),
            scale=0.055, color=color, index=DISHES)  # fmt: skip
    cup = [(0, 0), (0.028, 0), (0.04, 0.09), (0.036, 0.09), (0.025, 0.008), (0, 0.008)]
    for x, y, turn in ((-0.72, 0.25, 30), (0.22, 0.26, 120), (-0.68, -0.27, 200)):
        handle = tube(scene, "Handle", [(0.033, 0, 0.02), (0.065, 0, 0.045), (0.038, 0, 0.075)], 0.006,
                      (x, y, 0.76), (0, 0, turn), color=WHITE, index=DISHES)  # fmt: skip
        turned(scene, "Cup", cup, handle.location, color=WHITE, index=DISHES)
    shade = [(0.03, 0.25), (0.06, 0.24), (0.13, 0.19), (0.24, 0.0), (0.232, 0.0), (0.122, 0.182), (0.05, 0.23)]
    turned(scene, "Shade", shade, (*at, 1.72), color="d95d47", index=LAMPS)
    add(scene, "Bulb", ico_sphere(), (*at, 1.76), scale=0.06, color="fff3c8", index=LAMPS)
    tube(scene, "Cord", [(*at, 1.95), (*at, 2.3), (*at, 2.7)], 0.008, color="3a3a44", index=LAMPS)


def bookshelf(scene) -> None:
    """Add a shelf at the back wall, with books of many sizes, a figure, a vase and a globe."""
    x, y, width = 1.15, 2.82, 2.0
    side = block(scene, "Side", (0.04, 0.32, 2.1), (x - width / 2, y, 1.05), edge=0.005, color=WOOD, index=SHELF)
    repeated(side, (2, (width, 0, 0)))
    board = block(scene, "Board", (width - 0.04, 0.31, 0.03), (x, y, 0.12), edge=0.004, color=WOOD, index=SHELF)
    repeated(board, (5, (0, 0, 0.485)))
    block(scene, "Panel", (width, 0.02, 2.05), (x, 2.975, 1.06), color=DARK_WOOD, index=SHELF)
    colors = "e2674a", "2a9d8f", "f0b941", "3f7cc0", "8a63b8", "eae1d0", "c65d7b", "5d6d7e"
    rows = (0, -0.95, 0.9), (1, -0.95, 0.2), (2, -0.25, 0.9), (3, -0.95, 0.1)
    for level, left, right in rows:
        at, k = left, 7 * level
        while at < right:
            wide, tall = 0.03 + 0.012 * (k * 5 % 4), 0.26 + 0.03 * (k * 7 % 5)
            block(scene, "Book", (wide, 0.22, tall), (x + at + wide / 2, y - 0.02, 0.135 + 0.485 * level + tall / 2),
                  edge=0.004, color=colors[(k * 3 + level) % 8], index=BOOKS)  # fmt: skip
            at, k = at + wide + 0.004, k + 1
    monkey(scene, (x - 0.62, y - 0.02, 1.27), (-12, 0, 14), 0.155, color="e0b040", index=FIGURE)
    turned(scene, "Vase", VASE, (x + 0.55, y - 0.02, 0.62), color="d9809a", index=DISHES)
    add(scene, "Globe", uv_sphere(), (x + 0.5, y - 0.02, 1.78), (0, 23, 40), 0.17, color="3f7cc0", index=FIGURE)


VASE = (
    (0, 0), (0.06, 0), (0.085, 0.05), (0.1, 0.11), (0.085, 0.18), (0.045, 0.24), (0.04, 0.28), (0.06, 0.33),
    (0.055, 0.33), (0.033, 0.28), (0.036, 0.24), (0.03, 0.1), (0, 0.1),
)  # fmt: skip


def lounge(scene) -> None:
    """Add a sofa with pillows at the right wall, a picture above it, and a floor lamp next to it."""
    gray, x = "7d8ca3", 2.68
    soft(scene, "Base", (0.85, 2.1, 0.3), (x, -0.35, 0.26), crease=0.8, color=gray, index=SOFA)
    soft(scene, "Rest", (0.26, 2.1, 0.75), (x + 0.33, -0.35, 0.5), color=gray, index=SOFA)
    for y in (-1.42, 0.72):
        soft(scene, "Arm", (0.86, 0.22, 0.55), (x, y, 0.36), color=gray, index=SOFA)
    for y in (-0.83, 0.13):
        soft(scene, "Cushion", (0.66, 0.95, 0.18), (x - 0.1, y, 0.47), color="8f9db2", index=SOFA)
    for y, turn, color in ((0.38, 6, "f0b941"), (-1.05, -10, "e2674a")):
        soft(
            scene, "Pillow", (0.16, 0.44, 0.44), (x + 0.12, y, 0.75), (0, 20, turn), crease=0.2, color=color, index=SOFA
        )
    block(scene, "Frame", (0.03, 1.3, 0.8), (3.18, -0.35, 1.65), color=DARK_WOOD, index=PICTURE)
    sky = block(scene, "Sky", (0.03, 1.2, 0.7), (3.17, -0.35, 1.65), edge=0, color="bcd7ea", index=PICTURE)
    mapped(sky, (0, -1 / 1.2, 0), (0, 0, 1 / 0.7), 0.5)
    textured("bcd7ea", packed("Sky", evening("f6d7b0", "7fb2dc", "fdf3ea")))
    far = (-0.6, 0), (0.6, 0), (0.6, 0.22), (0.3, 0.45), (0.05, 0.2), (-0.25, 0.38), (-0.6, 0.1)
    near = (-0.6, 0), (0.6, 0), (0.6, 0.05), (0.1, 0.16), (-0.3, 0.3), (-0.6, 0.2)
    for outline, out, color, *top in ((far, 3.152, "7f9fb8", "f4f7fa", 0.55), (near, 3.148, "3f6f6a", "6fa36f", 0.35)):
        at = (out, -0.35, 1.3), (0, 0, 90)
        hills = prism(scene, "Mountains", outline, 0.01, *at, edge=0, color=color, index=PICTURE)
        mapped(hills, (1 / 1.2, 0, 0), (0, 0, 1 / 0.5))
        textured(color, packed("Mountains", slope(color, *top)))
    disc, at = [(0, 0), (0.09, 0), (0.09, -0.01)], ((3.15, -0.65, 1.83), (0, -90, 0))
    turned(scene, "Sun disc", disc, *at, color="f0b941", index=PICTURE)
    foot = [(0, 0), (0.15, 0), (0.15, 0.02), (0.015, 0.04), (0.012, 1.5), (0, 1.5)]
    turned(scene, "Stem", foot, (2.75, 1.25, 0), color="3a3a44", index=LAMPS)
    shade = [(0.22, 0), (0.13, 0.3), (0.124, 0.3), (0.214, 0)]
    turned(scene, "Lampshade", shade, (2.75, 1.25, 1.38), color="f3e3bd", index=LAMPS)


def plant(scene, location) -> None:
    """Add a pot with long bent leaves."""
    pot = [(0, 0), (0.15, 0), (0.21, 0.34), (0.23, 0.34), (0.23, 0.38), (0.2, 0.38), (0.19, 0.33), (0, 0.33)]
    turned(scene, "Pot", pot, location, color="c9714f", index=PLANT)
    spine = [(0.02, 0, 0), (0.16, 0.1, 0.4), (0.42, 0.13, 0.72), (0.75, 0.08, 0.8), (0.98, 0, 0.62)]
    rows = [(x, side * half, z - 0.25 * half) for x, half, z in ((x, w, z) for x, w, z in spine) for side in (-1, 0, 1)]
    rows = [(x, y, z if k % 3 != 1 else z - 0.04) for k, (x, y, z) in enumerate(rows)]
    leaf = sheet("leaf", rows, 3)
    for k in range(13):
        size = 0.75 + 0.25 * sin(2.6 * k)
        turn = 0, -22 - 26 * (k % 3), 137.5 * k
        made = add(scene, "Leaf", leaf, (location[0], location[1], location[2] + 0.33), turn, size,
                   color=("4f9a5f", "68ad5c")[k % 2], index=PLANT)  # fmt: skip
        modified(made, "SUBSURF", levels=2, render_levels=2)
        modified(made, "SOLIDIFY", thickness=0.008)


def entrance(scene) -> None:
    """Add a door, a clock and a sideboard at the front wall."""
    block(scene, "Door frame", (1.06, 0.06, 2.12), (1.7, -2.985, 1.06), color=WHITE, index=DOOR)
    block(scene, "Door", (0.92, 0.06, 2.03), (1.7, -2.965, 1.02), color="6f8f9f", index=DOOR)
    panel = block(scene, "Door panel", (0.3, 0.03, 0.75), (1.5, -2.935, 0.52), edge=0.012, color="86a5b3", index=DOOR)
    repeated(panel, (2, (0.4, 0, 0)), (2, (0, 0, 0.95)))
    add(scene, "Knob", uv_sphere(), (1.33, -2.9, 1.0), scale=0.035, color="e0b040", index=DOOR)
    block(scene, "Sideboard", (1.7, 0.45, 0.6), (-0.9, -2.75, 0.45), edge=0.02, color=WOOD, index=SHELF)
    doors = block(scene, "Sideboard door", (0.52, 0.02, 0.5), (-1.45, -2.52, 0.45), color=DARK_WOOD, index=SHELF)
    repeated(doors, (3, (0.55, 0, 0)))
    repeated(
        block(scene, "Foot", (0.05, 0.05, 0.16), (-1.65, -2.6, 0.08), color=DARK_WOOD, index=SHELF), (2, (1.5, 0, 0))
    )
    turned(scene, "Tall vase", [(1.5 * r, 1.5 * z) for r, z in VASE], (-1.4, -2.75, 0.75), color="2a9d8f", index=DISHES)
    rim = [(0, 0.02), (0.2, 0.02), (0.2, 0.05), (0.23, 0.05), (0.23, 0)]
    turned(scene, "Clock", rim, (-0.6, -3, 1.75), (-90, 0, 0), color=WHITE, index=FIGURE)
    for name, size, turn in (("Hour", (0.02, 0.01, 0.11), 50), ("Minute", (0.014, 0.01, 0.17), -60)):
        hand = block(scene, name, size, (-0.6, -2.965, 1.75), (0, turn, 0), edge=0, color="2b2d42", index=FIGURE)
        hand.delta_location = sin(turn * pi / 180) * size[2] / 2, 0, cos(turn * pi / 180) * size[2] / 2
