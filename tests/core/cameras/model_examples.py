"""The examples that the contract of the cameras is tested on: a new model joins by an entry in each table.

The tables have the model's key; a model without an entry has one plain example and no facts. Settings are fields of
BlenderCamera over ``DEFAULTS``, and of its ``settings`` over ``ONLY_SOME`` and the defaults that models declare.
"""

from collections import defaultdict
from dataclasses import fields
from math import pi, sqrt

import numpy as np

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.records import BlenderCamera

from . import central_examples, lens_examples, multiperspective_examples, table_examples
from .example_frames import BORDER, DEFAULTS, IDENTITY, PORTRAIT, SHIFTED, TURNED, WIDE_PIXELS

__all__ = ["BORDER", "EXAMPLES", "FACTS", "IDENTITY", "ONLY_SOME", "REFUSED", "TURNED", "UNSEEN", "camera", "raw_of"]

ONLY_SOME = {
    **central_examples.ONLY_SOME,
    **multiperspective_examples.ONLY_SOME,
    **table_examples.ONLY_SOME,
    "longitude_min": -pi, "longitude_max": pi, "latitude_min": -pi / 2, "latitude_max": pi / 2,
    "fisheye_fov": pi, "fisheye_lens": 10.5,
    "fisheye_polynomial_k0": 0.0, "fisheye_polynomial_k1": -pi / 72, "fisheye_polynomial_k2": 0.0,
    "fisheye_polynomial_k3": 0.0, "fisheye_polynomial_k4": 0.0,
    "central_cylindrical_range_u_min": -pi, "central_cylindrical_range_u_max": pi,
    "central_cylindrical_range_v_min": -1.0, "central_cylindrical_range_v_max": 1.0,
    "central_cylindrical_radius": 1.0,
    "obscura_depth": 2.0, "obscura_width": 3.0, "obscura_hole": 0.01,
}  # fmt: skip

IN_TANK = {
    "port": "FLAT", "port_distance": 50.0, "port_tilt_x": 0.1, "port_tilt_y": -0.2, "port_thickness": 10.0,
    "port_glass": 1.49, "port_medium": 1.333, "port_inside": 1.0,
}  # fmt: skip
IN_DOME = {
    "port": "DOME", "port_radius": 80.0, "port_decenter": (3.0, -5.0, 20.0), "port_thickness": 4.0, "port_glass": 1.49,
    "port_medium": 1.333, "port_inside": 1.0,
}  # fmt: skip
"""Settings of a camera behind glass, which any model with an eye takes."""

EXAMPLES = defaultdict(lambda: [{}], {
    **lens_examples.EXAMPLES,
    **central_examples.EXAMPLES,
    **multiperspective_examples.EXAMPLES,
    **table_examples.EXAMPLES,
    "PERSP": [{}, PORTRAIT, WIDE_PIXELS, BORDER | {"lens": 4.0}, {"lens": 400.0, "matrix_world": TURNED},
              IN_TANK | {"lens": 18.0}, PORTRAIT | IN_DOME | {"port_inside": 1.47}],
    "ORTHO": [{}, PORTRAIT, WIDE_PIXELS, BORDER | {"ortho_scale": 0.01}, {"ortho_scale": 50.0, "matrix_world": TURNED}],
    "EQUIRECTANGULAR": [{}, SHIFTED, BORDER, {"longitude_min": 0.5, "latitude_max": 0.1, "shift_y": 0.2}],
    "EQUIANGULAR_CUBEMAP_FACE": [{}, SHIFTED, BORDER, PORTRAIT],
    "MIRRORBALL": [{}, SHIFTED, BORDER, PORTRAIT],
    "FISHEYE_EQUIDISTANT": [{}, SHIFTED, BORDER | {"fisheye_fov": 0.3}, PORTRAIT | {"fisheye_fov": 6.2},
                            IN_TANK | {"fisheye_fov": 2.2, "matrix_world": TURNED}, IN_DOME | {"fisheye_fov": 4.0},
                            IN_TANK | {"fisheye_fov": 2.6, "port_inside": 1.47, "port_medium": 1.0}],
    "FISHEYE_EQUISOLID": [
        {},
        SHIFTED,
        PORTRAIT | {"fisheye_fov": 6.2},
        {"pixel_aspect_x": 2.0, "sensor_fit": "VERTICAL"},
    ],
    "FISHEYE_LENS_POLYNOMIAL": [
        {},
        PORTRAIT,
        WIDE_PIXELS,
        BORDER | {"fisheye_polynomial_k0": 1e-3, "fisheye_polynomial_k3": -1e-5},
    ],
    "CENTRAL_CYLINDRICAL": [{}, SHIFTED, BORDER, {"central_cylindrical_radius": 0.2, "shift_y": 0.4}],
    "CAMERA_OBSCURA": [{}, PORTRAIT, WIDE_PIXELS, BORDER | {"obscura_depth": 0.1}],
})  # fmt: skip
"""Cameras for the contract; where a model is singular is its docstring's to say, and not in these pictures."""

