"""The properties of a camera, in the terms of ray tracing and computer vision: for the report and the panels."""

import numpy as np

from ..cameras.model import WindowModel
from ..maths.vector import inverse
from .camera import Camera

CONVENTIONS = {
    "lengths": "Blender units, except millimeters for lenses, sensors and film; meters: the length of a Blender unit",
    "angles": "radians, except degrees for field_of_view",
    "pixels": "(0, 0) is the bottom left corner of the full frame, y up; pixels have their centers at + 1/2",
    "camera": "x right, y up, it looks along -z; u, v and -w are these axes in the world, eye is the origin",
    "K": "as OpenCV: y down, (0, 0) is the center of the top left pixel; of the full frame",
    "picture": "size and K of files of pictures: the full frame, or the window if it is cropped to the render border",
    "world_to_opencv": "rows; from the world to x right, y down, z ahead",
    "plane_from_pixels": "rows; from (x, y, 1) of a pixel to the image plane with which the formula begins",
}
"""Meaning of the numbers in exported files; for details see ``core.conventions``."""


def camera_facts(camera: Camera) -> dict[str, object]:
    """Return names, numbers and lists of numbers, in the order in which they are shown.

    For every camera: its model, eye (world), orthobasis u, v and w = -Z (world, unit), raster (pixels), window (the
    columns x0 .. x1 and rows y0 .. y1 that are rendered), pixel aspect and clip range. For a central camera with rays
    at the middles of the frame's edges: the horizontal and vertical field of view in degrees, from edge to middle to
    edge. Then the facts of the model (``Model.facts``), such as d and aspect of a pinhole; K and the affine map from
    the pixel to the image plane, for models that have them. Last the transform from the world to OpenCV's camera frame,
    the model's settings by name (``Camera.settings``) and its formula, step by step.
    """
    raster, basis = camera.raster, camera.pose.basis
    of_model = camera.model.facts()
    of_model = of_model if "field_of_view" in of_model else _field_of_view(camera) | of_model
    return {
        "name": camera.name,
        "model": camera.model.label,
        "key": camera.model.key,
        "eye": camera.pose.eye.tolist(),
        "u": basis[:, 0].tolist(),
        "v": basis[:, 1].tolist(),
        "w": (0.0 - basis[:, 2]).tolist(),  # no -0
        "raster": [raster.width, raster.height],
        "window": [raster.x0, raster.x1, raster.y0, raster.y1],
        "pixel_aspect": raster.pixel_aspect,
        "clip": [camera.clip_start, camera.clip_end],
        **of_model,
        **({} if camera.K is None else {"K": camera.K.tolist()}),
        **({"picture": _picture(camera)} if raster.size != raster.picture_size else {}),
        **({"plane_from_pixels": _plane(camera.model)} if isinstance(camera.model, WindowModel) else {}),
        "world_to_opencv": camera.opencv_from_world.tolist(),
        "settings": dict(camera.settings),
        "formula": [step._asdict() for step in camera.model.steps],
    }


def _picture(camera: Camera) -> dict[str, object]:
    """Return size and K of the files of cropped pictures."""
    x0, _, _, y1 = camera.raster.picture
    moved = np.array(((0.0, 0.0, x0), (0.0, 0.0, camera.raster.height - y1), (0.0, 0.0, 0.0)))
    K = {} if camera.K is None else {"K": (camera.K - moved).tolist()}
    return {"size": list(camera.raster.picture_size), **K}


def _plane(model: WindowModel) -> list[list[float]]:
    """Return the window's affine map from the pixel to the image plane, (2, 3)."""
    K = model.window.matrix(model.size[1])
    opencv_from_pixels = np.array([[1.0, 0.0, -0.5], [0.0, -1.0, model.size[1] - 0.5], [0.0, 0.0, 1.0]])
    return (np.diag([1.0, -1.0]) @ (inverse(K) @ opencv_from_pixels)[:2]).tolist()


def _field_of_view(camera: Camera) -> dict[str, object]:
    """Return the fact of the field of view, (horizontal, vertical) in degrees; an empty dict if it is undefined."""
    if not camera.model.central:
        return {}
    x, y = np.array([0.0, 0.5, 1.0, 0.5, 0.5]), np.array([0.5, 0.5, 0.5, 0.0, 1.0])
    direction = np.broadcast_arrays(*camera.camera_rays(x * camera.raster.width, y * camera.raster.height)[1])
    left, middle, right, bottom, top = np.stack(direction, axis=-1)
    angles = [_angle(left, middle) + _angle(middle, right), _angle(bottom, middle) + _angle(middle, top)]
    return {"field_of_view": angles} if np.isfinite(angles).all() else {}


def _angle(a, b) -> float:
    """Return the angle between two directions in degrees, exact to rounding for all angles."""
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)))
