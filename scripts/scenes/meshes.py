"""Scenes of real-looking meshes, each seen by the cameras that show it best."""

from __future__ import annotations

from functools import partial
from math import pi, radians

from .multiperspective import slit
from .parts import add
from .places.airfield import airfield
from .places.living_room import living_room as furnish
from .places.rotunda import rotunda
from .places.sculpture_garden import sculpture_garden as garden
from .places.street import street as houses
from .places.toy_table import backdrop, toy_table
from .sets import photograph
from .solids import block, monkey
from .time import driven

SKY, DAYLIGHT, STUDIO = "86aed0", "9ca8ae", "848f9c"
"""Worlds: what is behind everything, and light from all around."""

picture = partial(photograph, shading="MATERIAL")
"""Colors of materials, without a grid."""


def toys(scene):
    """blocks, cylinders, rings, a cone, a subdivided monkey are triangles, balls exact spheres: an index for each."""
    toy_table(scene)
    picture(scene, (0.3, -9.6, 4.2), (0.1, 0, 0.75), 800, 450, world=STUDIO, lens=43)


def living_room(scene):
    """two hundred meshes by arrays, bevels, lathes and cushions: pass indices tell kinds of furniture apart."""
    furnish(scene)
    picture(scene, (2.3, -2.7, 1.65), (-0.42, 1.0, 1.02), 560, 350, world=DAYLIGHT, lens=18.5)


def living_room_equirectangular(scene):
    """the same room, all of it, as panoramas for VR show it: straight beams are arches, the floor fills the foot."""
    furnish(scene)
    kind = {"type": "PANO", "panorama_type": "EQUIRECTANGULAR"}
    picture(scene, (0.95, -1.1, 1.45), (0.5, 2.2, 1.45), 720, 360, world=DAYLIGHT, **kind)


def rotunda_fisheye(scene):
    """an equidistant fisheye of 190 degrees sees floor, columns and dome at once; the dome's ribs are a wireframe."""
    rotunda(scene)
    kind = {"type": "PANO", "panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": radians(190)}
    picture(scene, (1.2, -4.2, 1.7), (0, 2.0, 2.6), 400, 400, world=SKY, **kind)


def rotunda_panorama(scene):
    """a full turn on a cylinder, between the columns: they stay upright, the round beam becomes a wave."""
    rotunda(scene)
    angles = {"pan_min": -pi, "pan_max": pi, "latitude_bottom": radians(-35), "latitude_top": radians(50)}
    picture(scene, (1.2, -3.6, 1.7), (0.3, 2.0, 1.7), 800, 256, world=SKY, own={"model": "CYLINDRICAL", **angles})


def street(scene):
    """a street in perspective: the nearest house is taller than the picture, the farthest a few pixels wide."""
    houses(scene)
    picture(scene, (-13.6, -3.8, 2.3), (-2, 0.4, 2.7), 640, 400, world=SKY, lens=21, shift_y=0.05)


def street_pushbroom(scene):
    """the same street from an eye that drives along it: all its fronts face us; what is near is tall, but not wide."""
    houses(scene)
    eye = 0, -6.5, 3.2
    own = {"model": "PUSHBROOM", "slit_1": slit(scene, "Slit", eye)}
    as_wide_as_tall = 36 * 10.5 / 30  # at the fronts
    picture(scene, eye, (0, 4, 3.2), 840, 364, world=SKY, own=own, lens=as_wide_as_tall, ortho_scale=30, shift_y=0.015)


def sculpture_garden(scene):
    """letters, a knotted curve, metaballs, a NURBS canopy, and a wood that geometry nodes put on a subdivided hill."""
    garden(scene)
    picture(scene, (1.1, -6.4, 1.75), (0.3, 0.6, 1.6), 640, 400, world=SKY, lens=26)


def propeller(scene):
    """a rolling shutter, each row later than the one above: straight blades that turn once are bent, and gather."""
    driven(airfield(scene), "rotation_euler", 1, f"-frame * {2 * pi:.6f}")
    scene.render.motion_blur_shutter = 1
    scene.cycles.rolling_shutter_duration = 0
    picture(scene, (0.9, -8.6, 1.5), (0.05, 0, 1.9), 640, 360, world=SKY, own={"time_mode": "ROLLING_SHUTTER"}, lens=31)


def twisted_monkey(scene):
    """a slit scan of a bust that turns: each row of the picture shows it a little later than the row below."""
    backdrop(scene)
    axis = add(scene, "Turntable")
    monkey(scene, (0, 0, 2.35), (-14, 0, 0), 1.15, levels=3, color="e2674a", index=2, parent=axis)
    block(scene, "Column", (0.9, 0.9, 1.3), (0, 0, 0.65), edge=0.04, color="3f7cc0", index=3, parent=axis)
    driven(axis, "rotation_euler", 2, f"(frame - 13) * {pi / 36:.6f}")
    own = {"time_mode": "ROWS", "time_start": 1, "time_end": 25}
    picture(scene, (0, -8, 2.6), (0, 0, 1.7), 440, 400, world=STUDIO, own=own, lens=60)
