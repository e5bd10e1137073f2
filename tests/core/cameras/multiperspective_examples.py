"""Examples of the models without one eye: see model_examples, which takes them in and fixes slits to the camera."""

from math import cos, sin

from .example_frames import BORDER, PORTRAIT, SHIFTED, TURNED, WIDE_PIXELS

ONLY_SOME = {
    "ray_1": (-0.1, -0.1, -0.6, -0.4), "ray_2": (0.1, -0.1, 0.6, -0.4), "ray_3": (-0.1, 0.1, -0.6, 0.4),
    "slit_1": ((0, 0, 0), (1, 0, 0)), "slit_2": ((0, 0, 0.5), (0, 1, 0.5)), "pencil_slide": 0.5, "twist": 0.02,
    "path": ((-2, 0, 0), (2, 0, 0)), "follow_path": False, "eye": "LEFT", "interocular_distance": 0.065,
}  # fmt: skip

LEANING = {"slit_1": ((0.1, 0.2, 0.3), (1.1, 0.5, 0.1)), "slit_2": ((-0.3, 0.1, 1.5), (-0.2, 1.2, 1.4))}
"""Slits that are not parallel to the image plane, nor at right angles."""
BEND = tuple((3 * sin(a), 0.3 * a, 3 * cos(a) - 3) for a in (k / 10 for k in range(-9, 10)))
"""A path around a point behind the camera: with follow_path its columns look outwards and see each point once."""

EXAMPLES = {
    "GENERAL_LINEAR": [{}, BORDER, SHIFTED, {"ray_3": (0.3, 0.2, -0.4, 0.5), "matrix_world": TURNED}],
    "CROSS_SLIT": [{}, PORTRAIT | LEANING, WIDE_PIXELS | LEANING, BORDER | {"lens": 8.0}],
    "PUSHBROOM": [{}, PORTRAIT | LEANING, WIDE_PIXELS | LEANING, BORDER | {"ortho_scale": 0.1}],
    "PENCIL": [{}, PORTRAIT | LEANING, WIDE_PIXELS | LEANING, BORDER | {"lens": 8.0, "pencil_slide": -3.0}],
    "TWISTED_ORTHOGRAPHIC": [{}, PORTRAIT | LEANING, WIDE_PIXELS | LEANING, BORDER | {"twist": 0.0}],
    "STRIP": [{}, PORTRAIT, WIDE_PIXELS | {"path": BEND, "follow_path": True}, BORDER | {"lens": 8.0}],
    "OMNIDIRECTIONAL_STEREO": [{}, SHIFTED | {"eye": "RIGHT", "interocular_distance": 3.0}, BORDER],
    "SCANNER": [
        {},
        {"scanner_device": "VLP_32C", "matrix_world": TURNED},
        BORDER | {"scanner_device": "TERRESTRIAL", "scanner_start": -2.0},
        {"scanner_device": "SOLID_STATE", "scanner_rate": 25.0},
        {"scanner_direction": "COUNTERCLOCKWISE", "scanner_elevations": "-60, -5, 2.5, 80", "matrix_world": TURNED,
         "scanner_azimuths": "1 2 3 4", "scanner_ahead": "0.25 .25 .249 .25", "scanner_right": "-0.125",
         "scanner_up": "0.5 .5 .499 .498", "scanner_delays": "1000"},
    ],
}

