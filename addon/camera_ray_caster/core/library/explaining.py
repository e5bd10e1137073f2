"""A pixel explained step by step, at its own time."""

from __future__ import annotations

import numpy as np

from ..arguments import numbers, shown
from ..camera.camera import Camera
from ..cast import moment
from ..casting.request import MATERIAL
from ..lesson.lesson import Lesson, lesson
from ..records import InputError, Shapes


def explain(camera: Camera, shapes: Shapes, pixel, *, shading: str = MATERIAL, samples: int = 1) -> Lesson:
    """Return how a pixel gets its color: raster, view coordinates, the model's formula with its numbers, the ray, each
    shape's equation, the hit, and each lamp's light. ``print`` shows all steps.

    pixel: (column, row), whole numbers from the bottom left of the full frame.
    shading, samples: as in ``cast``.
    Raises InputError, in one line, for a pixel outside of the frame; TypeError for a camera or shapes of another type.
    """
    if not (isinstance(camera, Camera) and isinstance(shapes, Shapes)):
        raise TypeError(f"explain takes a camera and shapes, not {type(camera)} and {type(shapes)}")
    place = numbers(pixel, "pixel")
    if place.shape != (2,) or not (np.isfinite(place) & (place == np.floor(place))).all():
        raise InputError(f"pixel is {shown(pixel)}: it must be (column, row), two whole numbers")
    column, row = place.astype(int).tolist()
    time = camera.pixel_time
    frame = None if time is None else float(np.asarray(time.frame_at(column + 0.5, row + 0.5)).ravel()[0])
    return lesson(*moment(camera, shapes, frame), column, row, shading=shading, samples=samples)
