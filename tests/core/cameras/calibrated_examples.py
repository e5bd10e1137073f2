"""Examples of the calibrated families beside OpenCV's two: see model_examples, which takes them in."""

from math import cos, pi, sin, sqrt

from .example_frames import BORDER, TURNED

SCALED = {"resolution_percentage": 37, "calibration_width": 96, "calibration_height": 54}
NAN = float("nan")

ARIA = {
    "k1": 0.4, "k2": -0.5, "k3": 0.25, "k4": 1.2, "k5": -1.7, "k6": 0.6, "p1": 4e-4, "p2": -2e-4,
    "s1": -6e-4, "s2": -2e-4, "s3": 9e-4, "s4": 1e-5,
}  # fmt: skip
"""Of the size that its cameras have."""
HALF_A_RADIAN_UP = 0, sin(0.5), -cos(0.5)
UP_A_HALF = 48 + 24 * 0.1 * 0.25, 27 + 24 * (0.5 - 0.15 * 0.25)

ON_SENSOR = {"calibration_unit": "MILLIMETERS", "lens": 14.0, "sensor_width": 24.0, "shift_x": 0.1}
TWICE_AS_WIDE = {"cx": 95.5, "calibration_width": 192}
LINEAR = {"ftheta_c": 1.05, "ftheta_d": 0.1, "ftheta_e": -0.2}
BACKWARD = {"ftheta_reference": "RADIUS_TO_ANGLE"}
QUARTER = BACKWARD | {"ftheta_radius_to_angle": f"[0, {pi / (54 * sqrt(2))!r}]"}
"""90 degrees at 27 pixels to the right and up."""

HOLE = {"ocam_polynomial": "-48"}
"""A constant alone is a pinhole."""

ONLY_SOME = {
    "unified_xi": 0.0, "unified_alpha": 0.5, "unified_beta": 1.0,
    "ftheta_angle_to_radius": "0 30", "ftheta_radius_to_angle": "0 0.03", "ocam_polynomial": "-48",
}  # fmt: skip

