"""Lenses and apertures: a pinhole for comparison, camera obscura, thin lens, fisheyes and dome lenses."""

from __future__ import annotations

from math import pi, radians

from .sets import meadow, photograph, room

CORNER, AHEAD = (0.6, -5.2, 2.5), (0.1, 2.5, 1.9)
MIDDLE, FRONT = (0, -0.8, 2.2), (0, 6, 2.2)


def pinhole(scene):
    """Blender's perspective camera shows the room, for comparison with the other cameras of the gallery."""
    room(scene)
    photograph(scene, CORNER, AHEAD, lens=22)


def isometric(scene):
    """Orthographic rays along a diagonal of the room show its three directions at the same scale. Parallel lines stay
    parallel, and the size of a ball does not depend on its distance.
    """
    room(scene)
    photograph(scene, (0.2, 0.5, 3.3), (1.2, 1.5, 2.3), type="ORTHO", ortho_scale=9)


def camera_obscura(scene):
    """A box 2 m deep has a hole of 3 cm. The picture on its back wall is upside down and blurred by the width of the
    hole.
    """
    room(scene)
    box = {"model": "CAMERA_OBSCURA", "obscura_depth": 2, "obscura_width": 3.27, "obscura_hole": 0.03}
    photograph(scene, CORNER, AHEAD, 352, 220, addon=box)
    scene.camera_ray_caster.samples = 64


def thin_lens(scene):
    """A thin lens has depth of field. The plane through the center of the red ball is in focus, and objects in front of
    and behind it are blurred.
    """
    room(scene)
    made = photograph(scene, CORNER, AHEAD, 352, 220, lens=22)
    lens = made.data.dof
    lens.use_dof, lens.aperture_fstop, lens.focus_object = True, 0.05, scene.objects["Red"]
    scene.camera_ray_caster.samples = 64


def fish_tank(scene):
    """The room under water, seen askew through the side of a fish tank. Both faces of the glass refract each ray: all
    is larger than from air, more so to the sides, and straight lines are bent.
    """
    room(scene)
    tank = {"port": "FLAT", "port_distance": 600, "port_thickness": 100, "port_tilt_y": radians(20)}
    photograph(scene, CORNER, AHEAD, lens=14, addon=tank)


def fisheye_orthographic(scene):
    """An orthographic fisheye shows the hemisphere ahead as if seen from far away. The rim is compressed into the last
    pixels of the disc.
    """
    room(scene)
    photograph(scene, MIDDLE, FRONT, 360, 360, addon={"model": "FISHEYE_ORTHOGRAPHIC", "fov": pi})


def fisheye_stereographic(scene):
    """A stereographic fisheye preserves angles. Every ball appears as a circle, and grid lines cross at right angles up
    to the rim.
    """
    room(scene)
    photograph(scene, MIDDLE, FRONT, 360, 360, addon={"model": "FISHEYE_STEREOGRAPHIC", "fov": radians(220)})


def omnimax(scene):
    """A camera for IMAX Dome films is tilted up by 20 degrees. The optical axis is low in the frame, and most of the
    picture shows what is overhead.
    """
    meadow(scene)
    settings = {"model": "OMNIMAX", "tilt": radians(20)}
    photograph(scene, (0, 0, 1.8), (0, 6, 1.8), 480, 374, world="bcd7ea", addon=settings)


def dome_master(scene):
    """The picture is a disc for a planetarium dome that is tilted by 15 degrees. The zenith is in the middle, and the
    front is at the bottom.
    """
    meadow(scene)
    settings = {"model": "DOME_MASTER", "fov": pi, "tilt": radians(15)}
    photograph(scene, (0, 0, 1.8), (0, 6, 1.8), 400, 400, world="bcd7ea", addon=settings)
