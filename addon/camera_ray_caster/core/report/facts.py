"""What a camera is, in the words of the lecture and of computer vision: for the report and the panels."""

from __future__ import annotations

import math

from ..camera.camera import Camera
from ..cameras.general_linear import GeneralLinear
from ..cameras.orthographic import Orthographic
from ..cameras.perspective import Perspective


def camera_facts(camera: Camera) -> dict[str, object]:
    """Return names, numbers and lists of numbers, in the order in which they are shown.

    Every camera: eye (world), orthobasis u, v and w = -Z (world, unit), raster (pixels), window (the columns x0 .. x1
    and rows y0 .. y1 that are rendered), pixel aspect, clip range. A pinhole: field of view across and up (degrees,
    without shift, as Blender's panel has it), image-plane distance d of the lecture's ray x u + aspect y v + d w over
    [-1, 1]^2, that aspect, and K in OpenCV's convention (y down, origin in the center of the top left pixel). An
    orthographic camera: the width and height of the frame in Blender units. A general linear camera: its kind.
    """
    raster, basis = camera.raster, camera.pose.basis
    facts: dict[str, object] = {
        "name": camera.name,
        "model": type(camera.model).__name__,
        "eye": camera.pose.eye.tolist(),
        "u": basis[:, 0].tolist(),
        "v": basis[:, 1].tolist(),
        "w": (0.0 - basis[:, 2]).tolist(),  # no -0
        "raster": [raster.width, raster.height],
        "window": [raster.x0, raster.x1, raster.y0, raster.y1],
        "pixel_aspect": raster.pixel_aspect,
        "clip": [camera.clip_start, camera.clip_end],
    }
    if isinstance(camera.model, Perspective):
        facts |= _pinhole(camera)
    elif isinstance(camera.model, GeneralLinear):
        facts["kind"] = camera.model.kind
    elif isinstance(camera.model, Orthographic):
        window = camera.model.window
        facts["frame"] = [raster.width * window.pitch_x, raster.height * window.pitch_y]
    return facts


def _pinhole(camera: Camera) -> dict[str, object]:
    raster, window = camera.raster, camera.model.window
    tan_x, tan_y = window.pitch_x * raster.width / 2, window.pitch_y * raster.height / 2
    return {
        "field_of_view": [math.degrees(2 * math.atan(tan_x)), math.degrees(2 * math.atan(tan_y))],
        "d": 1 / tan_x,
        "aspect": tan_y / tan_x,
        "K": [
            [1 / window.pitch_x, 0.0, window.center_x - 0.5],
            [0.0, 1 / window.pitch_y, raster.height - window.center_y - 0.5],
            [0.0, 0.0, 1.0],
        ],
    }
