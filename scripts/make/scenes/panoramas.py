"""Panoramas: Blender's own, and those that Blender does not have."""

from __future__ import annotations

from math import pi, radians

from .sets import meadow, photograph, room

MIDDLE, AHEAD = (0, -0.8, 2.2), (0, 6, 2.2)


def panorama(scene, kind: str, width: int, height: int, **settings) -> None:
    """Take a picture with one of Blender's panoramas in the middle of the room."""
    room(scene)
    photograph(scene, MIDDLE, AHEAD, width, height, type="PANO", panorama_type=kind, **settings)


def equirectangular(scene):
    """Longitude and latitude are the picture's coordinates. Every direction has a pixel, each pole fills a row, and the
    seam is behind the camera.
    """
    panorama(scene, "EQUIRECTANGULAR", 600, 300)


def cubemap_face(scene):
    """One face of an equiangular cube map covers 90 degrees. Pixels are evenly spaced in angle, and the edges have to
    match those of the other faces.
    """
    panorama(scene, "EQUIANGULAR_CUBEMAP_FACE", 400, 400)


def mirrorball(scene):
    """A mirror ball shows 360 degrees in a disc. The whole rim is a single point, straight behind the camera."""
    panorama(scene, "MIRRORBALL", 304, 304)


def fisheye_equidistant(scene):
    """The radius is proportional to the angle, with a field of view of 250 degrees. Some rays point backward; beyond
    the rim there are no rays.
    """
    panorama(scene, "FISHEYE_EQUIDISTANT", 340, 340, fisheye_fov=radians(250))


def fisheye_equisolid(scene):
    """Equal solid angles have equal areas in the picture. Lens and sensor are set in millimeters; the frame crops the
    disc at the top and bottom.
    """
    panorama(scene, "FISHEYE_EQUISOLID", 450, 300, fisheye_lens=9.5, fisheye_fov=radians(180), sensor_width=36)


def fisheye_polynomial(scene):
    """A measured lens is given by a polynomial of degree 4. Its inverse has no formula and is computed numerically."""
    k = (0, -0.115, 0, 7e-5, -4e-6)
    terms = {f"fisheye_polynomial_k{power}": value for power, value in enumerate(k)}
    panorama(scene, "FISHEYE_LENS_POLYNOMIAL", 435, 290, fisheye_fov=radians(200), sensor_width=36, **terms)


def central_cylindrical(scene):
    """A cylindrical panorama shows a full turn around the room. Vertical lines stay straight, and the height is the
    tangent of the latitude.
    """
    ranges = {"central_cylindrical_range_v_min": -0.9, "central_cylindrical_range_v_max": 0.9}
    panorama(scene, "CENTRAL_CYLINDRICAL", 640, 184, **ranges)


def cylindrical(scene):
    """A cylindrical panorama covers chosen angles: here 220 degrees around, and from 30 degrees below to 45 degrees
    above the horizon.
    """
    meadow(scene)
    angles = {"pan_min": radians(-110), "pan_max": radians(110)}
    heights = {"latitude_bottom": radians(-30), "latitude_top": radians(45)}
    settings = {"model": "CYLINDRICAL", **angles, **heights}
    photograph(scene, (0, 0, 1.8), (0, 6, 1.8), 640, 263, world="bcd7ea", addon=settings)


def little_planet(scene):
    """A stereographic panorama looks down. The ground appears as a small planet, and the sky surrounds it beyond the
    horizon.
    """
    meadow(scene)
    settings = {"model": "STEREOGRAPHIC_PANORAMA", "fov": radians(250), "elevation": -pi / 2}
    photograph(scene, (0, 0, 3.4), (0, 6, 3.4), 400, 400, world="bcd7ea", addon=settings)


def omnidirectional_stereo(scene):
    """Each eye has its own panorama, with the left eye's on top. The eyes move on a circle, so the rays have no common
    center.
    """
    room(scene)
    settings = {"model": "OMNIDIRECTIONAL_STEREO", "eye": "TOP_BOTTOM"}
    made = photograph(scene, MIDDLE, AHEAD, 360, 360, addon=settings)
    made.data.stereo.interocular_distance = 0.3