EXAMPLES = {
    "UCM": [
        {"fx": 40.0, "unified_xi": 0.7},
        BORDER | {"cx": 30.0, "unified_xi": 1.0, "k1": -0.02, "k2": 3e-3, "p1": 1e-3, "p2": -2e-3},
        {"matrix_world": TURNED, "fx": 90.0, "fy": 80.0, "unified_xi": 1.7, "k1": -0.1, "skew": 3.0},
        SCALED | {"unified_xi": 2.5, "fx": 110.0, "fy": 115.0, "p2": 1e-3},
        {"unified_xi": -0.4, "skew": -7.0},
    ],
    "EUCM": [
        {"fx": 20.0, "fy": 21.0, "unified_alpha": 0.6, "unified_beta": 1.1},
        BORDER | {"cx": 30.0, "unified_alpha": 0.4, "unified_beta": 0.7},
        {"matrix_world": TURNED, "fx": 15.0, "fy": 16.0, "unified_alpha": 0.75, "unified_beta": 2.0, "skew": 1.0},
        SCALED | {"unified_alpha": 0.0},
        {"fx": 30.0, "unified_alpha": 0.9, "unified_beta": 0.3},
        {"fx": 30.0, "unified_alpha": 1.05},
    ],
    "DOUBLE_SPHERE": [
        {"fx": 20.0, "fy": 21.0, "unified_alpha": 0.57, "unified_xi": -0.2},
        BORDER | {"cx": 30.0, "unified_alpha": 0.4, "unified_xi": 0.5},
        {"matrix_world": TURNED, "fx": 20.0, "fy": 19.0, "unified_alpha": 0.8, "unified_xi": 0.3, "skew": 1.0},
        SCALED | {"unified_xi": 0.9, "unified_alpha": 0.6},
        {"unified_xi": 1.4, "unified_alpha": 0.3},
        {"unified_xi": -0.1, "unified_alpha": -0.3},
    ],
    "FISHEYE624": [
        {"fx": 20.0, "fy": 20.0},
        BORDER | {"cx": 30.0, **ARIA},
        {"matrix_world": TURNED, "fx": 18.0, "fy": 17.0, **ARIA, "p1": 0.01, "p2": -0.02, "skew": 1.0},
        SCALED | {"fx": 30.0, "k1": -0.02, "k6": -1e-6, "s1": 4e-3, "s2": -1e-3, "s3": 2e-3, "s4": 5e-4},
    ],
    "FOV": [
        {"fx": 30.0, "fy": 31.0, "fov_omega": 0.9},
        BORDER | {"cx": 30.0, "fov_omega": 1.4, "fx": 50.0},
        {"matrix_world": TURNED, "fov_omega": 1e-6, "skew": 1.0},
        SCALED | {"fx": 15.0, "fov_omega": 2.0},
        ON_SENSOR | {"fov_omega": 0.8},
    ],
    "DIVISION": [
        {"division_lambda": -0.4},
        BORDER | {"cx": 30.0, "division_lambda": 0.3},
        {"matrix_world": TURNED, "fx": 18.0, "fy": 17.0, "division_lambda": -0.25, "skew": 1.0},
        SCALED | {"division_lambda": 0.0},
        {"fx": 20.0, "fy": 18.0, "division_lambda": 0.2},
    ],
    "RADIAL_POLYNOMIAL": [
        {"radial_polynomial": "0 0.85 0.15 0.02 -0.02"},
        BORDER | {"cx": 30.0, "radial_polynomial": "0 1 0 -0.08"},
        {"matrix_world": TURNED, "fx": 48.0, "fy": 47.0, "radial_polynomial": "0 1 0.1 -0.1 0 0.02", "skew": 1.0},
        SCALED | {"radial_polynomial": "0 1"},
        ON_SENSOR | {"radial_polynomial": "(0, 1.1, -0.2, 0.05)"},
    ],
    "FTHETA": [
        {"ftheta_angle_to_radius": "0 28 0.5 -1.5 0.3 -0.02"},
        BORDER | BACKWARD | {"cx": 30.0, "ftheta_radius_to_angle": "0 0.03 1e-5 -2e-7"},
        {"matrix_world": TURNED, "ftheta_angle_to_radius": "0 20 0 1.5", "ftheta_max_angle": 2.0, **LINEAR},
        SCALED | BACKWARD | LINEAR | {"ftheta_radius_to_angle": "0 0.02 0 1e-6 0 1e-10"},
        BACKWARD | {"ftheta_radius_to_angle": "0 0.04", "ftheta_max_angle": 1.5},
        ON_SENSOR | {"matrix_world": TURNED, "ftheta_angle_to_radius": "0 9 0.1 -0.2"},
    ],
    "OCAM": [
        {"ocam_polynomial": "-30 0 0.01 1e-5 2e-7"},
        BORDER | {"cx": 30.0, "ocam_polynomial": "(-60, 0, -0.002)"},
        {"matrix_world": TURNED, "ocam_polynomial": "-25 0.1 0.005 1e-4", "ocam_c": 1.1, "ocam_d": -0.1, "ocam_e": 0.1},
        SCALED | {"ocam_polynomial": "-20 0 0.02", "ocam_c": 0.9},
        {"ocam_polynomial": "-20 0 -0.01"},
    ],
    "THIN_PRISM_FISHEYE": [
        {"fx": 30.0, "fy": 31.0, "k1": -0.03, "k2": 0.01, "k3": 2e-3, "k4": -1e-3},
        BORDER | {"cx": 30.0, "k1": 0.02, "p1": 1e-3, "p2": -2e-3, "s1": 4e-3, "s3": -3e-3},
        {"matrix_world": TURNED, "fx": 18.0, "fy": 17.0, "k1": -0.02, "p1": -0.004, "s3": 0.002, "skew": 1.0},
        SCALED | {"fx": 15.0, "s1": 1e-3},
    ],
}

