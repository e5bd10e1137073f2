"""Lenses and holes: a pinhole to compare with, camera obscura, thin lens, fisheyes and dome lenses."""

from __future__ import annotations

from math import pi, radians

from .sets import meadow, photograph, room

CORNER, AHEAD = (0.6, -5.2, 2.5), (0.1, 2.5, 1.9)
MIDDLE, FRONT = (0, -0.8, 2.2), (0, 6, 2.2)


def pinhole(scene):
    """Blender's perspective: the room as all others of the gallery are to be compared with it."""
    room(scene)
    photograph(scene, CORNER, AHEAD, lens=22)


def camera_obscura(scene):
    """a box 2 deep with a hole of 3 cm: the picture on its wall stands on its head, blurred by as much as the hole."""
    room(scene)
    box = {"model": "CAMERA_OBSCURA", "obscura_depth": 2, "obscura_width": 3.27, "obscura_hole": 0.03}
    photograph(scene, CORNER, AHEAD, 352, 220, own=box)
    scene.camera_ray_caster.samples = 64


def thin_lens(scene):
    """depth of field: sharp on the plane of the red ball's center, blurred before and behind it."""
    room(scene)
    made = photograph(scene, CORNER, AHEAD, 352, 220, lens=22)
    lens = made.data.dof
    lens.use_dof, lens.aperture_fstop, lens.focus_object = True, 0.05, scene.objects["Red"]
    scene.camera_ray_caster.samples = 64


def fisheye_orthographic(scene):
    """the half sphere ahead as seen from far away: all the rim is squeezed into the last pixels of the disc."""
    room(scene)
    photograph(scene, MIDDLE, FRONT, 360, 360, own={"model": "FISHEYE_ORTHOGRAPHIC", "fov": pi})


def fisheye_stereographic(scene):
    """keeps angles: every ball is a circle, wherever it is, and grid lines cross at right angles up to the rim."""
    room(scene)
    photograph(scene, MIDDLE, FRONT, 360, 360, own={"model": "FISHEYE_STEREOGRAPHIC", "fov": radians(220)})


def omnimax(scene):
    """the film of IMAX domes, tilted by 20 degrees: the axis lies low in the frame, most of the picture is overhead."""
    meadow(scene)
    own = {"model": "OMNIMAX", "tilt": radians(20)}
    photograph(scene, (0, 0, 1.8), (0, 6, 1.8), 480, 374, world="bcd7ea", own=own)


def dome_master(scene):
    """a planetarium's disc: the zenith in the middle, the front at the bottom, the dome tipped by 15 degrees."""
    meadow(scene)
    own = {"model": "DOME_MASTER", "fov": pi, "tilt": radians(15)}
    photograph(scene, (0, 0, 1.8), (0, 6, 1.8), 400, 400, world="bcd7ea", own=own)
