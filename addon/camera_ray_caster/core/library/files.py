"""Cameras written to files of other programs, without Blender, under a path that may tell the format."""

import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import wraps
from itertools import chain
from math import pi
from pathlib import Path
from typing import Any, NamedTuple

from ..arguments import P, R, deprecated, number, shown, spelled
from ..arguments import folder as a_folder
from ..camera.camera import Camera
from ..camera.fit import region_of
from ..exports import EXPORT_FORMATS, export_files, find_format
from ..exports.file_writer import write
from ..exports.format import Content, Shot
from ..names import file_names
from ..programs import PROGRAMS
from ..programs.parts.program import in_words
from ..records import InputError


class Exported(NamedTuple):
    """What ``export`` has written."""

    paths: list[Path]
    """The files, sorted by name."""
    remarks: list[str]
    """What the files do not say of the cameras, one line each."""


_WRITERS = [program.export for program in PROGRAMS if program.export is not None and program.export.ending]
ENDINGS = {writer.ending: writer.key for writer in sorted(_WRITERS, key=lambda writer: -len(writer.ending))}
"""Formats of cameras by the ends of their files' names, the longest first; the first one that fits counts."""


def destination(
    path: str | os.PathLike[str], format: str | None, endings: Mapping[str, str]
) -> tuple[Path, str, str]:
    """Return the folder, the name of the file and the format of an export to a path; "" if the path is a folder, whose
    files have the format's own names. Raises InputError if neither path nor ``format`` tell the format.
    """
    file = a_folder(path)
    for ending, key in endings.items():
        if file.name.lower().endswith(ending) and spelled(format or key, [key]) == key:
            return file.parent, file.name, key
    if format is None:
        raise InputError(f"{file.name!r} does not end like the files of a format, {', '.join(endings)}: give format=")
    return file, "", format


def format_came_first(
    name: str, result: Callable[[Any], Any] = lambda done: done
) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Let a function of (data, path, format) take (format, data, folder) as before version 0.3, with a
    DeprecationWarning; the data were called ``name``, and the result was ``result`` of today's.
    """

    def decorated(function: Callable[P, R]) -> Callable[P, R]:
        @wraps(function)
        def call(*args: P.args, **kwargs: P.kwargs) -> R:
            by_name: Any = function
            if not (args and isinstance(args[0], str)) and not {name, "folder"} & kwargs.keys():
                return function(*args, **kwargs)
            deprecated(f"{function.__name__} takes ({name}, path, format=...)")
            old: dict[str, Any] = dict(zip(("format", name, "folder", "name"), args, strict=False)) | kwargs
            return result(by_name(old.pop(name), old.pop("folder"), **old))

        return call

    return decorated


@format_came_first("cameras")
def export(
    data: Camera | Sequence[Camera],
    path: str | os.PathLike[str],
    format: str | None = None,
    *,
    meters: float = 1.0,
    target: Camera | None = None,
    fit: Any = False,
) -> Exported:
    """Write cameras to a file or a folder, for another program; return the paths and remarks.

    data: a camera, or several. Those with the same name are one camera that moves: see ``name`` and ``frame`` of
        ``crc.camera``.
    path: a file, whose ending tells the format, or with ``format`` a folder.
    format: KEYS.
    meters: length of a unit, for formats with meters.
    fit: whether a lens that the format cannot represent is replaced by the nearest one that it can, with its error in
        pixels in the files and the remarks. In place of True: the part of the picture that counts, as ``within`` of
        ``crc.fit``, such as the largest angle from the viewing direction, in radians.
    target: for "stmap", the camera to whose picture the maps lead; default the perspective of the same lens.

    All files are written or none. Raises InputError, in one line, for an unknown format, a camera that the format
    cannot represent (it names the formats that can), two cameras of one name and frame, a unit without length, and a
    folder that cannot be written.
    """
    cameras = [data] if isinstance(data, Camera) or not isinstance(data, Iterable) else list(data)
    for camera in (*cameras, *([] if target is None else [target])):
        if not isinstance(camera, Camera):
            raise TypeError(f"export takes cameras, not {type(camera).__name__}")
    if not cameras:
        raise InputError("there is no camera to export: give one or more")
    folder, name, key = destination(path, format, ENDINGS)
    chosen = find_format(key)
    if target is not None and not chosen.takes_target:
        raise InputError(f"format {chosen.key} has no target camera: only maps have a target")
    unit = number(meters, "meters", 1e12)
    if unit <= 0:
        raise InputError(f"meters is {shown(meters)}: it must be above 0, the length of a unit")
    region = (pi if fit else None) if isinstance(fit, bool) else fit
    if region is not None:
        region_of(cameras[0], region, "fit")
    names = file_names(camera.name for camera in cameras)
    shots = [Shot(names[camera.name], _frame(camera), camera, unit, target) for camera in cameras]
    if len({shot.stem for shot in shots}) < len(shots):
        raise InputError("two cameras have one name and one frame: give them names (name=) or frames (frame=)")
    files, remarks = export_files(chosen.key, sorted(shots, key=lambda shot: shot.frame), region)
    return Exported(write(_named(files, name) if name else files, folder), remarks)


_KEYS = in_words([f'"{export_format.key}"' for export_format in EXPORT_FORMATS])
export.__doc__ = (export.__doc__ or "").replace("KEYS", _KEYS)


def _named(files: Iterator[tuple[str, Content]], name: str) -> Iterator[tuple[str, Content]]:
    """Yield the files of an export, a single one under another name. Raises InputError if none of several has it."""
    names = []
    first = next(files)
    for file_name, content in chain([first, second] if (second := next(files, None)) else [(name, first[1])], files):
        names.append(file_name)
        yield file_name, content
    if name not in names:
        raise InputError(f"the export has {len(names)} files: give a folder in place of {name!r}, and format=")


def _frame(camera: Camera) -> float:
    frame: Any = camera.record.settings.get("frame", 0.0)
    return float(frame)
