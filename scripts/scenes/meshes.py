"""Scenes of real-looking meshes, each seen by the cameras that show it best."""

from __future__ import annotations

from functools import partial
from math import pi, radians

from .indoors import backdrop, toy_table
from .living_room import living_room
from .multiperspective import circle, slit
from .outdoors import plane, rotunda, sculptures
from .parts import add
from .sets import photograph
from .solids import block, monkey
from .time import driven
from .town import street

picture = partial(photograph, shading="MATERIAL")
"""Colors of materials, no grid."""


def toys(scene):
    """blocks, cylinders, rings, a cone, a subdivided Suzanne, and balls, which are exact spheres."""
    toy_table(scene)
    picture(scene, (0.3, -9.6, 4.2), (0.1, 0, 0.75), 800, 450, world="848f9c", lens=44)


def room_of_meshes(scene):
    """a living room."""
    living_room(scene)
    picture(scene, (2.3, -2.7, 1.65), (-0.42, 1.0, 1.02), 640, 400, world="869fb5", lens=18.5)


def room_all_around(scene):
    """equirect."""
    living_room(scene)
    picture(scene, (0.95, -1.1, 1.45), (0.5, 2.2, 1.45), 720, 360, world="869fb5", type="PANO", panorama_type="EQUIRECTANGULAR")


def rotunda_fisheye(scene):
    rotunda(scene)
    picture(scene, (1.2, -4.2, 1.7), (0, 2.0, 2.6), 400, 400, world="86aed0", type="PANO", panorama_type="FISHEYE_EQUIDISTANT", fisheye_fov=radians(190))


def rotunda_cylindrical(scene):
    rotunda(scene)
    own = {"model": "CYLINDRICAL", "pan_min": -pi, "pan_max": pi, "latitude_bottom": radians(-35), "latitude_top": radians(50)}
    picture(scene, (1.2, -3.6, 1.7), (0.3, 2.0, 1.7), 800, 256, world="86aed0", own=own)


def rotunda_omnimax(scene):
    rotunda(scene)
    own = {"model": "OMNIMAX", "tilt": radians(20)}
    picture(scene, (1.2, -4.2, 1.7), (0, 2.0, 1.7), 480, 374, world="86aed0", own=own)

def rotunda_plain(scene):
    rotunda(scene)
    picture(scene, (1.2, -12.2, 2.7), (0, 2.0, 3), 640, 400, world="86aed0", lens=22)

def street_along(scene):
    street(scene)
    picture(scene, (-13.6, -3.8, 2.3), (-2, 0.4, 2.7), 640, 400, world="86aed0", lens=21, shift_y=0.05)


def street_pushbroom(scene):
    street(scene)
    own = {"model": "PUSHBROOM", "slit_1": slit(scene, "Slit", (0, -6.5, 3.2))}
    picture(scene, (0, -6.5, 3.2), (0, 4, 3.2), 840, 364, world="86aed0", own=own, lens=36 * 10.5 / 30, ortho_scale=30, shift_y=0.015)


def sculpture_garden(scene):
    sculptures(scene)
    picture(scene, (1.1, -6.4, 1.75), (0.3, 0.6, 1.6), 640, 400, world="86aed0", lens=26)


def propeller(scene):
    axis = plane(scene)
    driven(axis, "rotation_euler", 1, f"-frame * {2 * pi:.6f}")
    scene.render.motion_blur_shutter = 1
    scene.cycles.rolling_shutter_duration = 0
    picture(scene, (0.9, -8.6, 1.5), (0.05, 0, 1.85), 640, 400, world="86aed0", own={"time_mode": "ROLLING_SHUTTER"}, lens=33)


def twisted_monkey(scene):
    backdrop(scene)
    axis = add(scene, "Turntable", None)
    monkey(scene, (0, 0, 2.35), (-14, 0, 0), 1.15, levels=3, color="e2674a", index=2, parent=axis)
    block(scene, "Column", (0.9, 0.9, 1.3), (0, 0, 0.65), edge=0.04, color="3f7cc0", index=3, parent=axis)
    driven(axis, "rotation_euler", 2, f"(frame - 13) * {pi / 36:.6f}")
    own = {"time_mode": "ROWS", "time_start": 1, "time_end": 25}
    picture(scene, (0, -8, 2.6), (0, 0, 1.7), 440, 400, world="848f9c", own=own, lens=60)


def rotunda_strip(scene):
    rotunda(scene)
    own = {"model": "STRIP", "path": circle(scene, (0, 0, 2.1), 1.7), "follow_path": True}
    picture(scene, (0, -1.7, 2.1), (0, 0, 2.1), 480, 240, world="86aed0", own=own, lens=25)
