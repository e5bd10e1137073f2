"""The camera of another model nearest to a camera, without Blender."""

from collections.abc import Collection
from typing import Any

from ..arguments import chosen, deprecated, shown, unknown
from ..camera.camera import Camera
from ..camera.fit import Fit, fit_model, region_of
from ..camera.setting_values import plain
from ..records import InputError
from .models import models


def fit(
    camera: Camera, model: str, *others: Any, within: Any = None, free: Collection[str] | None = None, **settings: Any
) -> Fit:
    """Return the camera of another model whose pixels are nearest to a camera's, by least squares.

    model: the key of the model: see ``models``.
    within: the part of the picture that counts: (x0, y0, x1, y1), columns x0 to x1 - 1 and rows y0 to y1 - 1 from the
        bottom; a bool array (rows, columns); or a number, the largest angle from the viewing direction, in radians.
        Default: all.
    free: names of the numbers to fit, of those in ``parameters``. Default: all on which the picture depends, but for
        skew and other terms that most lenses do not have (of a pinhole: k4 to k6, thin prism and tilt), and for the
        given ``settings``.
    settings: settings of the model from which the search starts, and which it holds unless they are in ``free``.

    The result has the fitted ``camera``, at the same place, its fitted ``parameters`` with their ``covariance``, the
    ``worst`` and ``mean`` distance of pixels, the ``residual`` of each, and ``summary``, one line. A map between the
    two pictures shows the rest: ``export(camera, folder, "stmap", target=fit.camera)``.

    Raises InputError, in one line, for a model or a setting that does not exist, for cameras whose rays do not leave
    one eye, for pixels with times of their own, and if the model sees too few of the region's rays.
    """
    if not isinstance(camera, Camera):
        raise TypeError(f"fit takes a camera, not {type(camera).__name__}")
    old = dict(zip(("within", "free"), others, strict=False))
    if "region" in settings:
        old["within"] = settings.pop("region")
    if old:
        deprecated(f"fit takes keywords here: {', '.join(f'{name}=' for name in old)}")
        return fit(camera, model, **{"within": within, "free": free, **settings, **old})
    known = models()
    model = chosen(model, "model", known)
    declared = {setting.name: setting for setting in known[model].SETTINGS}
    for name in settings:
        if name not in declared:
            raise unknown(f"setting of {model}", name, declared)
    values = {name: plain(declared[name], value) for name, value in settings.items()}
    try:
        names = {free} if isinstance(free, str) else None if free is None else set(free)
    except TypeError as error:
        raise InputError(f"free is {shown(free)}: it must be names of parameters of {model}") from error
    return fit_model(camera, known[model], None if within is None else region_of(camera, within), names, values)