FACTS = {
    "SCANNER": [
        # columns are 3.75 degrees apart, the first looks ahead; rows 5 degrees
        ({"scanner_low": -0.5, "scanner_high": 0.5}, (0.5, 27), (0, 0, 0), (0, 0, -1)),
        ({"scanner_low": -0.5, "scanner_high": 0.5}, (24.5, 0.5), (0, 0, 0), (cos(0.5), -sin(0.5), 0)),
        ({"scanner_low": -0.5, "scanner_high": 0.5, "scanner_direction": "COUNTERCLOCKWISE"}, (24.5, 53.5), (0, 0, 0),
         (-cos(0.5), sin(0.5), 0)),
        # the lower beam, at 90 degrees more, has its origin 2 ahead of the axis, and looks down
        ({"scanner_elevations": "45 -45", "scanner_azimuths": "0 90", "scanner_ahead": "1 2", "scanner_right": "0 3",
          "scanner_up": "4 5"}, (0.5, 13.5), (2, 5, 3), (1, -1, 0)),
        # a sweep takes 0.1 s: what fires 25 ms late looks a quarter of a turn farther
        ({"scanner_delays": "25000"}, (0.5, 27), (0, 0, 0), (1, 0, 0)),
    ],
    "GENERAL_LINEAR": [
        # ray 1 at the bottom left corner, 2 at the bottom right, 3 at the top left
        ({}, (0, 0), (-0.1, -0.1, 0), (-0.5, -0.3, -1)),
        ({}, (96, 0), (0.1, -0.1, 0), (0.5, -0.3, -1)),
        ({}, (0, 54), (-0.1, 0.1, 0), (-0.5, 0.3, -1)),
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
    ],
    "CROSS_SLIT": [
        # a level slit through the camera gives rows their slope, an upright one 0.5 behind it columns theirs
        ({"lens": 18.0}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"lens": 18.0}, (96, 27), (1 / 3, 0, 0), (1 / 1.5, 0, -1)),
        ({"lens": 18.0, "slit_2": ((0, 0, 0), (0, 1, 0))}, (96, 54), (0, 0, 0), (1, 54 / 96, -1)),
    ],
    "PUSHBROOM": [
        ({"lens": 18.0, "ortho_scale": 8.0}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"lens": 18.0, "ortho_scale": 8.0}, (96, 54), (4, 0, 0), (0, 54 / 96, -1)),
        ({"lens": 18.0, "ortho_scale": 8.0, "slit_1": ((0, 0, 0), (0, 2, 0))}, (96, 54), (0, 2.25, 0), (1, 0, -1)),
        # a slit beside and behind the camera: the eye flies there; what lies along it changes nothing
        ({"lens": 18.0, "ortho_scale": 8.0, "slit_1": ((7, 1, 2), (9, 1, 2))}, (96, 54), (4, 1, 2), (0, 54 / 96, -1)),
    ],
    "PENCIL": [
        ({"lens": 18.0}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"lens": 18.0}, (96, 27), (0, 0, 0), (1, 0, -1)),
        ({"lens": 18.0}, (96, 54), (27 / 96, 0, 0), (1, 54 / 96, -1)),
        ({"lens": 18.0, "slit_1": ((0, 0, 0), (0, 2, 0))}, (96, 54), (0, -0.5, 0), (1, 54 / 96, -1)),
    ],
    "TWISTED_ORTHOGRAPHIC": [
        ({"ortho_scale": 8.0}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"ortho_scale": 8.0}, (96, 54), (4, 2.25, 0), (0, 0.08, -1)),
        ({"ortho_scale": 8.0, "slit_1": ((3, 0, 0), (4, 0, 0))}, (96, 54), (4, 2.25, 0), (0, 0.02, -1)),
    ],
    "STRIP": [
        ({"lens": 18.0}, (0, 27), (-2, 0, 0), (0, 0, -1)),
        ({"lens": 18.0}, (96, 54), (2, 0, 0), (0, 54 / 96, -1)),
        # two sides of a square, counterclockwise from above: it looks inwards, at the corner along the diagonal
        ({"path": ((1, 0, 1), (1, 0, -1), (-1, 0, -1)), "follow_path": True}, (0, 27), (1, 0, 1), (-1, 0, 0)),
        ({"path": ((1, 0, 1), (1, 0, -1), (-1, 0, -1)), "follow_path": True}, (48, 27), (1, 0, -1), (-1, 0, 1)),
    ],
    "OMNIDIRECTIONAL_STEREO": [
        ({"interocular_distance": 0.5}, (48, 27), (-0.25, 0, 0), (0, 0, -1)),
        ({"interocular_distance": 0.5}, (72, 27), (0, 0, -0.25), (1, 0, 0)),
        ({"interocular_distance": 0.5, "eye": "RIGHT"}, (72, 40.5), (0, 0, 0.25), (1, 1, 0)),
        # the left eye above, or on the left
        ({"interocular_distance": 0.5, "eye": "TOP_BOTTOM"}, (72, 40.5), (0, 0, -0.25), (1, 0, 0)),
        ({"interocular_distance": 0.5, "eye": "TOP_BOTTOM"}, (72, 13.5), (0, 0, 0.25), (1, 0, 0)),
        ({"interocular_distance": 0.5, "eye": "SIDE_BY_SIDE"}, (24, 27), (-0.25, 0, 0), (0, 0, -1)),
        ({"interocular_distance": 0.5, "eye": "SIDE_BY_SIDE"}, (72, 27), (0.25, 0, 0), (0, 0, -1)),
    ],
}

