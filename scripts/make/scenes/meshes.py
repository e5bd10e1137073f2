"""Scenes of realistic meshes, each seen by suitable cameras."""

from __future__ import annotations

from functools import partial
from math import cos, pi, radians, sin

from .multiperspective import circle, slit
from .parts import add, square, sun
from .places.airfield import airfield
from .places.living_room import living_room as furnish
from .places.rotunda import rotunda
from .places.sculpture_garden import sculpture_garden as garden
from .places.street import CAR
from .places.street import street as houses
from .places.toy_table import backdrop, toy_table
from .sets import photograph
from .solids import block, monkey, turned
from .time import driven

SKY, DAYLIGHT, STUDIO = "86aed0", "9ca8ae", "848f9c"
"""Colors of the world: the background, and light from all directions."""

picture = partial(photograph, shading="MATERIAL")
"""Take a picture with the colors of materials, without a grid."""


def toys(scene):
    """Blocks, cylinders, rings, a cone and a subdivided monkey are cast as triangles, balls as exact spheres. Each
    object has its own pass index.
    """
    toy_table(scene)
    picture(scene, (0.3, -9.6, 4.2), (0.1, 0, 0.75), 800, 450, world=STUDIO, lens=43)


def toys_cross_slit(scene):
    """The same toys are seen by a cross-slit camera with a vertical slit behind them. Farther objects are wider, and
    blocks show both of their sides.
    """
    toy_table(scene)
    upright, level = slit(scene, "Upright slit", (0, 8.8, 0), (0, -90, 0)), slit(scene, "Level slit", (0, -18, 8.0))
    settings = {"model": "CROSS_SLIT", "slit_1": upright, "slit_2": level}
    picture(scene, (0, -4.4, 2.5), (0, 9, 2.5), 800, 360, world=STUDIO, addon=settings, lens=18 / 5.8)


def real_lens(scene):
    """The toys through a double Gauss lens of 1954, traced surface by surface, wide open at f/2. The lens and its film
    are ten times as large as those of a small camera, as the toys are. The corners are darker, and points beside the
    plane of focus have the shape of what the rims leave of the pupil.
    """
    toy_table(scene)
    look = {"world": STUDIO, "addon": {"model": "REAL_LENS"}}
    made = picture(scene, (0.3, -9.6, 4.2), (0.1, 0, 0.75), 320, 180, lens=500, sensor_width=360, **look)
    made.data.dof.use_dof, made.data.dof.focus_distance, made.data.dof.aperture_fstop = True, 10.0, 2.0
    scene.camera_ray_caster.samples = 48


def living_room(scene):
    """Two hundred meshes are made with arrays, bevels, lathes and cushions. The floor, the walls, the rug and all light
    wood have image textures. Pass indices distinguish the kinds of furniture.
    """
    furnish(scene)
    picture(scene, (2.3, -2.7, 1.65), (-0.42, 1.0, 1.02), 560, 350, world=DAYLIGHT, lens=18.5)


def living_room_equirectangular(scene):
    """An equirectangular panorama for VR shows the whole room. Straight beams appear as arches, and the floor fills the
    bottom of the picture.
    """
    furnish(scene)
    kind = {"type": "PANO", "panorama_type": "EQUIRECTANGULAR"}
    picture(scene, (0.95, -1.1, 1.45), (0.5, 2.2, 1.45), 720, 360, world=DAYLIGHT, **kind)


def living_room_omnimax(scene):
    """A camera for IMAX Dome films, tilted up by 15 degrees, shows the same room, mostly overhead. Beams and the far
    edge of the table appear curved.
    """
    furnish(scene)
    settings = {"model": "OMNIMAX", "tilt": radians(15)}
    picture(scene, (-0.25, -1.55, 1.3), (-0.25, 2.2, 1.3), 480, 374, world=DAYLIGHT, addon=settings)


def rotunda_fisheye(scene):
    """An equidistant fisheye of 190 degrees shows the floor, the columns and the dome in one picture. The ribs of the
    dome are a wireframe.
    """
    rotunda(scene)
    kind = {"type": "PANO", "panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": radians(190)}
    picture(scene, (1.2, -4.2, 1.7), (0, 2.0, 2.6), 400, 400, world=SKY, **kind)


def rotunda_panorama(scene):
    """A cylindrical panorama covers 360 degrees between the columns. The columns stay vertical, and the round beam
    above them appears as a wave.
    """
    rotunda(scene)
    angles = {"pan_min": -pi, "pan_max": pi, "latitude_bottom": radians(-35), "latitude_top": radians(50)}
    picture(scene, (1.2, -3.6, 1.7), (0.3, 2.0, 1.7), 800, 256, world=SKY, addon={"model": "CYLINDRICAL", **angles})


def street(scene):
    """A perspective camera shows a street. The nearest house is taller than the picture, and the farthest house is only
    a few pixels wide.
    """
    houses(scene)
    picture(scene, (-13.6, -3.8, 2.3), (-2, 0.4, 2.7), 640, 400, world=SKY, lens=21, shift_y=0.05)


