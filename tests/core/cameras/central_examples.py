"""Examples of the central models that Blender does not have: see model_examples, which takes them in."""

from math import pi, sqrt

from . import calibrated_examples
from .example_frames import BORDER, PORTRAIT, SHIFTED, TURNED

ONLY_SOME = {
    **calibrated_examples.ONLY_SOME,
    "fov": pi, "tilt": 0.0, "elevation": -pi / 2,
    "pan_min": -pi, "pan_max": pi, "latitude_bottom": -pi / 4, "latitude_top": pi / 4,
    "fx": 60.0, "fy": 61.0, "cx": 47.5, "cy": 26.5, "calibration_width": 0, "calibration_height": 0,
    **dict.fromkeys(("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"), 0.0),
}  # fmt: skip

EXAMPLES = {
    **calibrated_examples.EXAMPLES,
    "FISHEYE_ORTHOGRAPHIC": [{}, SHIFTED, PORTRAIT | {"fov": 2.0}, BORDER | {"pixel_aspect_y": 2.0}],
    "FISHEYE_STEREOGRAPHIC": [{}, SHIFTED, PORTRAIT | {"fov": 6.0}, BORDER | {"pixel_aspect_y": 2.0}],
    "OPENCV_PINHOLE": [
        {},
        BORDER | {"cx": 30.0, "k1": -0.1, "k2": 0.05, "p1": 1e-3, "p2": -2e-3},
        {"matrix_world": TURNED, "k1": 0.3, "k4": 0.5, "k5": 0.1, "k6": -0.01, "s1": 1e-3, "s4": -2e-3},
        {"k1": -0.3, "resolution_percentage": 37, "calibration_width": 96, "calibration_height": 54},
        {"matrix_world": TURNED, "tau_x": 0.3, "tau_y": -0.2, "skew": -2.0},
        {"tau_x": -0.1, "tau_y": 0.4, "k1": -0.1, "p2": 2e-3, "fx": 90.0},
    ],
    "OPENCV_FISHEYE": [
        {"fx": 20.0, "fy": 20.0},
        BORDER | {"cx": 30.0, "k1": -0.1, "k2": 0.05},
        {"matrix_world": TURNED, "fx": 15.0, "fy": 16.0, "k1": 0.05, "k2": 0.01, "k3": -0.003, "k4": -1e-4},
        {"fx": 30.0, "k1": -0.02, "resolution_percentage": 37, "calibration_width": 96, "calibration_height": 54},
    ],
    "OMNIMAX": [{}, SHIFTED | {"tilt": 0.4}, PORTRAIT, BORDER | {"resolution_x": 72}],
    "DOME_MASTER": [{"resolution_x": 54}, SHIFTED | {"tilt": 0.4}, PORTRAIT | {"fov": 4.0}, BORDER],
    "CYLINDRICAL": [{}, SHIFTED, BORDER, {"pan_min": 0.5, "latitude_top": 1.4, "shift_y": 0.4}],
    "STEREOGRAPHIC_PANORAMA": [{"fov": 5.0}, SHIFTED | {"elevation": pi / 2}, PORTRAIT | {"elevation": 0.3}, BORDER],
}

