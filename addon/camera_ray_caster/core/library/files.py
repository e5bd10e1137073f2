"""Cameras written to files of other programs, without Blender."""

from __future__ import annotations

import os
from collections.abc import Sequence
from math import pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..arguments import folder as a_folder
from ..arguments import number, shown
from ..camera.camera import Camera
from ..exports import FORMATS, find_format
from ..exports import export as files_of
from ..exports.format import Shot
from ..exports.writing import write
from ..names import file_names
from ..programs.parts.program import in_words
from ..records import InputError


class Exported(NamedTuple):
    """What ``export`` has written."""

    paths: list[Path]
    """The files, sorted by name."""
    remarks: list[str]
    """What the files do not say of the cameras, one line each."""


def export(
    format: str,
    cameras: Camera | Sequence[Camera],
    folder: str | os.PathLike[str],
    *,
    meters: float = 1.0,
    target: Camera | None = None,
    fit: bool | float = False,
) -> Exported:
    """Write cameras into a folder, for another program; return the paths and remarks.

    format: KEYS.
    cameras: a camera, or several. Those of one name are one camera at several frames: see ``name`` and ``frame`` of
        ``crc.camera``.
    meters: length of a unit, for formats with meters.
    fit: whether a lens that the format cannot represent is replaced by the nearest one that it can, with its error in
        pixels in the files and the remarks; a number is the largest angle from the viewing direction, in radians, of
        the pixels that count. See ``crc.fit``.
    target: for "stmap", the camera to whose picture the maps lead; default the perspective of the same lens.

    All files are written or none. Raises InputError, in one line, for an unknown format, a camera that the format
    cannot represent (it names the formats that can), two cameras of one name and frame, a unit without length, and a
    folder that cannot be written.
    """
    given = [cameras] if isinstance(cameras, Camera) else list(cameras)
    for one in (*given, *([] if target is None else [target])):
        if not isinstance(one, Camera):
            raise TypeError(f"export takes cameras, not {type(one)}")
    if not given:
        raise InputError("there is no camera to export: give one or more")
    chosen = find_format(format)
    if target is not None and not chosen.takes_target:
        raise InputError(f"format {format} has no target camera: only maps have a target")
    unit = number(meters, "meters", 1e12)
    if unit <= 0:
        raise InputError(f"meters is {shown(meters)}: it must be above 0, the length of a unit")
    is_angle = isinstance(fit, int | float | np.integer | np.floating) and 0 < fit <= pi
    if not isinstance(fit, bool) and not is_angle:
        raise InputError(f"fit is {shown(fit)}: it must be True, False or an angle above 0, up to pi")
    angle = (pi if fit else None) if isinstance(fit, bool) else float(fit)
    names = file_names(one.name for one in given)
    shots = [Shot(names[one.name], _frame(one), one, unit, target) for one in given]
    if len({shot.stem for shot in shots}) < len(shots):
        raise InputError("two cameras have one name and one frame: give them names (name=) or frames (frame=)")
    files, remarks = files_of(format, sorted(shots, key=lambda shot: shot.frame), angle)
    return Exported(write(files, a_folder(folder)), remarks)


_KEYS = in_words([f'"{one.key}"' for one in FORMATS])
export.__doc__ = (export.__doc__ or "").replace("KEYS", _KEYS)


def _frame(camera: Camera) -> float:
    frame: Any = camera.record.settings.get("frame", 0.0)
    return float(frame)