FACTS = {
    "UCM": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 48.0}, (96, 27), (0, 0, 0), (1, 0, -1)),  # a pinhole
        ({"fx": 48.0, "unified_xi": 1.0}, (96, 27), (0, 0, 0), (1, 0, 0)),  # stereographic: tan 45 degrees
        ({"fx": 48.0, "unified_xi": 3.0}, (64, 27), (0, 0, 0), (1, 0, 0)),  # 1 / 3
        # x (1 + k1 x^2) with x = k1 = 1/2: a pincushion drives it out
        ({"fx": 48.0, "k1": 0.5}, (48 + 48 * 9 / 16, 27), (0, 0, 0), (1 / 2, 0, -1)),
        # a row one unit up is skewed by a quarter to the left
        ({"fx": 48.0, "fy": 27.0, "skew": 12.0}, (84, 54), (0, 0, 0), (1, 1, -1)),
    ],
    "EUCM": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 24.0}, (96, 27), (0, 0, 0), (1, 0, 0)),  # half of xi = 1
        ({"fx": 48.0, "unified_alpha": 0.0, "unified_beta": 7.0}, (96, 27), (0, 0, 0), (1, 0, -1)),
        ({"fx": 48.0, "unified_alpha": 0.5, "unified_beta": 4.0}, (96, 27), (0, 0, 0), (1, 0, 0)),  # 1 / (alpha 2)
    ],
    "FISHEYE624": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 96 / pi}, (96, 27), (0, 0, 0), (1, 0, 0)),
        # at 45 degrees r = 1 + k6: the angles beyond are not asked, the polynomial grows up to 180 degrees
        ({"fy": 27 / (pi / 4 * (1 + 0.01 * (pi / 4) ** 12)), "k6": 0.01}, (48, 54), (0, 0, 0), (0, 1, -1)),
        # upwards b < 0: p1 r^2 + 2 p1 b^2 pushes it down by 3 p1 r^2, and p2 r^2 pushes it to the right
        ({"fx": 24.0, "fy": 24.0, "p1": 0.05, "p2": 0.1}, UP_A_HALF, (0, 0, 0), HALF_A_RADIAN_UP),
    ],
    "FOV": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 96.0, "fov_omega": pi / 2}, (96, 27), (0, 0, 0), (1, 0, -2)),  # tan 45 degrees, halved
        ({"fx": 96.0, "fov_omega": pi / 3}, (96, 27), (0, 0, 0), (1, 0, -2)),  # tan 30 degrees over twice that
    ],
    "DIVISION": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 48.0, "division_lambda": 1.0}, (96, 27), (0, 0, 0), (1, 0, -2)),
        ({"fx": 48.0, "division_lambda": -1.0}, (96, 27), (0, 0, 0), (1, 0, 0)),
        ({"fx": 24.0, "division_lambda": -1.0}, (96, 27), (0, 0, 0), (2, 0, 3)),
    ],
    "FTHETA": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"ftheta_angle_to_radius": f"0 {96 / pi!r}"}, (96, 27), (0, 0, 0), (1, 0, 0)),
        ({"ftheta_angle_to_radius": f"0, {96 / pi!r}", "ftheta_c": 2.0}, (96, 27), (0, 0, 0), (1, 0, -1)),
        (QUARTER | {"ftheta_d": 1.0}, (48, 54), (0, 0, 0), (1, 1, 0)),  # 27 right and 27 up: u = 27 - 27
        (QUARTER | {"ftheta_e": 1.0}, (75, 27), (0, 0, 0), (1, 1, 0)),
        ({"ftheta_angle_to_radius": f"0 {192 / pi!r}", **TWICE_AS_WIDE}, (96, 27), (0, 0, 0), (1, 0, 0)),
    ],
    "RADIAL_POLYNOMIAL": [
        ({"fx": 48.0, "radial_polynomial": "0 1"}, (96, 27), (0, 0, 0), (1, 0, -1)),  # a pinhole
        # 1/2 + 1/4 + 1/8 of the focal length
        ({"fx": 64.0, "radial_polynomial": "0 1 1 1"}, (48 + 56, 27), (0, 0, 0), (1 / 2, 0, -1)),
        # ptlens: r^4 counts
        ({"fx": 32.0, "fy": 16.0, "radial_polynomial": "0 1 0 0 -0.125"}, (48, 27 + 14), (0, 0, 0), (0, 1, -1)),
    ],
    "OCAM": [
        (HOLE, (48, 27), (0, 0, 0), (0, 0, -1)),
        (HOLE, (96, 27), (0, 0, 0), (1, 0, -1)),
        ({"ocam_polynomial": f"-48 0 {1 / 48!r}"}, (96, 27), (0, 0, 0), (1, 0, 0)),
        (HOLE | {"ocam_c": 27 / 48}, (48, 54), (0, 0, 0), (0, 1, -1)),
        (HOLE | {"ocam_d": 1.0}, (96, 27), (0, 0, 0), (1, 1, -1)),  # what is 48 to the right moves down by as much
        (HOLE | {"ocam_e": 1.0}, (48, 54), (0, 0, 0), (27, 27, -48)),  # what is 27 up moves to the left by as much
    ],
    "THIN_PRISM_FISHEYE": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 96 / pi}, (96, 27), (0, 0, 0), (1, 0, 0)),
        ({"fx": 48 / (pi / 2 * (1 + 0.01 * (pi / 2) ** 8)), "k4": 0.01}, (96, 27), (0, 0, 0), (1, 0, 0)),
        # s1 pushes half a radian up to the right by s1 r^2, s3 down
        ({"fx": 24.0, "fy": 24.0, "s1": 0.1, "s3": 0.15}, UP_A_HALF, (0, 0, 0), HALF_A_RADIAN_UP),
    ],
    "DOUBLE_SPHERE": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fx": 24.0}, (96, 27), (0, 0, 0), (1, 0, 0)),
        ({"fx": 36.0, "unified_xi": 0.75, "unified_alpha": 0.0}, (96, 27), (0, 0, 0), (1, 0, 0)),
        # 90 degrees lie at the distance sqrt(1 + 9/16) = 5/4 from the second center: 1 / (5/8 + 3/8)
        ({"fx": 48.0, "unified_xi": 0.75}, (96, 27), (0, 0, 0), (1, 0, 0)),
    ],
}

