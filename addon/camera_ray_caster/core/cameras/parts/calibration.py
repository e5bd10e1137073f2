"""A calibrated lens: K and the distortion's coefficients. ``files`` reads them from calibration files.

In pixels, K is in OpenCV's convention: y down, (0, 0) the center of the top left pixel, focal lengths in pixels of the
calibrated picture. A frame of another size is that picture scaled to the frame on each axis: pixel coordinates,
measured from the corner of the frame, grow in proportion. Blender's lens, sensor and shift are ignored.
In millimeters, Blender's lens, sensor and shift take the place of K: the lens on any sensor, at any resolution.
Polynomials of a radius are in the same unit. The distortion's coefficients have no unit.
Reference: OpenCV documentation, Camera Calibration and 3D Reconstruction; Fisheye camera model.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians

from ...maths.recording.scalars import largest
from ...records import BlenderCamera, InputError, Raster
from .affine_window import AffineWindow
from .film import FARTHEST_PIXELS, FILM, LENS, OFF_AXIS, Film, Window
from .left_out import MIDDLE, OF_FRAME, SAME
from .settings import Choice, FilePath, Item, Number, Text, Whole

MILLIMETERS = "MILLIMETERS"
UNIT = Choice(
    "calibration_unit", "Lengths In", "Unit of the focal lengths, the center and polynomials of a radius",
    "PIXELS",
    (
        Item("PIXELS", "Pixels", "Pixels of the calibrated picture, which is scaled to the frame", 0),
        Item(MILLIMETERS, "Millimeters", "Millimeters on the sensor: Blender's focal length, sensor and shift "
                                         "are used", 1),
    ),
)  # fmt: skip
IN_PICTURE: tuple[tuple[str, str], ...] = (("calibration_unit", "PIXELS"),)
FOCAL = tuple(
    Number(
        name, label, "In pixels of the calibrated picture", 1500.0, 1e-3, unit="pixels", digits=3, partner=other,
        left_out=SAME, used_with=IN_PICTURE,
    )
    for name, label, other in (("fx", "Focal Length X", "fy"), ("fy", "Y", "fx"))
)  # fmt: skip
CENTER = tuple(
    Number(
        name, label, f"Distance of the center from the center of the top left pixel, {way}", default, -1e6,
        unit="pixels", digits=3, left_out=MIDDLE, used_with=IN_PICTURE,
    )
    for name, label, way, default in (("cx", "Center X", "to the right", 959.5), ("cy", "Y", "down", 539.5))
)  # fmt: skip
SIZE = tuple(
    Whole(
        f"calibration_{side}", side.title(), "Of the calibrated picture, pixels; 0 is the frame's", default, 0,
        unit="pixels", partner=f"calibration_{other}", left_out=OF_FRAME, used_with=IN_PICTURE,
    )
    for side, default, other in (("width", 1920, "height"), ("height", 1080, "width"))
)  # fmt: skip
FILE = FilePath(
    "calibration_file", "Calibration", "Calibration file of another program. If empty, the numbers below are used", ""
)
FILE_CAMERA = Text(
    "calibration_camera", "Camera in File", "Name of the camera in a calibration file that has several cameras", ""
)
FROM_FILE = (FILE, FILE_CAMERA)
SKEW = Number(
    "skew", "Skew", "Entry in row 1, column 2 of the camera matrix, in pixels of the calibrated "
                    "picture", 0.0, unit="pixels",
    digits=3, used_with=IN_PICTURE,
)  # fmt: skip
IN_PIXELS = (*SIZE, *FOCAL, *CENTER, SKEW)
PRINCIPAL_POINT = (*FROM_FILE, UNIT, *SIZE, *CENTER, *FILM)
CALIBRATION = (*FROM_FILE, UNIT, *IN_PIXELS, LENS, *FILM)
"""The settings of a model without a camera matrix, and of one with it: of the calibrated picture, or of the lens and
its sensor. If a file is given, its numbers, in pixels, take their place.
"""


def _coefficient(name: str, text: str) -> Number:
    return Number(name, name.upper(), text, 0.0, digits=6, step=0.1)


Linear = tuple[tuple[float, float], tuple[float, float]]
"""The rows of a 2 x 2 matrix."""

STEEPEST = radians(80)
"""Largest tilt of a sensor that still gives a picture to calibrate with."""

FLATTEST = 1e-6
"""Smallest determinant of a matrix over the square of its largest entry. A smaller one gives no useful picture, and is
almost 0 in float32.
"""

LARGEST = 1e30
"""Largest magnitude of a calibration's numbers: the product of three of them must be finite, too."""

