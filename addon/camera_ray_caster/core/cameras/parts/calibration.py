"""A calibrated lens: K and the distortion's coefficients. ``files`` reads them from calibration files.

In pixels, K is in OpenCV's convention: y down, (0, 0) the center of the top left pixel, focal lengths in pixels of the
calibrated picture. A frame of another size is that picture scaled to it, each axis for itself: pixel coordinates grow
in proportion, measured from the corner of the frame. Blender's lens, sensor and shift do not count.
In millimeters, Blender's lens, sensor and shift take the place of K: the lens on any sensor, at any resolution.
Polynomials of a radius are in the same unit; the distortion's coefficients have none.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

from ...records import BlenderCamera, InputError, Raster
from .affine import AffineWindow
from .film import FARTHEST_PIXELS, FILM, LENS, Film, Window
from .settings import Choice, FilePath, Item, Number, Text, Whole

MILLIMETERS = "MILLIMETERS"
UNIT = Choice(
    "calibration_unit", "Lengths In", "What focal lengths, the center and polynomials of a radius are measured in",
    "PIXELS",
    (
        Item("PIXELS", "Pixels", "Of the calibrated picture, which is scaled to the frame", 0),
        Item(MILLIMETERS, "Millimeters", "On the sensor: Blender's focal length, sensor and shift count", 1),
    ),
)  # fmt: skip
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
FILE_WRITERS = "OpenCV, ROS, COLMAP, nerfstudio, Kalibr, mrcal, Project Aria, NVIDIA (f-theta) or OCamCalib"
FILE = FilePath("calibration_file", "Calibration", f"A file of {FILE_WRITERS}; empty: the numbers below", "")
SKEW = Number(
    "skew", "Skew", "Of the camera matrix, its second number; in pixels of the calibrated picture", 0.0, unit="pixels",
    digits=3,
)  # fmt: skip
IN_PIXELS = (*SIZE, *FOCAL, *CENTER, SKEW)
PRINCIPAL_POINT = (FILE_CAMERA, FILE, UNIT, *SIZE, *CENTER, *FILM)
CALIBRATION = (FILE_CAMERA, FILE, UNIT, *IN_PIXELS, LENS, *FILM)
"""The settings of the calibrated picture, or of the lens and its sensor: without a camera matrix, and with one. Where
there is a file, its numbers count, in pixels.
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
    """K, where its picture lies in the frame, and the coefficients by name. Without focal lengths they are 1."""

    fx: float
    fy: float
    skew: float
    center: tuple[float, float]
    """Pixel coordinates in the frame, y up."""
    scale: tuple[float, float]
    """Pixels of the frame in a pixel of the calibrated picture, or in a millimeter of the sensor, along x and y."""
    coefficients: dict[str, float]

    @classmethod
    def from_blender(
        cls, raw: BlenderCamera, raster: Raster, distortion: tuple[Number, ...] = (), settings=CALIBRATION
    ) -> Calibration:
        """Build it from those of the settings that it has; ``distortion``: the model's coefficients.

        Raises InputError for a setting without meaning, by its name.
        """
        coefficients = {setting.name: _within_largest(setting, raw) for setting in distortion}
        fx = fy = 1.0
        skew = 0.0
        if UNIT.read(raw) == MILLIMETERS:
            sensor = Window.from_blender(raw, raster, Film.from_blender(raw, raster).size)
            center, scale = (sensor.center_x, sensor.center_y), (1 / sensor.pitch_x, 1 / sensor.pitch_y)
            if LENS in settings:
                fx = fy = LENS.read(raw)
        else:
            width, height, cx, cy = (setting.read(raw, high=FARTHEST_PIXELS) for setting in (*SIZE, *CENTER))
            width, height = width or raster.width, height or raster.height
            scale = raster.width / width, raster.height / height
            center = (cx + 0.5) * scale[0], (height - (cy + 0.5)) * scale[1]
            if SKEW in settings:
                (fx, fy), skew = (setting.read(raw) for setting in FOCAL), _within_largest(SKEW, raw)
        return cls(fx, fy, skew, center, scale, coefficients)

    def window(self, linear: Linear | None = None) -> Window:
        """Return the window of (x, -y) of OpenCV's normalized, distorted image coordinates: y up.

        linear: what brings these to pixels of the calibrated picture, or millimeters, from its center; K's if it is not
        given. Raises InputError where it brings them all to about one line.
        """
        scale_x, scale_y = self.scale
        (xx, xy), (yx, yy) = linear or ((self.fx, self.skew), (0.0, self.fy))
        volume, size = xx * yy - xy * yx, max(map(abs, (xx, xy, yx, yy)))
        if (linear or self.skew) and not abs(volume) > FLATTEST * size * size:
            raise InputError(
                f"the calibration's matrix, {xx:.6g}, {xy:.6g}; {yx:.6g}, {yy:.6g}, brings all directions to about one "
                "line of the picture: check skew and affine terms"
            )
        if xy == yx == 0:
            return Window(*self.center, 1 / (xx * scale_x), 1 / (yy * scale_y))
        pitch, shear = (yy / volume / scale_x, xx / volume / scale_y), (xy / volume / scale_y, yx / volume / scale_x)
        return AffineWindow(*self.center, *pitch, *shear)


def _within_largest(setting: Number, raw: BlenderCamera) -> float:
    return setting.read(raw, max(setting.low, -LARGEST), min(setting.high, LARGEST))
