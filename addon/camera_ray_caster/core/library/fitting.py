"""The camera of another model nearest to a camera, without Blender."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np

from ..arguments import shown, unknown
from ..camera.camera import Camera
from ..camera.fit import Fit, fit_model, within
from ..records import InputError
from .models import models
from .values import plain


def fit(camera: Camera, model: str, region=None, free: Collection[str] | None = None, **settings: Any) -> Fit:
    """Return the camera of another model whose pixels are nearest to a camera's, by least squares.

    model: the key of the model: see ``models``.
    region: the part of the picture that counts: (x0, y0, x1, y1), columns x0 to x1 - 1 and rows y0 to y1 - 1 from the
        bottom; a bool array (rows, columns); or a number, the largest angle from the viewing direction, in radians.
        Default: all.
    free: names of the numbers to fit, of those in ``parameters``. Default: all on which the picture depends, but for
        skew and other terms that most lenses do not have (of a pinhole: k4 to k6, thin prism and tilt), and for the
        given ``settings``.
    settings: settings of the model from which the search starts, and which it holds unless they are in ``free``.

    The result has the fitted ``camera``, at the same place, its fitted ``parameters`` with their ``covariance``, the
    ``worst`` and ``mean`` distance of pixels, the ``residual`` of each, and ``summary``, one line. A map between the
    two pictures shows the rest: ``export("stmap", camera, folder, target=fit.camera)``.

    Raises InputError, in one line, for a model or a setting that does not exist, for cameras whose rays do not leave
    one eye, for pixels with times of their own, and if the model sees too few of the region's rays.
    """
    if not isinstance(camera, Camera):
        raise TypeError(f"fit takes a camera, not {type(camera)}")
    known = models()
    if not isinstance(model, str) or model not in known:
        raise unknown("model", model, known)
    declared = {one.name: one for one in known[model].SETTINGS}
    for name in settings:
        if name not in declared:
            raise unknown(f"setting of {model}", name, declared)
    given = {name: plain(declared[name], value) for name, value in settings.items()}
    try:
        names = {free} if isinstance(free, str) else None if free is None else set(free)
    except TypeError as error:
        raise InputError(f"free is {shown(free)}: it must be names of parameters of {model}") from error
    return fit_model(camera, known[model], _region(camera, region), names, given)


def _region(camera: Camera, region) -> np.ndarray | None:
    """Return a region as a bool array (rows, columns); None for all."""
    width, height = camera.raster.size
    if region is None:
        return None
    if isinstance(region, int | float | np.number) and not isinstance(region, bool):
        if not 0 < region <= np.pi:
            raise InputError(f"region is {shown(region)}: as an angle it must be above 0, up to pi")
        return within(camera, float(region))
    try:
        found = np.asarray(region)
    except ValueError:  # lists of unequal length
        found = np.zeros(0)
    if found.dtype == bool and found.shape == (height, width):
        return found
    if found.shape == (4,) and found.dtype.kind in "iu":
        x0, y0, x1, y1 = found.tolist()
        if 0 <= x0 < x1 <= width and 0 <= y0 < y1 <= height:
            result = np.zeros((height, width), bool)
            result[y0:y1, x0:x1] = True
            return result
    raise InputError(
        f"region is {shown(region)}: it must be (x0, y0, x1, y1) within the frame of {width} x {height} pixels, a bool "
        f"array of shape ({height}, {width}), or an angle in radians"
    )
