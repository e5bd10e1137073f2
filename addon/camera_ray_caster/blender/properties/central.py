"""The settings of the cameras with one eye that Blender does not have: what a .blend stores of them."""

from math import pi, radians

from .tagged import FloatProperty, IntProperty, StringProperty


def _angle(name: str, description: str, default: float, low: float, high: float):
    return FloatProperty(
        name=name, description=description, default=default, min=low, max=high, subtype="ANGLE", precision=4, step=100
    )


def _coefficient(name: str, description: str):
    return FloatProperty(name=name, description=description, default=0.0, precision=6, step=0.1)


def _pixels(name: str, description: str, default: float, low: float = -1e6):
    return FloatProperty(name=name, description=description, default=default, min=low, precision=3)


class CentralProperties:
    """A part of ``camera.camera_ray_caster``. See core/cameras/calibration.py for its numbers."""

    fov: _angle("Field of View", "From rim to rim of the picture", pi, radians(1), 2 * pi)
    tilt: _angle("Dome Tilt", "How far the dome is tipped towards the front", 0.0, 0.0, pi / 2)
    elevation: _angle(
        "Elevation", "Of the picture's center: -90 degrees is the ground, a little planet", -pi / 2, -pi / 2, pi / 2
    )
    pan_min: _angle("Pan Min", "Longitude of the picture's left edge, 0 is ahead", -pi, -10 * pi, 10 * pi)
    pan_max: _angle("Max", "Longitude of the picture's right edge, 0 is ahead", pi, -10 * pi, 10 * pi)
    latitude_bottom: _angle("Latitude Bottom", "Of the picture's lower edge", -pi / 4, -radians(89), radians(89))
    latitude_top: _angle("Top", "Of the picture's upper edge", pi / 4, -radians(89), radians(89))
    calibration_file: StringProperty(
        name="Calibration", subtype="FILE_PATH", options={"PATH_SUPPORTS_BLEND_RELATIVE"},
        description="YAML or JSON as OpenCV writes it, with all its digits; empty: the numbers below",
    )  # fmt: skip
    calibration_width: IntProperty(
        name="Width", description="Of the calibrated picture, pixels; 0 is the frame's", default=1920, min=0
    )
    calibration_height: IntProperty(
        name="Height", description="Of the calibrated picture, pixels; 0 is the frame's", default=1080, min=0
    )
    fx: _pixels("Focal Length X", "In pixels of the calibrated picture", 1500.0, 1e-3)
    fy: _pixels("Y", "In pixels of the calibrated picture", 1500.0, 1e-3)
    cx: _pixels("Center X", "From the center of the top left pixel, to the right", 959.5)
    cy: _pixels("Y", "From the center of the top left pixel, down", 539.5)
    k1: _coefficient("K1", "Radial")
    k2: _coefficient("K2", "Radial")
    k3: _coefficient("K3", "Radial")
    k4: _coefficient("K4", "Radial: of the denominator, or the fisheye's last")
    k5: _coefficient("K5", "Radial, of the denominator")
    k6: _coefficient("K6", "Radial, of the denominator")
    p1: _coefficient("P1", "Tangential")
    p2: _coefficient("P2", "Tangential")
    s1: _coefficient("S1", "Thin prism")
    s2: _coefficient("S2", "Thin prism")
    s3: _coefficient("S3", "Thin prism")
    s4: _coefficient("S4", "Thin prism")


MODELS = (
    ("FISHEYE_ORTHOGRAPHIC", "Fisheye Orthographic", "The half sphere ahead, as seen from far away"),
    ("FISHEYE_STEREOGRAPHIC", "Fisheye Stereographic", "Keeps angles: circles stay circles"),
    ("OPENCV_PINHOLE", "OpenCV Pinhole", "A calibrated lens: radial, tangential and thin prism distortion"),
    ("OPENCV_FISHEYE", "OpenCV Fisheye", "A calibrated fisheye, by Kannala and Brandt"),
    ("OMNIMAX", "Omnimax", "The film of IMAX domes"),
    ("DOME_MASTER", "Dome Master", "A planetarium's picture: the zenith in the middle, the front at the bottom"),
    ("CYLINDRICAL", "Panorama Cylindrical", "Over chosen angles; vertical lines and the horizon stay straight"),
    ("STEREOGRAPHIC_PANORAMA", "Panorama Stereographic", "All around; looking down, a little planet"),
)
"""Items of ``model``."""

COPIED = tuple(name for name in CentralProperties.__annotations__ if name != "calibration_file")
"""What a record takes over as it is; of the file it takes the absolute path."""