def street_pushbroom(scene):
    """A pushbroom camera moves along the same street. All houses are seen from the front, and near objects are taller
    but not wider.
    """
    houses(scene)
    eye = 0, -6.5, 3.2
    settings = {"model": "PUSHBROOM", "slit_1": slit(scene, "Slit", eye)}
    lens = {"lens": 36 * 10.5 / 30, "ortho_scale": 30, "shift_y": 0.015}  # as wide as tall at the fronts
    picture(scene, eye, (0, 4, 3.2), 840, 364, world=SKY, addon=settings, **lens)


def street_scanner(scene):
    """A scanner with 64 beams is driven along the street at 15 m/s while it turns: a row is a beam, a column a moment
    of the sweep, in which another car comes the other way.
    """
    houses(scene)
    scene.render.fps = 10
    wheels = add(scene, "Drive")
    for thing in [thing for thing in scene.objects if thing.pass_index == CAR and thing.location.x > 0]:
        thing.parent = wheels
    driven(wheels, "location", 0, "-1.2 * (frame - 1)")
    settings = {"model": "SCANNER", "time_mode": "SWEEP", "scanner_device": "OS1_64", "scanner_start": pi / 2}
    camera = picture(scene, (-6, -2.6, 1.9), (0, -2.6, 1.9), 1024, 64, world=SKY, addon=settings)
    driven(camera, "location", 0, "-6 + 1.5 * (frame - 1)")


def sculpture_garden(scene):
    """The garden contains letters, a knotted curve, metaballs and a NURBS canopy. Geometry nodes place trees on a
    subdivided hill.
    """
    garden(scene)
    picture(scene, (1.1, -6.4, 1.75), (0.3, 0.6, 1.6), 640, 400, world=SKY, lens=26)


def propeller(scene):
    """A rolling shutter reads each row later than the one above. The straight blades of a propeller that turns once
    look bent and gathered on one side.
    """
    driven(airfield(scene), "rotation_euler", 1, f"-frame * {2 * pi:.6f}")
    scene.render.motion_blur_shutter = 1
    scene.cycles.rolling_shutter_duration = 0
    settings = {"time_mode": "ROLLING_SHUTTER"}
    picture(scene, (0.9, -8.6, 1.5), (0.05, 0, 1.9), 640, 360, world=SKY, addon=settings, lens=31)


def twisted_monkey(scene):
    """A slit scan shows a bust that turns. Each row of the picture shows the bust a little later than the row below it.
    """
    backdrop(scene)
    axis = add(scene, "Turntable")
    monkey(scene, (0, 0, 2.35), (-14, 0, 0), 1.15, levels=3, color="e2674a", index=2, parent=axis)
    block(scene, "Column", (0.9, 0.9, 1.3), (0, 0, 0.65), edge=0.04, color="3f7cc0", index=3, parent=axis)
    driven(axis, "rotation_euler", 2, f"(frame - 13) * {pi / 36:.6f}")
    settings = {"time_mode": "ROWS", "time_start": 1, "time_end": 25}
    picture(scene, (0, -8, 2.6), (0, 0, 1.7), 440, 400, world=STUDIO, addon=settings, lens=60)


def unrolled_monkey(scene):
    """A strip camera moves around a bust. The face, the ears and the back of the head appear side by side, with pillars
    in the background.
    """
    add(scene, "Lawn", square(), (0, 0, -0.02), scale=60, color="9ab97b", index=1)
    turned(scene, "Plaza", [(0, 0), (6, 0), (6, -0.02)], steps=64, color="d8ccb4", index=1)
    monkey(scene, (0, 0, 2.35), (-14, 0, 0), 1.0, levels=1, color="e2674a", index=2)
    block(scene, "Column", (0.9, 0.9, 1.4), (0, 0, 0.7), edge=0.04, color="3f7cc0", index=3)
    shaft = [(0, 3.9), (0.5, 3.9), (0.5, 3.7), (0.33, 3.5), (0.38, 0.3), (0.5, 0.15), (0.5, 0)]
    for k, color in enumerate(("eae1d0", "f0b941", "eae1d0", "2a9d8f", "eae1d0", "8a63b8", "eae1d0", "d9809a")):
        angle = 2 * pi * (k + 0.5) / 8
        location = 5 * cos(angle), 5 * sin(angle), 0
        turned(scene, "Pillar", shaft, location, steps=32, color=color, index=4)
    sun(scene, (48, 0, -46), 2.2, "fff0d8")
    sun(scene, (70, 0, 130), 1.0, "ffe6cc")
    path = circle(scene, (0, 0, 2.1), 2.6)
    path.rotation_euler.z = pi  # the path begins behind the head
    settings = {"model": "STRIP", "path": path, "follow_path": True}
    picture(scene, (0, 2.6, 2.1), (0, 0, 2.1), 720, 280, world=SKY, addon=settings, lens=11, shift_y=0.045)
