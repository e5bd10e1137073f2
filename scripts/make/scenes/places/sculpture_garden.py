"""Sculptures of every kind of geometry: letters, a curve, metaballs, a NURBS surface, a subdivided mesh, instances."""

from __future__ import annotations

from math import cos, pi, sin

import bpy

from ..parts import add, square, sun
from ..solids import assembled, blob, block, letters, modified, monkey, scattered, sheet, tube, turned
from .tree import tree


def sculpture_garden(scene) -> None:
    """Fill the scene with letters, a knot, metaballs, a canopy, and a hill with trees placed by geometry nodes."""
    add(scene, "Lawn", square(), scale=90, color="9ab97b", index=1)
    hill(scene)
    path = [(0, 0.012), (3.3, 0.012), (3.3, 0)]
    turned(scene, "Plaza", path, (0.3, 0.6, 0), steps=96, color="d8ccb4", index=1)
    letters(scene, "RAYS", (0.3, -0.35, 0.04), (90, 0, 0), size=1.45, color="e2674a", index=3)
    plinth(scene, -2.9, 1.6, 0.55, 0.9)
    turns = [2 * pi * k / 24 for k in range(24)]
    knot = [(0.26 * (sin(t) + 2 * sin(2 * t)), 0.26 * (cos(t) - 2 * cos(2 * t)), -0.3 * sin(3 * t)) for t in turns]
    tube(scene, "Knot", knot, 0.13, (-2.9, 1.6, 1.75), (80, 0, 20), closed=True, color="8a63b8", index=4)
    plinth(scene, 3.35, 1.6, 0.6, 0.6)
    drops = (
        (0, 0, 0, 0.75),
        (0.3, 0.05, 0.42, 0.6),
        (-0.16, 0.1, 0.75, 0.62),
        (0.1, -0.05, 1.12, 0.55),
        (0.2, 0, 1.5, 0.4),
    )
    blob(scene, "Drops", drops, (3.35, 1.6, 0.95), color="2a9d8f", index=5)
    sail(scene, (0.35, 2.9, 0))
    monkey(scene, (0.3, 2.7, 1.62), (-14, 0, 0), 0.66, color="f0b941", index=7)
    plinth(scene, 0.3, 2.75, 0.5, 1.05)
    sun(scene, (48, 0, -46), 2.2, "fff0d8")
    sun(scene, (80, 0, 12), 0.9, "ffe6cc")


def plinth(scene, x: float, y: float, half: float, high: float) -> None:
    """Add a stone block as a base."""
    block(scene, "Plinth", (2 * half, 2 * half, high), (x, y, high / 2), edge=0.04, color="c9bfae", index=2)


def hill(scene) -> None:
    """Add hills, and trees placed on them by geometry nodes."""
    count = 19
    places = []
    for j in range(count):
        for i in range(count):
            x, y = 80 * i / (count - 1) - 40, 26 * j / (count - 1)
            high = 5.5 * sin(pi * y / 52) ** 2 * (1 + 0.45 * sin(0.21 * x + 1) + 0.2 * sin(0.5 * x + 0.3 * y + 4.2))
            places.append((x, 14 + y, high - 0.3))
    data = sheet("hill", places, count)
    for name, color, index in (("Hill", "86ad72", 1), ("Forest", "", 8)):
        forest = modified(add(scene, name, data, color=color, index=index), "SUBSURF", levels=1, render_levels=1)
    trees = []
    for kind in range(3):
        before = set(scene.objects)
        tree(scene, (0, 0, 0), 0.95 + 0.2 * kind, kind)
        trees.append(assembled(scene, f"Tree {kind}", set(scene.objects) - before))
    kinds = bpy.data.collections.new("Trees")
    for tree_kind in trees:
        kinds.children.link(tree_kind)
    scattered(forest, kinds, 0.035, seed=3)


def sail(scene, location) -> None:
    """Add a canopy, a NURBS surface of 4 by 4 points, on four posts."""
    bpy.ops.surface.primitive_nurbs_surface_surface_add()
    made = bpy.context.object
    data = made.data
    bpy.data.objects.remove(made)
    spline = data.splines[0]
    for k, point in enumerate(spline.points):
        u, v = k % 4 / 1.5 - 1, k // 4 / 1.5 - 1
        corner, middle = abs(u * v) == 1, abs(u) + abs(v) < 1
        point.co = 2.2 * u, 1.5 * v, 2.9 + 0.75 * u * v * corner + 0.5 * middle, 1
    spline.use_endpoint_u = spline.use_endpoint_v = True
    spline.order_u = spline.order_v = 4
    spline.resolution_u = spline.resolution_v = 8
    add(scene, "Canopy", data, location, color="eae1d0", index=6)
    for u in (-1, 1):
        for v in (-1, 1):
            top = 2.9 + 0.75 * u * v
            post = [(0, 0), (0.05, 0), (0.05, top), (0, top)]
            foot = location[0] + 2.16 * u, location[1] + 1.47 * v, 0
            turned(scene, "Post", post, foot, steps=16, color="8b6242", index=6)