FACTS = {
    **calibrated_examples.FACTS,
    "FISHEYE_ORTHOGRAPHIC": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (48 + 27 / 2, 27), (0, 0, 0), (1, 0, -sqrt(3))),  # half the radius: 30 degrees
        ({"fov": 2 * pi / 3}, (48, 0), (0, 0, 0), (0, -sqrt(3), -1)),
    ],
    "FISHEYE_STEREOGRAPHIC": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (48 + 27 / sqrt(3), 27), (0, 0, 0), (sqrt(3), 0, -1)),  # tan 30 degrees: 60
        ({"fov": 4 * pi / 3}, (21, 27), (0, 0, 0), (-sqrt(3), 0, 1)),
    ],
    "OPENCV_PINHOLE": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),  # (47.5, 26.5) from the top left pixel's center is the frame's middle
        ({"fx": 48.0}, (96, 27), (0, 0, 0), (1, 0, -1)),
        ({"fx": 48.0, "fy": 27.0, "skew": 12.0}, (84, 54), (0, 0, 0), (1, 1, -1)),
        # a sensor turned by 60 degrees about y has x at x / (sin(60) x + cos(60)): at x = 1 / sqrt(3) it is the same
        ({"fx": 48.0, "tau_y": pi / 3}, (48 + 48 / sqrt(3), 27), (0, 0, 0), (1, 0, -sqrt(3))),
        ({"fx": 48.0, "tau_y": pi / 3}, (48 + 48 / (sqrt(3) + 1) * 2, 27), (0, 0, 0), (1, 0, -1)),
        ({"cy": 10.0, "fy": 5.0}, (48, 54 - 15.5), (0, 0, 0), (0, -1, -1)),
        # x (1 + k1 x^2) with x = k1 = 1/2: a pincushion drives it out
        ({"fx": 48.0, "k1": 0.5}, (48 + 48 * 9 / 16, 27), (0, 0, 0), (1 / 2, 0, -1)),
        # calibrated at twice the size: its middle is still the middle
        ({"cx": 95.5, "calibration_width": 192}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"cy": 53.5, "calibration_height": 108}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 96.0, "cx": 95.5, "calibration_width": 192}, (96, 27), (0, 0, 0), (1, 0, -1)),
    ],
    "OPENCV_FISHEYE": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 96 / pi}, (96, 27), (0, 0, 0), (1, 0, 0)),
        ({"fy": 54 / pi * 2}, (48, 54), (0, 0, 0), (0, 1, -1)),
    ],
    "OMNIMAX": [
        ({"resolution_x": 54}, (27, 27), (0, 0, 0), (0, 0, -1)),
        ({"resolution_x": 54, "tilt": pi / 6}, (27, 27), (0, 0, 0), (0, 1, -sqrt(3))),
    ],
    "DOME_MASTER": [
        ({}, (48, 27), (0, 0, 0), (0, 1, 0)),
        ({}, (48, 0), (0, 0, 0), (0, 0, -1)),  # the front is at the bottom
        ({}, (75, 27), (0, 0, 0), (1, 0, 0)),  # the right at the right, as one who lies on the back sees it
        ({"tilt": pi / 6}, (48, 27), (0, 0, 0), (0, sqrt(3), -1)),
    ],
    "CYLINDRICAL": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (72, 27), (0, 0, 0), (1, 0, 0)),
        ({}, (48, 54), (0, 0, 0), (0, 1, -1)),
        ({"latitude_top": pi / 3, "latitude_bottom": 0.0}, (48, 27), (0, 0, 0), (0, sqrt(3) / 2, -1)),
    ],
    "STEREOGRAPHIC_PANORAMA": [
        ({}, (48, 27), (0, 0, 0), (0, -1, 0)),  # the ground
        ({}, (48, 54), (0, 0, 0), (0, 0, -1)),  # the front is on top, at half of 180 degrees
        ({"fov": 4 * pi / 3}, (75, 27), (0, 0, 0), (sqrt(3), 1, 0)),
        ({"elevation": 0.0}, (21, 27), (0, 0, 0), (-1, 0, 0)),
    ],
}

UNSEEN = {
    **calibrated_examples.UNSEEN,
    "FISHEYE_ORTHOGRAPHIC": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1), (1, 0, 2)],
    "FISHEYE_STEREOGRAPHIC": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "OPENCV_PINHOLE": [(0, 0, 0), (1, 2, 0), (0, 0, 1), (3, -1, 5)],
    "OPENCV_FISHEYE": [(0, 0, 0), (0, 0, 1)],
    "OMNIMAX": [(0, 0, 0), (0, 0, 1), (1, 0, 1), (0, -2, -1)],
    "DOME_MASTER": [(0, 0, 0), (0, -1, 0), (0, -0.1, -1)],
    "CYLINDRICAL": [(0, 0, 0), (0, 1, 0), (0, -2, 0)],
    "STEREOGRAPHIC_PANORAMA": [(0, 0, 0)],
}

REFUSED = {
    **calibrated_examples.REFUSED,
    "FISHEYE_ORTHOGRAPHIC": [({"fov": 0.0}, "fov"), ({"fov": 3.2}, "fov")],
    "FISHEYE_STEREOGRAPHIC": [({"fov": 0.0}, "fov"), ({"fov": 2 * pi}, "fov")],
    "OPENCV_PINHOLE": [
        ({"fx": 0.0}, "fx"),
        ({"cy": float("nan")}, "cy"),
        ({"calibration_width": -1}, "calibration_width"),
        ({"tau_x": 1.5}, "tau_x .* from -80 degrees"),
        ({"skew": float("nan")}, "skew"),
    ],
    "OPENCV_FISHEYE": [({"fy": -1.0}, "fy"), ({"k4": float("inf")}, "k4")],
    "OMNIMAX": [({"tilt": -0.1}, "tilt"), ({"tilt": 2.0}, "tilt")],
    "DOME_MASTER": [({"fov": 0.0}, "fov"), ({"tilt": 2.0}, "tilt")],
    "CYLINDRICAL": [({"pan_min": pi}, "pan_max"), ({"latitude_top": pi / 2}, "latitude_top")],
    "STEREOGRAPHIC_PANORAMA": [({"fov": 2 * pi}, "fov"), ({"elevation": 2.0}, "elevation")],
}
