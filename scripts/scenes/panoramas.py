"""All around in one picture: Blender's own panoramas, and those that it does not have."""

from __future__ import annotations

from math import pi, radians

from .sets import meadow, photograph, room

MIDDLE, AHEAD = (0, -0.8, 2.2), (0, 6, 2.2)


def panorama(scene, kind: str, width: int, height: int, **settings) -> None:
    """Take one of Blender's panoramas in the middle of the room."""
    room(scene)
    photograph(scene, MIDDLE, AHEAD, width, height, type="PANO", panorama_type=kind, **settings)


def equirectangular(scene):
    """longitude and latitude; every direction has a pixel, the poles whole rows, and a ball behind crosses the seam."""
    panorama(scene, "EQUIRECTANGULAR", 600, 300)


def cubemap_face(scene):
    """one face of an equiangular cube map: 90 degrees, pixels spread evenly over the angle, edges that have to meet."""
    panorama(scene, "EQUIANGULAR_CUBEMAP_FACE", 400, 400)


def mirrorball(scene):
    """what a mirroring ball shows: 360 degrees in a disc, whose rim is one single point, straight behind."""
    panorama(scene, "MIRRORBALL", 304, 304)


def fisheye_equidistant(scene):
    """radius grows evenly with the angle, up to 250 degrees: rays that look backwards, none beyond the rim."""
    panorama(scene, "FISHEYE_EQUIDISTANT", 340, 340, fisheye_fov=radians(250))


def fisheye_equisolid(scene):
    """equal solid angles are equal areas; lens and sensor in millimeters cut the disc at the frame's top and bottom."""
    panorama(scene, "FISHEYE_EQUISOLID", 450, 300, fisheye_lens=9.5, fisheye_fov=radians(180), sensor_width=36)


def fisheye_polynomial(scene):
    """a lens measured as a polynomial of degree 4: its inverse has no formula."""
    k = (0, -0.115, 0, 7e-5, -4e-6)
    terms = {f"fisheye_polynomial_k{power}": value for power, value in enumerate(k)}
    panorama(scene, "FISHEYE_LENS_POLYNOMIAL", 435, 290, fisheye_fov=radians(200), sensor_width=36, **terms)


def central_cylindrical(scene):
    """a turn around the room on a cylinder: uprights stay straight, the height is the tangent of the latitude."""
    ranges = {"central_cylindrical_range_v_min": -0.9, "central_cylindrical_range_v_max": 0.9}
    panorama(scene, "CENTRAL_CYLINDRICAL", 640, 184, **ranges)


def cylindrical(scene):
    """the same over chosen angles, here 220 degrees around and from 30 below to 45 above the horizon."""
    meadow(scene)
    angles = {"pan_min": radians(-110), "pan_max": radians(110)}
    heights = {"latitude_bottom": radians(-30), "latitude_top": radians(45)}
    own = {"model": "CYLINDRICAL", **angles, **heights}
    photograph(scene, (0, 0, 1.8), (0, 6, 1.8), 640, 263, world="bcd7ea", own=own)


def little_planet(scene):
    """the stereographic panorama that looks down: the ground is a planet, the sky is everywhere beyond its horizon."""
    meadow(scene)
    own = {"model": "STEREOGRAPHIC_PANORAMA", "fov": radians(250), "elevation": -pi / 2}
    photograph(scene, (0, 0, 3.4), (0, 6, 3.4), 400, 400, world="bcd7ea", own=own)


def omnidirectional_stereo(scene):
    """a panorama for each eye, the left one above: the eyes move on a circle, so no point is the center of all rays."""
    room(scene)
    own = {"model": "OMNIDIRECTIONAL_STEREO", "eye": "TOP_BOTTOM"}
    made = photograph(scene, MIDDLE, AHEAD, 360, 360, own=own)
    made.data.stereo.interocular_distance = 0.3
