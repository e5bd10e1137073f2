"""Examples of the real lens: see model_examples, which takes them in."""

from .example_frames import BORDER, PORTRAIT, SHIFTED, TURNED

EXAMPLES = {
    "REAL_LENS": [
        {},
        SHIFTED | {"lens": 35.0, "focus_distance": 0.7},
        PORTRAIT | {"lens_focus": "PARAXIAL", "lens_wavelength": 450.0},
        BORDER | {"lens": 24.0, "sensor_width": 30.0, "matrix_world": TURNED, "aperture_fstop": 8.0},
    ],
}

UNSEEN = {"REAL_LENS": [(0, 0, 1), (0, 0, 0), (5, 0, -1), (0.1, 0, 2)]}
