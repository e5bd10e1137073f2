"""Places of meshes under the sky: a rotunda, a street, a garden of sculptures, a propeller plane."""

from __future__ import annotations

from math import cos, degrees, pi, radians, sin

import bpy

from .parts import add, mesh, square, sun, uv_sphere
from .solids import (
    assembled, blob, block, drawn, letters, modified, monkey, prism, repeated, scattered, soft, stand, tube, turned,
)  # fmt: skip

STONE, PALE, WARM = "d8cbb2", "ece4d3", "c9a98a"


def rotunda(scene) -> None:
    """Fill the scene with twelve columns around a fountain, r <= 6, under a coffered dome that is open in the middle."""
    add(scene, "Lawn", square(), (0, 0, -0.35), color="93b06f", index=1).camera_ray_caster.primitive = "INFINITE_PLANE"
    for k, radius in enumerate((7.8, 7.4, 7.0)):
        disc = [(0, 0.12 * (k - 2)), (radius, 0.12 * (k - 2)), (radius, 0.12 * (k - 3))]
        turned(scene, f"Step {k}", disc, steps=96, color=("c3b59b", "cfc2a9", "b7876a")[k], index=2)
    tiles(scene)
    order = assembled(scene, "Column", [
        turned(scene, "Shaft", [(0.42 - 0.1 * (k / 8) ** 2, 0.35 + 0.4 * k) for k in range(9)], color=PALE, index=3),
        turned(scene, "Base", [(0, 0.35), (0.43, 0.35), (0.5, 0.3), (0.52, 0.25), (0.48, 0.2), (0.56, 0.14), (0.56, 0.1)],
               color=STONE, index=3),
        block(scene, "Plinth", (1.2, 1.2, 0.12), (0, 0, 0.06), color=STONE, index=3),
        turned(scene, "Echinus", [(0.32, 3.5), (0.36, 3.55), (0.34, 3.6), (0.36, 3.64), (0.5, 3.8), (0.5, 3.84)],
               color=STONE, index=3),
        block(scene, "Abacus", (1.1, 1.1, 0.14), (0, 0, 3.9), color=STONE, index=3),
    ])  # fmt: skip
    for k in range(12):
        angle = 2 * pi * (k + 0.5) / 12
        stand(scene, order, (6 * cos(angle), 6 * sin(angle), 0), (0, 0, degrees(angle)))
    beam = [(5.5, 3.97), (5.5, 4.3), (5.45, 4.3), (5.45, 4.6), (5.3, 4.68), (5.3, 4.75)]
    turned(scene, "Entablature", [*beam, (6.7, 4.75), (6.7, 4.68), (6.55, 4.6), (6.55, 3.97), (5.5, 3.97)],
           steps=96, sharp=20, color=PALE, index=4)  # fmt: skip
    dome(scene)
    fountain(scene)
    for k in range(16):
        angle, away = 2 * pi * (k + 0.2 * sin(3 * k)) / 16, 15 + 4 * sin(2.1 * k)
        tree(scene, (away * cos(angle), away * sin(angle), -0.35), 1.5 + 0.4 * sin(1.3 * k), k)
    sun(scene, (46, 0, -46), 1.9, "ffedcf")
    sun(scene, (150, 0, 20), 0.5, "ffe9cf")


def tiles(scene) -> None:
    """Add a floor of rings whose tiles are light and dark in turn."""
    rings = 1.6, 2.5, 3.4, 4.3, 5.2
    for k, inner in enumerate(rings):
        outer, count = inner + 0.9, 36
        step = 2 * pi / count
        for shade, color in enumerate(("e9dfca", "a8644a")):
            corners, faces = [], []
            for j in range(count):
                if (j + k) % 2 == shade:
                    for a, r in ((j, inner), (j, outer), (j + 1, outer), (j + 1, inner)):
                        corners.append((r * cos(a * step), r * sin(a * step), 0.004))
                    faces.append(tuple(range(len(corners) - 4, len(corners))))
            add(scene, "Tiles", drawn(f"tiles {k} {shade}", corners, faces=faces), color=color, index=2)


