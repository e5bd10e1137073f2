"""A pixel explained step by step, at its own time."""

from typing import Any

import numpy as np

from ..arguments import numbers, shown, word
from ..camera.camera import Camera
from ..casting.request import MATERIAL, SHADINGS
from ..conventions import BOTTOM, TOP
from ..lesson.lesson import Lesson, lesson
from ..records import InputError
from ..scene import Scene


def explain(
    camera: Camera | Scene, shapes: Any = None, pixel=None, *, shading: str = MATERIAL, samples=1, rows: str = BOTTOM
) -> Lesson:
    """Return how a pixel gets its color: raster, view coordinates, the model's formula with its numbers, the ray, each
    shape's equation, the hit, and each lamp's light. ``print`` shows all steps.

    camera, shapes: as in ``cast``; also ``explain(scene, pixel)``.
    pixel: (column, row), whole numbers from the bottom left of the full frame; with ``rows="top"`` from the top left.
    shading, samples: as in ``cast``.
    Raises InputError, in one line, for a pixel outside of the frame; TypeError for a camera or shapes of another type.
    """
    scene, pixel = Scene.given_with(camera, shapes, pixel, "explain")
    position = numbers(pixel, "pixel")
    if position.shape != (2,) or not (np.isfinite(position) & (position == np.floor(position))).all():
        raise InputError(f"pixel is {shown(pixel)}: it must be (column, row), two whole numbers")
    column, row = position.astype(int).tolist()
    if word(rows, "rows", (BOTTOM, TOP)) == TOP:
        last, lowest = scene.camera.width - 1, scene.camera.height - 1
        if not (0 <= column <= last and 0 <= row <= lowest):
            corners = f"0,0 (top left) to {last},{lowest} (bottom right)"
            raise InputError(f"pixel {column},{row} is outside the frame: give {corners}")
        row = lowest - row
    time = scene.camera.pixel_time
    frame = None if time is None else float(np.asarray(time.frame_at(column + 0.5, row + 0.5)).ravel()[0])
    shading = word(shading, "shading", SHADINGS)
    then = scene.at(frame)
    return lesson(then.camera, then.shapes, column, row, shading=shading, samples=samples)
