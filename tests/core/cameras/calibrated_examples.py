"""Examples of the calibrated families beside OpenCV's two: see model_examples, which takes them in."""

from .example_frames import BORDER, TURNED

SCALED = {"resolution_percentage": 37, "calibration_width": 96, "calibration_height": 54}
NAN = float("nan")

ONLY_SOME = {"unified_xi": 0.0, "unified_alpha": 0.5, "unified_beta": 1.0}

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
    ],
    "DOUBLE_SPHERE": [
        {"fx": 20.0, "fy": 21.0, "unified_alpha": 0.57, "unified_xi": -0.2},
        BORDER | {"cx": 30.0, "unified_alpha": 0.4, "unified_xi": 0.5},
        {"matrix_world": TURNED, "fx": 20.0, "fy": 19.0, "unified_alpha": 0.8, "unified_xi": 0.3, "skew": 1.0},
        SCALED | {"unified_xi": 0.9, "unified_alpha": 0.6},
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
}

REFUSED = {
    "UCM": [({"unified_xi": -1.0}, "unified_xi"), ({"unified_xi": NAN}, "unified_xi"), ({"k2": NAN}, "k2")],
    "EUCM": [({"unified_alpha": 1.0}, "unified_alpha"), ({"unified_beta": 0.0}, "unified_beta")],
    "DOUBLE_SPHERE": [({"unified_xi": 1.0}, "unified_xi"), ({"unified_alpha": -0.1}, "unified_alpha")],
}