FACTS = {
    **central_examples.FACTS,
    **multiperspective_examples.FACTS,
    **table_examples.FACTS,
    "PERSP": [
        # the right edge of a 36 mm sensor behind 18 mm makes 45 degrees, the center looks ahead
        ({"lens": 18.0}, (96, 27), (0, 0, 0), (1, 0, -1)),
        ({"lens": 18.0}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"lens": 18.0}, (48, 54), (0, 0, 0), (0, 54 / 96, -1)),
        # portrait fits the sensor's WIDTH to the height; VERTICAL its height
        ({"lens": 18.0, "resolution_x": 54, "resolution_y": 96}, (27, 96), (0, 0, 0), (0, 1, -1)),
        ({"lens": 12.0, "sensor_fit": "VERTICAL"}, (48, 54), (0, 0, 0), (0, 1, -1)),
        # pixels twice as high as wide make 96 x 54 a portrait frame of 96 x 108
        ({"lens": 18.0, "pixel_aspect_y": 2.0}, (48, 54), (0, 0, 0), (0, 1, -1)),
        ({"lens": 18.0, "pixel_aspect_y": 2.0}, (96, 27), (0, 0, 0), (96 / 108, 0, -1)),
        # a shift of half the fitted side brings the axis to the left edge, and in y by the width as well
        ({"lens": 18.0, "shift_x": 0.5}, (0, 27), (0, 0, 0), (0, 0, -1)),
        ({"lens": 18.0, "shift_y": 0.5}, (48, 27), (0, 0, 0), (0, 1, -1)),
    ],
    "ORTHO": [
        ({"ortho_scale": 8.0}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"ortho_scale": 8.0}, (96, 27), (4, 0, 0), (0, 0, -1)),
        ({"ortho_scale": 8.0, "resolution_x": 54, "resolution_y": 96}, (27, 96), (0, 4, 0), (0, 0, -1)),
        ({"ortho_scale": 8.0, "pixel_aspect_y": 2.0}, (96, 54), (4 * 96 / 108, 4, 0), (0, 0, -1)),
        ({"ortho_scale": 8.0, "shift_y": 0.25}, (48, 27), (0, 2, 0), (0, 0, -1)),
    ],
    "EQUIRECTANGULAR": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (72, 27), (0, 0, 0), (1, 0, 0)),
        ({}, (48, 40.5), (0, 0, 0), (0, 1, -1)),
        ({}, (48, 54), (0, 0, 0), (0, 1, 0)),
        ({"shift_x": 0.25}, (48, 27), (0, 0, 0), (1, 0, 0)),
    ],
    "EQUIANGULAR_CUBEMAP_FACE": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (96, 54), (0, 0, 0), (1, 1, -1)),
        ({}, (72, 27), (0, 0, 0), (sqrt(2) - 1, 0, -1)),
    ],
    "MIRRORBALL": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (72, 27), (0, 0, 0), (sqrt(3), 0, -1)),
        ({}, (48, 13.5), (0, 0, 0), (0, -sqrt(3), -1)),
    ],
    "FISHEYE_EQUIDISTANT": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (96, 27), (0, 0, 0), (1, 0, 0)),
        ({}, (48, 40.5), (0, 0, 0), (0, 1, -1)),
        ({"fisheye_fov": 2 * pi}, (72, 27), (0, 0, 0), (1, 0, 0)),
    ],
    "FISHEYE_EQUISOLID": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({"fisheye_lens": 18.0}, (96, 27), (0, 0, 0), (sqrt(3), 0, -1)),  # 36 mm, 2 asin(18 / 36) = 60 degrees
        ({"fisheye_lens": 12.0, "sensor_fit": "VERTICAL"}, (48, 54), (0, 0, 0), (0, sqrt(3), -1)),
    ],
    "FISHEYE_LENS_POLYNOMIAL": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (96, 27), (0, 0, 0), (1, 0, -1)),  # 18 mm of pi / 72 each
        ({}, (0, 27), (0, 0, 0), (-1, 0, -1)),
    ],
    "CENTRAL_CYLINDRICAL": [
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (72, 27), (0, 0, 0), (1, 0, 0)),
        ({}, (48, 54), (0, 0, 0), (0, 1, -1)),
        ({"central_cylindrical_radius": 0.5}, (48, 54), (0, 0, 0), (0, 2, -1)),
    ],
    "CAMERA_OBSCURA": [
        # a wall 3 wide, 2 behind the hole: its right edge sees what is left, its top what is below
        ({}, (48, 27), (0, 0, 0), (0, 0, -1)),
        ({}, (96, 27), (0, 0, 0), (-1.5, 0, -2)),
        ({}, (48, 54), (0, 0, 0), (0, -1.5 * 54 / 96, -2)),
    ],
}
"""What geometry by hand says: settings, pixel coordinates, the ray's origin and direction (of any length) there."""

