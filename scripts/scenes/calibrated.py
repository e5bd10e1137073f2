"""Calibrated lenses: each family with numbers such as a calibration gives."""

from __future__ import annotations

from .lenses import AHEAD, CORNER, FRONT, MIDDLE
from .sets import photograph, room

SMALL = 312, 208


def opencv_pinhole(scene):
    """a calibrated lens with strong barrel distortion and a decentered axis: inverted without a formula."""
    room(scene)
    own = {"model": "OPENCV_PINHOLE", **picture(448, 280, 210), "k1": -0.24, "k2": 0.045, "p1": 0.004, "p2": -0.006}
    photograph(scene, CORNER, AHEAD, 448, 280, own=own)


def opencv_fisheye(scene):
    """a calibrated fisheye (Kannala and Brandt): wider than a half sphere, no ray where its polynomial turns back."""
    room(scene)
    own = {"model": "OPENCV_FISHEYE", **picture(448, 280, 110), "k1": 0.03, "k2": -0.022, "k3": 0.0008}
    photograph(scene, MIDDLE, FRONT, 448, 280, own=own)


def ucm(scene):
    """a mirror lens (Mei): with xi = 1.3 it sees up to 140 degrees from the axis, the balls beside the camera, too."""
    calibrated(scene, 115, model="UCM", unified_xi=1.3, k1=-0.05, k2=0.02, p1=0.003, p2=-0.002)


def eucm(scene):
    """the enhanced unified camera: two numbers for a fisheye, and a way back in closed form."""
    calibrated(scene, 75, model="EUCM", unified_alpha=0.62, unified_beta=1.08)


def double_sphere(scene):
    """two spheres, of which the second is seen from behind: as wide, with straighter lines in the middle."""
    calibrated(scene, 52, model="DOUBLE_SPHERE", unified_xi=-0.22, unified_alpha=0.57)


def fisheye624(scene):
    """a fisheye of Project Aria, with its radial terms, and tangential and thin prism ones ten times as strong."""
    own = {"k1": 0.4, "k2": -0.5, "k3": 0.25, "k4": 1.2, "k5": -1.7, "k6": 0.6, "p1": 0.004, "p2": -0.002}
    calibrated(scene, 95, model="FISHEYE624", **own, s1=-0.006, s2=-0.002, s3=0.009, s4=0.0001)


def thin_prism_fisheye(scene):
    """an equidistant fisheye behind a lens that is not square to it: the thin prism moves the rim to one side."""
    calibrated(scene, 65, model="THIN_PRISM_FISHEYE", k1=-0.02, p1=0.004, p2=0.006, s1=0.03, s3=-0.02)


def fov(scene):
    """the field-of-view camera (Devernay and Faugeras): one angle for a wide lens, up to 90 degrees from the axis."""
    calibrated(scene, 138, model="FOV", fov_omega=1.1)


def division(scene):
    """the division model: one number, and below 0 it goes on behind the camera's sides."""
    calibrated(scene, 75, model="DIVISION", division_lambda=-0.28)


def ftheta(scene):
    """f-theta (NVIDIA): the angle is a polynomial of the radius, on a sensor that is not quite square to the lens."""
    own = {"ftheta_reference": "RADIUS_TO_ANGLE", "ftheta_radius_to_angle": "0 0.0125 3e-6 -9e-8"}
    calibrated(scene, model="FTHETA", **own, ftheta_c=1.01, ftheta_d=0.06, ftheta_e=-0.04)


def ocam(scene):
    """OCam (Scaramuzza) of a mirror lens: a polynomial says how far behind the picture a ray's point lies."""
    calibrated(scene, model="OCAM", ocam_polynomial="-68 0 0.0045 1e-6 2.5e-8", ocam_c=0.999, ocam_d=0.002)


def calibrated(scene, focal: float = 1.0, **own):
    """Show the room all around the axis through a lens with this focal length, in pixels of a small picture."""
    room(scene)
    photograph(scene, MIDDLE, FRONT, *SMALL, own=picture(*SMALL, focal) | own)


def picture(width: int, height: int, focal: float) -> dict[str, float]:
    """Return the settings of a calibrated picture of this size with its axis in the middle; focal in pixels."""
    center = {"cx": (width - 1) / 2, "cy": (height - 1) / 2}
    return {"calibration_width": width, "calibration_height": height, "fx": focal, "fy": focal, **center}