K1, K2, K3 = (_coefficient(name, "Radial distortion coefficient") for name in ("k1", "k2", "k3"))
K4, K5, K6 = (
    _coefficient(name, "Radial distortion coefficient; in the denominator of pinhole models")
    for name in ("k4", "k5", "k6")
)
P1, P2 = (_coefficient(name, "Tangential distortion coefficient") for name in ("p1", "p2"))
S1, S2, S3, S4 = (_coefficient(name, "Thin prism distortion coefficient") for name in ("s1", "s2", "s3", "s4"))
RADIAL_TANGENTIAL = K1, K2, P1, P2, K3, K4, K5, K6, S1, S2, S3, S4
TAU_X, TAU_Y = (
    Number(f"tau_{axis}", f"Sensor Tilt {axis.upper()}", text, 0.0, -STEEPEST, STEEPEST, "angle", digits=4)
    for axis, text in (("x", "Tilt of the sensor about its X axis"), ("y", "Tilt of the sensor about its Y axis"))
)
PINHOLE = (*RADIAL_TANGENTIAL, TAU_X, TAU_Y)
FISHEYE = K1, K2, K3, K4
"""Distortion coefficients, here and above in the order of OpenCV's vector; they have no unit."""


@dataclass(frozen=True)
class Calibration:
    """K, the place of the calibrated picture in the frame, and the coefficients by name; fx = fy = 1 without K."""

    fx: float
    fy: float
    skew: float
    center: tuple[float, float]
    """Pixel coordinates of the principal point in the frame, y up."""
    scale: tuple[float, float]
    """Pixels of the frame per pixel of the calibrated picture, or per millimeter of the sensor, along x and y."""
    coefficients: dict[str, float]

    @classmethod
    def from_blender(
        cls, raw: BlenderCamera, raster: Raster, distortion: tuple[Number, ...] = (), settings=CALIBRATION
    ) -> Calibration:
        """Build the calibration from a model's ``settings`` and ``distortion``, its coefficients. Raises InputError."""
        coefficients = {setting.name: _within_largest(setting, raw) for setting in distortion}
        fx = fy = 1.0
        skew = 0.0
        if UNIT.read(raw) == MILLIMETERS:
            sensor = Window.from_blender(raw, raster, Film.from_blender(raw, raster).size)
            center, scale = (sensor.center_x, sensor.center_y), (1 / sensor.pitch_x, 1 / sensor.pitch_y)
            if LENS in settings:
                fx = fy = LENS.read(raw)
        else:
            *sides, cx, cy = (setting.read(raw, high=FARTHEST_PIXELS) for setting in (*SIZE, *CENTER))
            width, height = (side if side > 0 else of_frame for side, of_frame in zip(sides, raster.size, strict=True))
            scale = raster.width / width, raster.height / height
            center = (cx + 0.5) * scale[0], (height - (cy + 0.5)) * scale[1]
            if SKEW in settings:
                (fx, fy), skew = (setting.read(raw) for setting in FOCAL), _within_largest(SKEW, raw)
        center = center[0] - raw.settings.get(OFF_AXIS, 0.0) * fx * scale[0], center[1]
        return cls(fx, fy, skew, center, scale, coefficients)

    def window(self, linear: Linear | None = None) -> Window:
        """Return the window of (x, -y), with (x, y) OpenCV's normalized, distorted image coordinates: y up.

        linear: the matrix from (x, y) to pixels of the calibrated picture, or millimeters, from its center; by default
        K's. Raises InputError if it maps all points almost onto one line.
        """
        scale_x, scale_y = self.scale
        (xx, xy), (yx, yy) = linear or ((self.fx, self.skew), (0.0, self.fy))
        volume, size = xx * yy - xy * yx, largest(*map(abs, (xx, xy, yx, yy)))
        if (linear or self.skew) and not abs(volume) > FLATTEST * size * size:
            raise InputError(
                f"the calibration's matrix, {xx:.6g}, {xy:.6g}; {yx:.6g}, {yy:.6g}, maps all directions to nearly one "
                "line of the picture: check skew and affine terms"
            )
        if not (xy or yx):
            return Window(*self.center, 1 / (xx * scale_x), 1 / (yy * scale_y))
        pitch, shear = (yy / volume / scale_x, xx / volume / scale_y), (xy / volume / scale_y, yx / volume / scale_x)
        return AffineWindow(*self.center, *pitch, *shear)


def _within_largest(setting: Number, raw: BlenderCamera) -> float:
    return setting.read(raw, max(setting.low, -LARGEST), min(setting.high, LARGEST))