UNSEEN = {
    "SCANNER": [(0, 0, 0)],
    "GENERAL_LINEAR": [(0, 0, 0.1), (3, 1, 5)],
    "CROSS_SLIT": [(0, 0, 0.1), (3, 0, 0), (1, 2, 4)],
    "PUSHBROOM": [(0, 0, 0), (1, 2, 0), (3, -1, 5)],
    "PENCIL": [(0, 0, 0), (1, 2, 0), (3, -1, 5)],
    "TWISTED_ORTHOGRAPHIC": [(0, 0, 0.1), (1, 2, 4)],
    "STRIP": [(0, 0, 0), (0, 0, 1), (2.1, 0, -1), (-2.1, 0, -1)],
    "OMNIDIRECTIONAL_STEREO": [(0, 0, 0), (0.01, 7, 0.02)],
}

REFUSED = {
    "SCANNER": [
        ({"scanner_elevations": "1 2", "scanner_azimuths": "1 2 3"}, "scanner_azimuths"),
        ({"scanner_elevations": "1 nan"}, "scanner_elevations"),
        ({"scanner_elevations": "7 7"}, "must differ"),
        ({"scanner_elevations": "7 97"}, "between -90 and 90"),
        ({"scanner_rate": 0.0}, "scanner_rate"),
        ({"scanner_period": 2e5}, "scanner_period"),
        ({"scanner_device": "ROUND"}, "scanner_device"),
        ({"scanner_nearest": 5.0, "scanner_farthest": 4.0}, "range"),
    ],
    "GENERAL_LINEAR": [
        ({"ray_3": (-0.1, -0.1, -0.6, -0.4)}, "ray_1, ray_2, ray_3 .* dependent"),
        ({"ray_3": (0.3, -0.1, 1.8, -0.4)}, "ray_1, ray_2, ray_3 .* dependent"),
        ({"ray_2": (0.1, 0.2, 0.3)}, "ray_2.*4 finite numbers"),
        ({"ray_2": (0.1, 0.2, 0.3, float("nan"))}, "ray_2.*4 finite numbers"),
    ],
    "CROSS_SLIT": [
        ({"slit_1": None}, "slit_1.*not set"),
        ({"slit_2": ((1, 2, 3), (1, 2, 3))}, "slit_2.*no direction"),
        ({"slit_2": ((1, 2, 3), (3, 2, 3))}, "slit_1 and slit_2.*parallel"),
        ({"slit_2": ((1, 2, -1), (3, 5, -1))}, "slit_2.*plane"),
        ({"lens": 0.0}, "lens"),
    ],
    "PUSHBROOM": [
        ({"slit_1": None}, "slit_1.*not set"),
        ({"slit_1": ((0, 0, 1), (0, 0, 2))}, "slit_1.*viewing direction"),
        ({"slit_1": ((0, 0, float("inf")), (0, 0, 2))}, "slit_1.*infinite or NaN numbers"),
        ({"ortho_scale": 0.0}, "ortho_scale"),
    ],
    "PENCIL": [
        ({"slit_1": None}, "slit_1.*not set"),
        ({"slit_1": ((0, 0, 1), (0, 0, 2))}, "slit_1.*viewing direction"),
        ({"pencil_slide": float("inf")}, "pencil_slide.*finite"),
    ],
    "TWISTED_ORTHOGRAPHIC": [({"slit_1": None}, "slit_1.*not set"), ({"twist": float("nan")}, "twist.*finite")],
    "STRIP": [
        ({"path": None}, "path.*not set"),
        ({"path": ((1, 2, 3),)}, "path.*no length"),
        ({"path": ((1, 2, 3), (1, 2, 3))}, "path.*no length"),
        ({"path": ((0, 0, 0), (0, 1, -2))}, "path.*leads only ahead or up"),
        ({"path": ((0, 0, 0), (0, 1, 0)), "follow_path": True}, "path.*up axis"),
        ({"path": ((0, 0, 0), (1, 0, 0), (0, 0, 0)), "follow_path": True}, "path.*straight back, at point 1"),
    ],
    "OMNIDIRECTIONAL_STEREO": [
        ({"eye": "THIRD"}, "eye.*LEFT, RIGHT, TOP_BOTTOM, SIDE_BY_SIDE"),
        ({"interocular_distance": -0.1}, "interocular_distance"),
    ],
}