def dome(scene) -> None:
    """Add the dome: a shell with a hole, and ribs before it by the wireframe of a coarser one."""
    def arc(radius, count):
        angles = [radians(2 + 72 * k / count) for k in range(count + 1)]
        return [(radius * cos(angle), 4.75 + 0.82 * radius * sin(angle)) for angle in angles]

    turned(scene, "Dome", arc(5.95, 24), steps=96, color="7fa3bd", index=5)
    ribs = turned(scene, "Ribs", arc(5.9, 5), steps=24, color=PALE, index=6)
    modified(ribs, "WIREFRAME", thickness=0.3)


def fountain(scene) -> None:
    """Add three basins with water, and a monkey of gold."""
    basin = [(0, 0), (1.5, 0), (1.5, 0.12), (1.3, 0.16), (1.34, 0.5), (1.42, 0.56), (1.4, 0.6), (1.25, 0.6), (1.2, 0.2), (0, 0.2)]
    turned(scene, "Basin", basin, steps=64, color=STONE, index=7)
    turned(scene, "Water", [(0, 0.5), (1.23, 0.5)], steps=64, color="5f9fc0", index=8)
    stem = [(0, 0.2), (0.34, 0.2), (0.2, 0.5), (0.16, 0.9), (0.3, 1.1), (0.75, 1.3), (0.8, 1.36), (0.7, 1.36), (0.2, 1.2), (0, 1.2)]
    turned(scene, "Bowl", stem, steps=48, color=STONE, index=7)
    turned(scene, "Water", [(0, 1.31), (0.7, 1.31)], steps=48, color="7fb6d0", index=8)
    turned(scene, "Pedestal", [(0, 1.2), (0.14, 1.2), (0.1, 1.35), (0.1, 1.55), (0.22, 1.65), (0.22, 1.72), (0, 1.72)], color=STONE, index=7)
    monkey(scene, (0, 0, 2.12), (-14, 0, 0), 0.5, color="e0b040", index=9)


def tree(scene, place, tall: float = 1.0, kind: int = 0) -> None:
    """Add a tree: a crown of metaballs would run into the next one, so it is turned, and a trunk."""
    crown = [(0, 0.9), (0.45, 0.95), (0.75, 1.3), (0.8, 1.75), (0.62, 2.25), (0.35, 2.6), (0, 2.72)]
    color = ("6fa35a", "4f8f63", "8fb25f", "d99a4e")[kind % 4]
    made = turned(scene, "Crown", crown, place, (0, 0, 30 * kind), steps=16, sharp=180, color=color, index=10)
    modified(made, "SUBSURF", levels=1, render_levels=1)
    trunk = turned(scene, "Trunk", [(0.14, 0), (0.1, 1.2)], place, steps=12, color="8a6a52", index=11)
    made.scale = trunk.scale = (tall,) * 3


def sculptures(scene) -> None:
    """Fill the scene with letters, a knot, metaballs, a canopy and a hill with trees by geometry nodes."""
    lawn = add(scene, "Lawn", square(), (0, 0, 0), color="9ab97b", index=1)
    lawn.camera_ray_caster.primitive = "INFINITE_PLANE"
    hill(scene)
    path = [(0, 0.012), (3.3, 0.012), (3.3, 0)]
    turned(scene, "Plaza", path, (0.3, 0.6, 0), steps=96, color="d8ccb4", index=1)
    letters(scene, "RAYS", (0.3, -0.35, 0.04), (90, 0, 0), size=1.45, color="e2674a", index=3)
    plinth(scene, -2.9, 1.6, 0.55, 0.9)
    turns = [2 * pi * k / 24 for k in range(24)]
    knot = [(0.26 * (sin(t) + 2 * sin(2 * t)), 0.26 * (cos(t) - 2 * cos(2 * t)), -0.3 * sin(3 * t)) for t in turns]
    tube(scene, "Knot", knot, 0.13, (-2.9, 1.6, 1.75), (80, 0, 20), closed=True, color="8a63b8", index=4)
    plinth(scene, 3.35, 1.6, 0.6, 0.6)
    drops = [(0, 0, 0, 0.75), (0.3, 0.05, 0.42, 0.6), (-0.16, 0.1, 0.75, 0.62), (0.1, -0.05, 1.12, 0.55), (0.2, 0, 1.5, 0.4)]
    blob(scene, "Drops", drops, (3.35, 1.6, 0.95), color="2a9d8f", index=5)
    sail(scene, (0.35, 2.9, 0))
    monkey(scene, (0.3, 2.7, 1.62), (-14, 0, 0), 0.66, color="f0b941", index=7)
    plinth(scene, 0.3, 2.75, 0.5, 1.05)
    sun(scene, (48, 0, -46), 2.2, "fff0d8")
    sun(scene, (80, 0, 12), 0.9, "ffe6cc")


