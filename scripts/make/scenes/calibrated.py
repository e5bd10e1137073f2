"""Calibrated lenses: each model with realistic calibration values."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from .lenses import AHEAD, CORNER, FRONT, MIDDLE
from .sets import photograph, room

SMALL = 312, 208
FOLDER = Path(__file__).parents[3] / "blend_scenes"


def opencv_pinhole(scene):
    """A calibrated lens has strong barrel distortion and a decentered axis. The distortion is inverted numerically,
    since its inverse has no formula.
    """
    room(scene)
    lens = {"model": "OPENCV_PINHOLE", **picture(448, 280, 210), "k1": -0.24, "k2": 0.045, "p1": 0.004, "p2": -0.006}
    photograph(scene, CORNER, AHEAD, 448, 280, addon=lens)


def opencv_fisheye(scene):
    """A calibrated fisheye (Kannala and Brandt) sees more than a hemisphere. There are no rays beyond the angle where
    its polynomial turns back.
    """
    room(scene)
    lens = {"model": "OPENCV_FISHEYE", **picture(448, 280, 110), "k1": 0.03, "k2": -0.022, "k3": 0.0008}
    photograph(scene, MIDDLE, FRONT, 448, 280, addon=lens)


def ucm(scene):
    """The unified camera model (Mei) describes a mirror lens. With xi = 1.3 it sees up to 140 degrees from the axis,
    including the balls at its sides.
    """
    calibrated(scene, 115, model="UCM", unified_xi=1.3, k1=-0.05, k2=0.02, p1=0.003, p2=-0.002)


def eucm(scene):
    """The enhanced unified camera model describes a fisheye by two parameters. Its inverse has a closed form."""
    calibrated(scene, 75, model="EUCM", unified_alpha=0.62, unified_beta=1.08)


def double_sphere(scene):
    """The double sphere model projects onto two spheres; the second is seen from behind. It sees as far as EUCM, with
    straighter lines in the middle.
    """
    calibrated(scene, 52, model="DOUBLE_SPHERE", unified_xi=-0.22, unified_alpha=0.57)


def fisheye624(scene):
    """A Project Aria fisheye has radial, tangential and thin prism distortion. The last two are stronger
    than in real lenses.
    """
    lens = {"k1": 0.4, "k2": -0.5, "k3": 0.25, "k4": 1.2, "k5": -1.7, "k6": 0.6, "p1": 0.004, "p2": -0.002}
    calibrated(scene, 95, model="FISHEYE624", **lens, s1=-0.006, s2=-0.002, s3=0.009, s4=0.0001)


def thin_prism_fisheye(scene):
    """The lens of an equidistant fisheye is not perpendicular to the optical axis. The thin prism distortion moves the
    rim to one side.
    """
    calibrated(scene, 65, model="THIN_PRISM_FISHEYE", k1=-0.02, p1=0.004, p2=0.006, s1=0.03, s3=-0.02)


def fov(scene):
    """The field-of-view model (Devernay and Faugeras) describes a wide-angle lens by a single angle. It reaches up to
    90 degrees from the axis.
    """
    calibrated(scene, 138, model="FOV", fov_omega=1.1)


def division(scene):
    """The division model describes a lens by one coefficient. If it is below 0, the lens can see more than 90 degrees
    from the axis.
    """
    calibrated(scene, 75, model="DIVISION", division_lambda=-0.28)


def radial_polynomial(scene):
    """The radial polynomial of Hugin and lensfun has odd powers, too. The waves of a mustache distortion bend lines
    outward in the middle and inward at the edge.
    """
    calibrated(scene, 150, model="RADIAL_POLYNOMIAL", radial_polynomial="0 1 0.1 -0.7 0.35")


def ftheta(scene):
    """In the f-theta model (NVIDIA), the angle is a polynomial of the radius. The sensor is not quite perpendicular to
    the lens.
    """
    lens = {"ftheta_reference": "RADIUS_TO_ANGLE", "ftheta_radius_to_angle": "0 0.0125 3e-6 -9e-8"}
    calibrated(scene, model="FTHETA", **lens, ftheta_c=1.01, ftheta_d=0.06, ftheta_e=-0.04)


def ocam(scene):
    """The OCam model (Scaramuzza) describes a mirror lens. A polynomial of the radius gives the component of each ray
    along the axis.
    """
    calibrated(scene, model="OCAM", ocam_polynomial="-68 0 0.0045 1e-6 2.5e-8", ocam_c=0.999, ocam_d=0.002)


def ray_table(scene):
    """A table of 52 × 52 rays stands for a camera that looks into a ball of chrome, and sees the room behind it. The
    rays start on the ball, so that there is no eye. Between the rays of the table there is a cubic spline.
    """
    room(scene)
    np.savez_compressed(FOLDER / "ray_table.npz", **ball_mirror(52))
    lens = {"model": "RAY_TABLE", "calibration_file": "//ray_table.npz"}
    photograph(scene, (0, 0.5, 2.4), (0, -6, 2.4), 208, 208, addon=lens)


def ball_mirror(side: int, radius: float = 0.6, away: float = 3.0, largest: float = 0.9) -> dict[str, np.ndarray]:
    """Return origins and directions (side, side, 3) of the rays of a camera behind a ball, after their reflection.

    The camera is ``away`` behind its own eye, the middle of the ball, and looks at it; the rim of the picture is at
    ``largest`` of the ball's. NaN beyond it.
    """
    position = (2 * np.arange(side) + 1) / side - 1
    x, y = np.meshgrid(position, position)
    slope = largest * radius / np.sqrt(away * away - radius * radius)
    seen = np.stack((slope * x, slope * y, -np.ones_like(x)), axis=-1)
    seen /= np.linalg.norm(seen, axis=-1, keepdims=True)
    eye = np.array((0.0, 0.0, away))
    along = seen @ eye
    outside = x * x + y * y > 1
    depth = -along - np.sqrt(np.where(outside, np.nan, along * along - away * away + radius * radius))
    origins = eye + depth[..., None] * seen
    normal = origins / radius
    directions = seen - 2 * (seen * normal).sum(axis=-1, keepdims=True) * normal
    turned = np.array((-1, 1, -1))  # the frame looks where the ball's middle reflects to, and is not mirrored
    return {"origins": np.float32(origins * turned), "directions": np.float32(directions * turned)}


def calibrated(scene, focal: float = 1.0, **settings):
    """Photograph the room through a lens with this focal length, in pixels of a small picture."""
    room(scene)
    photograph(scene, MIDDLE, FRONT, *SMALL, addon=picture(*SMALL, focal) | settings)


def picture(width: int, height: int, focal: float) -> dict[str, float]:
    """Return the settings of a calibrated picture of this size, centered, with the focal length in pixels."""
    center = {"cx": (width - 1) / 2, "cy": (height - 1) / 2}
    return {"calibration_width": width, "calibration_height": height, "fx": focal, "fy": focal, **center}
