"""Poses and frames that the examples of the camera models are made of."""

IDENTITY = [[1.0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
TURNED = [[0.36, 0.48, -0.8, 3], [-0.8, 0.6, 0, -2], [0.48, 0.64, 0.6, 7], [0, 0, 0, 1]]
"""A rotation, exact in decimals, and an offset."""

DEFAULTS = {"resolution_x": 96, "resolution_y": 54, "matrix_world": IDENTITY}
PORTRAIT = {"resolution_x": 54, "resolution_y": 96, "shift_x": 0.3, "shift_y": -0.2, "matrix_world": TURNED}
VERTICAL = {"pixel_aspect_x": 2.0, "sensor_fit": "VERTICAL"}
WIDE_PIXELS = VERTICAL | {"shift_y": 0.7, "resolution_percentage": 37}
SHIFTED = {"shift_x": 0.3, "matrix_world": TURNED}
BORDER = {"use_border": True, "border_min_x": 0.2, "border_max_x": 0.7, "border_min_y": 0.1, "border_max_y": 0.4}