def plinth(scene, x: float, y: float, half: float, high: float) -> None:
    """Add a stone block to stand something on."""
    block(scene, "Plinth", (2 * half, 2 * half, high), (x, y, high / 2), edge=0.04, color="c9bfae", index=2)


def hill(scene) -> None:
    """Add hills, and trees that geometry nodes put on them."""
    count, wide = 18, 40
    places = [(wide * (i / count - 0.5) * 2, 14 + 26 * j / count) for j in range(count + 1) for i in range(count + 1)]
    rise = [
        (x, y, -0.3 + 5.5 * sin(pi * (y - 14) / 52) ** 2 * (1 + 0.45 * sin(0.21 * x + 1) + 0.2 * sin(0.5 * x + 0.3 * y)))
        for x, y in places
    ]
    row = count + 1
    faces = [(j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i) for j in range(count) for i in range(count)]
    data = drawn("hill", rise, faces=faces)
    modified(add(scene, "Hill", data, color="86ad72", index=1), "SUBSURF", levels=1, render_levels=1)
    trees = []
    for kind in range(3):
        before = set(scene.objects)
        tree(scene, (0, 0, 0), 0.95 + 0.2 * kind, kind)
        trees.append(assembled(scene, f"Tree {kind}", set(scene.objects) - before))
    forest = bpy.data.collections.new("Trees")
    for part in trees:
        forest.children.link(part)
    forest_floor = modified(add(scene, "Forest", data, index=8), "SUBSURF", levels=1, render_levels=1)
    scattered(forest_floor, forest, 0.035, 3)


def sail(scene, place) -> None:
    """Add a canopy, a NURBS surface of 4 by 4 points, on four posts."""
    bpy.ops.surface.primitive_nurbs_surface_surface_add()
    made = bpy.context.object
    data = made.data
    bpy.data.objects.remove(made)
    for k, point in enumerate(data.splines[0].points):
        u, v = k % 4 / 1.5 - 1, k // 4 / 1.5 - 1
        point.co = 2.2 * u, 1.5 * v, 2.9 + 0.75 * u * v * (1 if abs(u * v) > 0.5 else 0) + (0.5 if abs(u) + abs(v) < 1 else 0), 1
    spline = data.splines[0]
    spline.use_endpoint_u = spline.use_endpoint_v = True
    spline.order_u = spline.order_v = 4
    spline.resolution_u = spline.resolution_v = 8
    add(scene, "Canopy", data, place, color="eae1d0", index=6)
    for u in (-1, 1):
        for v in (-1, 1):
            top = 2.9 + 0.75 * u * v
            pole = [(0, 0), (0.05, 0), (0.05, top), (0, top)]
            turned(scene, f"Pole {u * v}", pole, (place[0] + 2.16 * u, place[1] + 1.47 * v, 0), steps=16, color="8b6242", index=6)


