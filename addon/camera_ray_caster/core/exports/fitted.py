"""Cameras that a format cannot represent, replaced by the nearest ones that it can, with their error in its files.

A lens is fitted to each model of the format (see ``camera.fit``), with the terms that the format stores. The one that
sees most is taken, and among those the one that errs least in the mean. Poses stay as they are.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..camera.fit import HELD, HELD_OF, Fit, fit_model, region_of
from ..cameras import MODELS
from ..cameras.parts.calibration import CALIBRATION
from ..programs.parts.lens import MATRIX
from ..records import InputError
from .format import Content, Format, Shot

WORST_FIT = 0.05
"""Fraction of the frame: a fit with larger errors is refused."""

FIT, FIT_WITHIN = "Fit Nearest Lens", "Within"
"""The labels of the options in the window."""

Refusal = Callable[[Format, Shot], str | None]


def with_fits(chosen: Format, shots: Sequence[Shot], within: Any, refusal: Refusal) -> tuple[list[Shot], list[str]]:
    """Return the shots, with fitted cameras where the format refuses a lens, and a remark on each of those lenses.

    within: the part of the picture that counts: see ``within`` of ``crc.fit``. Raises InputError if no
    lens of the format is near.
    """
    known: dict[str, tuple[Camera, str]] = {}
    fitted_shots = []
    for shot in shots:
        camera = shot.camera
        if refusal(chosen, shot) is None or not can_fit(chosen, camera):
            fitted_shots.append(shot)
            continue
        key = repr((type(camera.model), camera.settings, camera.raster))
        if key not in known:
            nearest = _nearest(chosen, shot, within, refusal)
            known[key] = nearest.camera, _remark(shot, nearest, within)
        fitted, remark = known[key]
        fitted_shots.append(replace(shot, camera=_lent(camera, fitted), fit=remark))
    return fitted_shots, list(dict.fromkeys(shot.fit for shot in fitted_shots if shot.fit))


def can_fit(chosen: Format, camera: Camera) -> bool:
    """Whether lenses of a format may be fitted to a camera, near or not."""
    return bool(getattr(chosen, "table", None)) and camera.pixel_time is None and camera.model.central


def _lent(camera: Camera, fitted: Camera) -> Camera:
    """Return a camera with the lens of another one."""
    return replace(camera, model=fitted.model, record=replace(fitted.record, name=camera.record.name))


def _nearest(chosen: Format, shot: Shot, within: Any, refusal: Refusal) -> Fit:
    camera, terms = shot.camera, dict[str, set[str]]()
    for key, names in getattr(chosen, "table", {}).values():
        terms.setdefault(key, set()).update(names)
    region = region_of(camera, within, "fit")
    fits: list[Fit] = []
    for kind in MODELS:
        if kind.key not in terms or not set(CALIBRATION) <= set(kind.SETTINGS):
            continue
        free = {*MATRIX, *terms[kind.key]} - HELD - HELD_OF.get(kind.key, set())
        try:
            fitted = fit_model(camera, kind, region, free)
        except InputError:  # this model sees too little
            continue
        if refusal(chosen, replace(shot, camera=_lent(camera, fitted.camera))) is None:
            fits.append(fitted)
    lens = f"{camera.model.label} of camera {camera.name!r}"
    if not fits:
        raise InputError(
            f"no lens of {chosen.label} can be fitted to the {lens}: fit less of the picture "
            f"({FIT_WITHIN}, --fit DEGREES), or choose another format"
        )
    best = min(fits, key=lambda fit: (fit.unseen, fit.mean))
    if best.worst > WORST_FIT * max(camera.raster.size):
        raise InputError(
            f"no lens of {chosen.label} is like the {lens}: the nearest one, {best.summary}; fit less of the picture "
            f"({FIT_WITHIN}, --fit DEGREES), or choose another format"
        )
    return best


def _remark(shot: Shot, fit: Fit, within: Any) -> str:
    where = ", within a part of the picture"
    if np.ndim(within) == 0:
        where = f", within {within * 180 / pi:.4g} degrees of the viewing direction" if within < pi else ""
    return f"{shot.name}: fitted to its {shot.camera.model.label}{where}: {fit.summary}"


def in_comments(remarks: Sequence[str]) -> str:
    """Return remarks as lines of comments."""
    return "".join(f"# {line}\n" for line in remarks)


def with_heads(files: Iterator[tuple[str, Content]], remarks: Sequence[str]) -> Iterator[tuple[str, Content]]:
    """Yield files with remarks as comments in the head of text; JSON, which has no comments, has them in its frames."""
    head = in_comments(remarks)
    for name, content in files:
        if isinstance(content, str) and not name.endswith(".json"):
            start = content.index("---\n") + 4 if content.startswith("%YAML") else 0
            content = content[:start] + head + content[start:]
        yield name, content
