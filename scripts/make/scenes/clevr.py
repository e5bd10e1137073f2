"""Random cubes, cylinders and balls on a floor, in the style of CLEVR, seen by a fisheye camera that circles them.

J. Johnson et al., CLEVR: A Diagnostic Dataset for Compositional Language and Elementary Visual Reasoning, CVPR 2017.
"""

from __future__ import annotations

from itertools import product
from math import cos, hypot, pi, radians, sin
from random import Random

import bpy
from mathutils import Vector

from .parts import add, camera, lamp, linear, render, square, sun, uv_sphere
from .solids import block, turned

COLORS = {
    "gray": "575757", "red": "ad2323", "blue": "2a4bd7", "green": "1d6914", "brown": "814a19", "purple": "8126c0",
    "cyan": "29d0d0", "yellow": "ffee33",
}  # fmt: skip
SIZES = {"large": 0.7, "small": 0.35}
ROUGHNESS = {"rubber": 0.7, "metal": 0.2}
SHAPES = "cube", "cylinder", "sphere"
APART, REACH = 0.25, 2.2
"""Minimum gap between objects, and maximum of their |x| and |y|."""
EYE = 3.8, 1.8
"""Radius of the camera's circle, and height of the camera."""
STEP = radians(8)
"""Angle between two successive views, in radians."""


def clevr(scene, views: int, count: int, size: tuple[int, int], seed: int) -> None:
    """Fill a scene: up to ``count`` objects, each with its category and pass index, and a frame for each view."""
    random = Random(seed)
    floor = add(scene, "floor", square(), scale=20)
    _dress(floor, "floor", "9a9a9a", "rubber")
    floor["category"] = "floor"
    places: list[tuple[float, float, float]] = []
    looks = list(product(SIZES, COLORS, ROUGHNESS, SHAPES))
    for index in range(1, count + 1):
        large, color, surface, shape = random.choice(looks)
        location = _place(random, SIZES[large], places)
        if location is None:
            break  # the floor is full
        places.append(location)
        thing = _solid(scene, shape, f"{large} {color} {surface} {shape} {index}", location, random.uniform(0, 90))
        thing.pass_index = index
        thing["category"] = shape
        _dress(thing, f"{color} {surface}", COLORS[color], surface)
    sun(scene, (35, 10, 30), 2.0)
    lamp(scene, (3, -3, 5), 400)
    kind = {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": radians(150)}
    eye = camera(scene, (EYE[0], 0, EYE[1]), type="PANO", **kind)
    start = random.uniform(0, 2 * pi)
    for view in range(views):
        angle = start + view * STEP
        eye.location = EYE[0] * cos(angle), EYE[0] * sin(angle), EYE[1]
        eye.rotation_euler = (Vector((0, 0, 0.4)) - eye.location).to_track_quat("-Z", "Y").to_euler()
        for path in ("location", "rotation_euler"):
            eye.keyframe_insert(path, frame=view + 1)
    render(scene, *size, world="b8c4d0")
    scene.frame_start, scene.frame_end = 1, views


def _place(random: Random, radius: float, taken) -> tuple[float, float, float] | None:
    """Return a free place on the floor as x, y and the radius, or None if none was found."""
    for _ in range(200):
        x, y = random.uniform(-REACH, REACH), random.uniform(-REACH, REACH)
        if all(hypot(x - a, y - b) > radius + r + APART for a, b, r in taken):
            return x, y, radius
    return None


def _solid(scene, shape: str, name: str, spot, turn: float):
    """Add an object of the named shape, standing on the floor."""
    x, y, radius = spot
    where, angles = (x, y, radius), (0, 0, turn)
    if shape == "cube":
        side = radius * 2**0.5
        return block(scene, name, (side,) * 3, (x, y, side / 2), angles, edge=0.05 * radius)
    if shape == "cylinder":
        profile = [(0, -radius), (radius, -radius), (radius, radius), (0, radius)]
        return turned(scene, name, profile, where, angles)
    return add(scene, name, uv_sphere(64, 32), where, angles, radius)


def _dress(thing, name: str, color: str, surface: str) -> None:
    """Give an object its own material slot, with a material that is made once for each name."""
    material = bpy.data.materials.get(name)
    if material is None:
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        inputs = material.node_tree.nodes["Principled BSDF"].inputs
        inputs["Base Color"].default_value = material.diffuse_color = linear(color)
        inputs["Metallic"].default_value = float(surface == "metal")
        inputs["Roughness"].default_value = ROUGHNESS[surface]
        material.pass_index = len(bpy.data.materials)
    if not thing.data.materials:
        thing.data.materials.append(None)
    thing.material_slots[0].link = "OBJECT"
    thing.material_slots[0].material = material