def plane(scene):
    """Fill the scene with a propeller plane on its runway, nose to -y; return the empty that turns the propeller."""
    add(scene, "Grass", square(), color="93b06f", index=1).camera_ray_caster.primitive = "INFINITE_PLANE"
    block(scene, "Runway", (12, 90, 0.02), (0, 30, 0.01), edge=0, color="85888c", index=1)
    repeated(block(scene, "Dash", (0.3, 3, 0.01), (0, 4, 0.025), edge=0, color="f2efe8", index=1), (10, (0, 7, 0)))
    body = [(0, 0), (0.42, 0.02), (0.66, 0.2), (0.74, 0.6), (0.74, 1.6), (0.66, 3.0), (0.42, 4.8), (0.2, 6.2), (0, 6.3)]
    height = 1.65
    hull = turned(scene, "Fuselage", body, (0, 0, height), (-90, 0, 0), sharp=50, color="e2674a", index=2)
    modified(hull, "SUBSURF", levels=1, render_levels=1)
    turned(scene, "Cowling", [(0.45, -0.03), (0.56, -0.03), (0.7, 0.12), (0.75, 0.45), (0.76, 0.5)], (0, 0, height), (-90, 0, 0), color="eae1d0", index=2)
    add(scene, "Canopy", uv_sphere(), (0, 2.0, height + 0.55), scale=(0.42, 0.95, 0.5), color="8fc0d8", index=3)
    wing(scene, "Lower wing", 4.3, 1.4, (0, 0.75, height - 0.5), 4)
    wing(scene, "Upper wing", 4.6, 1.4, (0, 0.5, height + 1.25), 4)
    wing(scene, "Tail", 1.6, 0.8, (0, 5.5, height + 0.1), 0)
    prism(scene, "Fin", [(0, 0), (1.0, 0), (0.95, 1.0), (0.6, 1.15), (0.35, 0.9)], 0.08, (0, 5.3, height), (0, 0, 90), edge=0.03, color="f0b941", index=5)
    for side in (-1, 1):
        for x, lean in ((2.9, 0.1), (0.45, 0.05)):
            strut = [(side * x, 0.45, height - 0.4 + 0.06 * x), (side * (x + lean), 0.3, height + 1.2 + 0.06 * x)]
            tube(scene, "Strut", strut, 0.035, color="8b6242", index=6)
        tube(scene, "Leg", [(side * 0.4, 0.7, height - 0.5), (side * 0.85, 0.6, 0.42)], 0.05, color="8b6242", index=6)
        tire = [(0.2, 0.11), (0.38, 0.11), (0.42, 0.05), (0.42, -0.05), (0.38, -0.11), (0.2, -0.11)]
        turned(scene, "Tire", tire, (side * 0.92, 0.6, 0.42), (0, 90, 0), steps=32, color="2b2d42", index=7)
        turned(scene, "Hub", [(0, 0.1), (0.2, 0.1), (0.2, -0.1), (0, -0.1)], (side * 0.92, 0.6, 0.42), (0, 90, 0), steps=24, color="eae1d0", index=7)
    for k in range(7):
        angle = pi / 2 + 0.42 * (k - 3)
        place = 70 * cos(angle), 70 * sin(angle), 20 + 6 * sin(2.4 * k)
        add(scene, "Cloud", uv_sphere(), place, scale=(9, 4, 2.6 + sin(k)), color="f7f7f4", index=8)
        hill = (75 * cos(angle + 0.2), 75 * sin(angle + 0.2), -3), (0, 0, 0), (22, 12, 9 + 3 * sin(3 * k))
        add(scene, "Hill", uv_sphere(), *hill, color="7f9f88", index=8)
    sun(scene, (52, 0, -36), 2.2, "fff0d8")
    sun(scene, (80, 0, 50), 0.6, "dfe8ff")
    axis = add(scene, "Propeller", None, (0, -0.3, height))
    blade = drawn("blade", [(x, y, z) for z, half, turn in (
        (0.05, 0.07, 0.06), (0.5, 0.12, 0.07), (1.0, 0.13, 0.05), (1.35, 0.1, 0.03), (1.5, 0.03, 0.01)
    ) for x, y in ((-half, turn), (0, 0), (half, -turn))],
        faces=[(3 * j + k, 3 * j + k + 1, 3 * j + k + 4, 3 * j + k + 3) for j in range(4) for k in range(2)])  # fmt: skip
    for k in range(3):
        made = add(scene, "Blade", blade, turn=(0, 120 * k, 0), color="4a4f5c", index=9, parent=axis)
        modified(modified(made, "SUBSURF", levels=2, render_levels=2), "SOLIDIFY", thickness=0.04)
    spinner = [(0, -0.42), (0.1, -0.38), (0.2, -0.2), (0.24, 0.06), (0.2, 0.2)]
    turned(scene, "Spinner", spinner, turn=(-90, 0, 0), sharp=180, color="f0b941", index=9, parent=axis)
    return axis


def wing(scene, name: str, half: float, deep: float, place, raised: float) -> None:
    """Add a wing: a subdivided slab with round tips whose sides rise by ``raised`` degrees."""
    for side in (-1, 1):
        at = place[0] + side * half / 2 * cos(radians(raised)), place[1], place[2] + half / 2 * sin(radians(raised))
        soft(scene, f"{name} slab", (half + 0.1, deep, 0.16), at, (0, -side * raised, 0), crease=0.3, color="f0b941", index=5)