UNSEEN = {
    **lens_examples.UNSEEN,
    **central_examples.UNSEEN,
    **multiperspective_examples.UNSEEN,
    **table_examples.UNSEEN,
    "PERSP": [(0, 0, 0), (1, 2, 0), (0, 0, 1), (3, -1, 5)],
    "ORTHO": [],
    "EQUIRECTANGULAR": [(0, 0, 0)],
    "EQUIANGULAR_CUBEMAP_FACE": [(0, 0, 0), (1, 2, 0), (0, 0, 1)],
    "MIRRORBALL": [(0, 0, 0), (0, 0, 1)],
    "FISHEYE_EQUIDISTANT": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "FISHEYE_EQUISOLID": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "FISHEYE_LENS_POLYNOMIAL": [(0, 0, 0), (0, 0, 1), (3, 0, 0.1)],
    "CENTRAL_CYLINDRICAL": [(0, 0, 0), (0, 1, 0), (0, -2, 0)],
    "CAMERA_OBSCURA": [(0, 0, 0), (1, 2, 0), (0, 0, 1)],
}
"""Points in the camera's frame that have no pixel."""

REFUSED = {
    **lens_examples.REFUSED,
    **central_examples.REFUSED,
    **multiperspective_examples.REFUSED,
    **table_examples.REFUSED,
    "PERSP": [
        ({"lens": 0.0}, "lens"),
        ({"lens": float("nan")}, "lens"),
        ({"sensor_width": 0.0}, "sensor_width"),
        ({"sensor_fit": "DIAGONAL"}, "sensor_fit"),
    ],
    "ORTHO": [({"ortho_scale": 0.0}, "ortho_scale"), ({"ortho_scale": float("inf")}, "ortho_scale")],
    "EQUIRECTANGULAR": [({"longitude_min": pi}, "longitude_max"), ({"latitude_max": 2.0}, "latitude_max")],
    "EQUIANGULAR_CUBEMAP_FACE": [],
    "MIRRORBALL": [],
    "FISHEYE_EQUIDISTANT": [({"fisheye_fov": 0.0}, "fisheye_fov"), ({"fisheye_fov": float("nan")}, "fisheye_fov")],
    "FISHEYE_EQUISOLID": [({"fisheye_lens": 0.0}, "fisheye_lens"), ({"fisheye_fov": 40.0}, "fisheye_fov")],
    "FISHEYE_LENS_POLYNOMIAL": [({"fisheye_polynomial_k1": 0.0}, "polynomial"), ({"fisheye_fov": -1.0}, "fisheye_fov")],
    "CENTRAL_CYLINDRICAL": [
        ({"central_cylindrical_radius": 0.0}, "central_cylindrical_radius"),
        ({"central_cylindrical_range_v_min": 1.0}, "central_cylindrical_range_v"),
    ],
    "CAMERA_OBSCURA": [({"obscura_hole": 0.0}, "obscura_hole"), ({"obscura_depth": -1.0}, "obscura_depth")],
}
"""Settings without meaning, and the word of the error that names them."""


def camera(key: str, settings=()):
    """Return the camera of a model with these settings; see ``raw_of``."""
    return camera_from(raw_of(key, settings))


def raw_of(key: str, settings=()):
    """Return the record of a model with these settings over the defaults; slits and path are in the camera's frame."""
    values = {**DEFAULTS, **dict(settings)}
    known = {field.name for field in fields(BlenderCamera)}
    declared = {setting.name: setting.default for model in MODELS for setting in model.SETTINGS}
    only_some = declared | ONLY_SOME | {name: values.pop(name) for name in sorted(set(values) - known)}
    only_some |= {name: attached(only_some[name], values["matrix_world"]) for name in ("slit_1", "slit_2", "path")}
    return BlenderCamera(name="Camera", type="PERSP", model=key, settings=only_some, **values)


def attached(points, matrix_world):
    """Return the setting of an object whose points lie in the frame of the camera, and the edges between them."""
    if points is None:
        return None
    matrix = np.array(matrix_world, float)
    size = np.linalg.norm(matrix[:3, :3], axis=0)
    matrix[:3, :3] /= np.where(size > 0, size, 1)
    return points, matrix, [(k, k + 1) for k in range(len(points) - 1)]
