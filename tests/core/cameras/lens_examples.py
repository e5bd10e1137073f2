"""Examples of the real lens: see model_examples, which takes them in."""

from .example_frames import BORDER, PORTRAIT, SHIFTED, TURNED

EXAMPLES = {
    "REAL_LENS": [
        {},
        SHIFTED | {"lens": 35.0, "focus_distance": 0.7},
        PORTRAIT | {"lens_focus": "PARAXIAL", "lens_wavelength": 450.0},
        BORDER | {"lens": 24.0, "sensor_width": 30.0, "matrix_world": TURNED, "aperture_fstop": 8.0},
        {"tau_x": 0.3, "tau_y": -0.2, "shift_x": 0.1, "focus_distance": 0.7},
    ],
}

UNSEEN = {"REAL_LENS": [(0, 0, 1), (0, 0, 0), (5, 0, -1), (0.1, 0, 2)]}

REFUSED = {"REAL_LENS": [({"tau_x": 1.3, "lens": 12.0}, "tau_x .* at most .* reaches the lens")]}