UNSEEN = {
    "UCM": [(0, 0, 0), (0, 0, 1), (1, 2, 0)],
    "EUCM": [(0, 0, 0), (0, 0, 1)],
    "DOUBLE_SPHERE": [(0, 0, 0), (0, 0, 1)],
    "FISHEYE624": [(0, 0, 0), (0, 0, 1)],
    "FTHETA": [(0, 0, 0), (0, 0, 1)],
    "OCAM": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "FOV": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "RADIAL_POLYNOMIAL": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "DIVISION": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "THIN_PRISM_FISHEYE": [(0, 0, 0), (0, 0, 1)],
}

REFUSED = {
    "UCM": [
        ({"skew": 1e20}, "skew"),
        ({"unified_xi": -1.0}, "unified_xi"),
        ({"unified_xi": NAN}, "unified_xi"),
        ({"k2": NAN}, "k2"),
    ],
    "FISHEYE624": [({"k6": NAN}, "k6"), ({"fx": 0.0}, "fx"), ({"s4": 1e31}, "s4")],
    "THIN_PRISM_FISHEYE": [({"k4": NAN}, "k4"), ({"cx": 1e9}, "cx"), ({"skew": NAN}, "skew")],
    "RADIAL_POLYNOMIAL": [
        ({"radial_polynomial": "0 wide"}, "radial_polynomial .*'0 wide'"),
        ({"radial_polynomial": "1 1"}, "it must be 0, a number above 0"),
        ({"radial_polynomial": "0 -1"}, "it must be 0, a number above 0"),
    ],
    "FTHETA": [
        ({"ftheta_angle_to_radius": ""}, "ftheta_angle_to_radius .* finite numbers"),
        ({"ftheta_angle_to_radius": "0 wide"}, "ftheta_angle_to_radius .*'0 wide'"),
        ({"ftheta_angle_to_radius": "0 1000 nan"}, "ftheta_angle_to_radius"),
        ({"ftheta_angle_to_radius": "1 1000"}, "it must be 0, a number above 0"),
        (BACKWARD | {"ftheta_radius_to_angle": "0 -1"}, "ftheta_radius_to_angle"),
        ({"ftheta_reference": "SIDEWAYS"}, "ftheta_reference"),
        ({"ftheta_c": 0.5, "ftheta_d": 1.0, "ftheta_e": 1.0}, "ftheta_c .* above ftheta_d"),
        ({"ftheta_max_angle": 0.0}, "ftheta_max_angle"),
        ({"cy": NAN}, "cy"),
    ],
    "OCAM": [
        ({"ocam_polynomial": "1 2"}, "ocam_polynomial .*: it must be a number below 0"),
        ({"ocam_polynomial": "-1e300"}, "ocam_polynomial"),
        ({"ocam_c": 0.0}, "ocam_c"),
        ({"ocam_d": NAN}, "ocam_d"),
    ],
    "FOV": [({"fov_omega": -0.1}, "fov_omega"), ({"fov_omega": pi}, "fov_omega"), ({"fov_omega": NAN}, "fov_omega")],
    "DIVISION": [({"division_lambda": NAN}, "division_lambda"), ({"fy": NAN}, "fy")],
    "EUCM": [({"unified_alpha": 2.1}, "unified_alpha"), ({"unified_beta": 0.0}, "unified_beta")],
    "DOUBLE_SPHERE": [({"unified_xi": -1.0}, "unified_xi"), ({"unified_alpha": -1.1}, "unified_alpha")],
}
