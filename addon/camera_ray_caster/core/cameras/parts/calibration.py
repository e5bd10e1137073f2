"""A calibrated lens: K and the distortion's coefficients. ``files`` reads them from calibration files.

K is in OpenCV's convention: y down, (0, 0) the center of the top left pixel, focal lengths in pixels of the calibrated
picture. A frame of another size is that picture scaled to it, each axis for itself: pixel coordinates grow in
proportion, measured from the corner of the frame. Blender's lens, sensor and shift do not count.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

from ...records import BlenderCamera, InputError, Raster
from .affine import AffineWindow
from .film import FARTHEST_PIXELS, Window
from .settings import FilePath, Number, Text, Whole

FOCAL = (
    Number("fx", "Focal Length X", "In pixels of the calibrated picture", 1500.0, 1e-3, unit="pixels", digits=3),
    Number("fy", "Y", "In pixels of the calibrated picture", 1500.0, 1e-3, unit="pixels", digits=3),
)
CENTER = (
    Number(
        "cx", "Center X", "From the center of the top left pixel, to the right", 959.5, -1e6, unit="pixels", digits=3
    ),
    Number("cy", "Y", "From the center of the top left pixel, down", 539.5, -1e6, unit="pixels", digits=3),
)
SIZE = (
    Whole("calibration_width", "Width", "Of the calibrated picture, pixels; 0 is the frame's", 1920, 0, unit="pixels"),
    Whole(
        "calibration_height", "Height", "Of the calibrated picture, pixels; 0 is the frame's", 1080, 0, unit="pixels"
    ),
)
FILE_CAMERA = Text("calibration_camera", "Camera in File", "Of a calibration file with several: its name there", "")
FILE = FilePath(
    "calibration_file",
    "Calibration",
    "As OpenCV, ROS, COLMAP, nerfstudio, Kalibr, mrcal or Project Aria write it; empty: the numbers below",
    "",
)
SKEW = Number(
    "skew", "Skew", "Of the camera matrix, its second number; in pixels of the calibrated picture", 0.0, unit="pixels",
    digits=3,
)  # fmt: skip
PRINCIPAL_POINT = (*SIZE, *CENTER)
MATRIX = (*SIZE, *FOCAL, *CENTER, SKEW)
CALIBRATION = (FILE_CAMERA, FILE, *MATRIX)
"""The settings of the calibrated picture: without a camera matrix, with one, and with a file. Where there is a file,
its numbers count.
"""


def _coefficient(name: str, text: str) -> Number:
    return Number(name, name.upper(), text, 0.0, digits=6, step=0.1)


Linear = tuple[tuple[float, float], tuple[float, float]]
"""A matrix, its rows."""

STEEPEST = radians(80)
"""Beyond which a tilted sensor is no picture to calibrate with."""

FLATTEST = 1e-6
"""Of a determinant over the square of the largest entry: less is no picture, and for float32 as good as 0.
"""

LARGEST = 1e30
"""Of a calibration's numbers: products of three of them have to be numbers, too."""

K1, K2, K3 = (_coefficient(name, "Radial") for name in ("k1", "k2", "k3"))
K4, K5, K6 = (_coefficient(name, "Radial: of a pinhole's denominator, or a fisheye's") for name in ("k4", "k5", "k6"))
P1, P2 = (_coefficient(name, "Tangential") for name in ("p1", "p2"))
S1, S2, S3, S4 = (_coefficient(name, "Thin prism") for name in ("s1", "s2", "s3", "s4"))
RADIAL_TANGENTIAL = K1, K2, P1, P2, K3, K4, K5, K6, S1, S2, S3, S4
TAU_X, TAU_Y = (
    Number(f"tau_{axis}", f"Tau {axis.upper()}", text, 0.0, -STEEPEST, STEEPEST, "angle", digits=4)
    for axis, text in (("x", "Of the sensor, about its x axis"), ("y", "Of the sensor, about its y axis"))
)
PINHOLE = (*RADIAL_TANGENTIAL, TAU_X, TAU_Y)
FISHEYE = K1, K2, K3, K4
"""The distortion, in the order of OpenCV's vector of coefficients; all without unit."""


@dataclass(frozen=True)
class Calibration:
    """K, the size of its picture, and the coefficients by name. Without focal lengths they are 1: pixels."""

    fx: float
    fy: float
    cx: float
    cy: float
    skew: float
    width: float
    height: float
    coefficients: dict[str, float]

    @classmethod
    def from_blender(
        cls, raw: BlenderCamera, raster: Raster, distortion: tuple[Number, ...] = (), settings=CALIBRATION
    ) -> Calibration:
        """Build it from those of the settings that it has; ``distortion``: the model's coefficients.

        Raises InputError for a setting without meaning, by its name.
        """
        values = {"fx": 1.0, "fy": 1.0, "skew": 0.0}
        values |= {setting.name: setting.read(raw) for setting in FOCAL if setting in settings}
        values |= {setting.name: setting.read(raw, high=FARTHEST_PIXELS) for setting in (*SIZE, *CENTER)}
        for setting in (SKEW, *distortion) if SKEW in settings else distortion:
            values[setting.name] = setting.read(raw, max(setting.low, -LARGEST), min(setting.high, LARGEST))
        return cls(
            **{setting.name: values[setting.name] for setting in (*FOCAL, *CENTER, SKEW)},
            width=values["calibration_width"] or raster.width,
            height=values["calibration_height"] or raster.height,
            coefficients={setting.name: values[setting.name] for setting in distortion},
        )

    def window(self, raster: Raster, linear: Linear | None = None) -> Window:
        """Return the window of (x, -y) of OpenCV's normalized, distorted image coordinates: y up.

        linear: what brings these to the calibrated picture's pixels from its center, K's if it is not given. Raises
        InputError where it brings them all to about one line.
        """
        scale_x, scale_y = raster.width / self.width, raster.height / self.height
        center = (self.cx + 0.5) * scale_x, (self.height - (self.cy + 0.5)) * scale_y
        (xx, xy), (yx, yy) = linear or ((self.fx, self.skew), (0.0, self.fy))
        volume, size = xx * yy - xy * yx, max(map(abs, (xx, xy, yx, yy)))
        if (linear or self.skew) and not abs(volume) > FLATTEST * size * size:
            raise InputError(
                f"the calibration's matrix, {xx:.6g}, {xy:.6g}; {yx:.6g}, {yy:.6g}, brings all directions to about one "
                "line of the picture: check skew and affine terms"
            )
        if xy == yx == 0:
            return Window(*center, 1 / (xx * scale_x), 1 / (yy * scale_y))
        pitch, shear = (yy / volume / scale_x, xx / volume / scale_y), (xy / volume / scale_y, yx / volume / scale_x)
        return AffineWindow(*center, *pitch, *shear)
