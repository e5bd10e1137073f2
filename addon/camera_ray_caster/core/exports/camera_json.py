"""The add-on's own file, camera.json: complete records of cameras by frame, as text and numbers with all their bits.

The main part is the record that a camera is made of, under Blender's own names, for each frame. If pixels have their
own times, there are also the records at the times between which the camera is interpolated. ``camera_from_json`` makes
the camera from these records, by the same steps as ``read_camera``: its rays are the same, bit for bit. Values that
follow from a record are stored next to it: K, pose, the image plane, the formula. Values that all frames share are
stored once.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from ..arguments import keywords, number, shown, word
from ..camera import pixel_time
from ..camera.build import camera_from
from ..camera.camera import Camera
from ..camera.facts import CONVENTIONS, camera_facts
from ..cameras.parts.calibration import FILE
from ..motion.evaluations import Motion
from ..motion.interpolation import TimeInterval
from ..records import BlenderCamera, InputError, no_shapes
from ..text_forms.json_text import as_text
from ..version import VERSION
from .format import Format, Shot
from .json_values import merged, plain, restored, shared, without

FORMAT = "camera_ray_caster camera"
NUMBER = 1
"""Version number of the format: a reader refuses a larger one."""

RECORD = "record"
"""Name of the entry with a camera's record."""

FRAME = "frame"
"""Name of the setting that holds the frame at which a record was read."""


ACCURACY = "tolerance", "estimated", "unresolved", "measured", "appearance"
"""Fields of ``Motion`` beside its evaluations and intervals."""


class CameraJson(Format):
    """One file with all cameras and frames."""

    key = "json"
    label = "Camera JSON"
    description = "camera.json: every model with all its settings and poses; crc.camera_from_json computes its rays"

    def refusal(self, shot):
        return None

    def omissions(self, shot):
        return []

    def files(self, shots):
        yield "camera.json", _text(shots)


def camera_to_json(camera: Camera) -> str:
    """Return a camera as the text of a camera.json with one frame, the one at which it was read. Raises TypeError for
    anything but a camera.
    """
    if not isinstance(camera, Camera):
        raise TypeError(f"camera_to_json takes a camera as it is read, not {type(camera).__name__}")
    return _text([Shot(camera.name, float(camera.record.settings.get(FRAME, 0.0)), camera)])


@keywords
def camera_from_json(path_or_text: str | Path, frame: float | None = None, *, camera: str | None = None) -> Camera:
    """Return a camera of a camera.json or a report.json, given by its path or its text. Blender is not needed.

    The rays are those of the camera that was written, bit for bit, on the same machine and numpy version.

    ``frame``: a frame in the file; default the first. ``camera``: the camera's name in the file, or the view's name in
    the report of a stereo scene; default the only camera.
    Raises InputError, in one line, for a file that cannot be read or is of another kind, and for an unknown camera or
    frame.
    """
    text = path_or_text if isinstance(path_or_text, str) and path_or_text.lstrip()[:1] == "{" else _read(path_or_text)
    try:
        document = restored(json.loads(text))
        if "record" in document:
            return _of_report(document, frame, camera)
        if document.get("format") != FORMAT:
            raise InputError(
                "this is neither a camera.json nor a report.json of the Camera Ray Caster: export a camera.json"
            )
        if document["format_version"] > NUMBER:
            raise InputError(f"this camera.json is of version {document['format_version']}: update the add-on")
        return _camera(_frame(_chosen(document["cameras"], camera), frame))
    except InputError:
        raise
    except (ValueError, TypeError, LookupError, AttributeError, ArithmeticError, RecursionError) as error:
        raise InputError(f"this camera.json is damaged ({type(error).__name__}: {error}): export it again") from error


def _of_report(report: Mapping[str, Any], frame: float | None, view: str | None) -> Camera:
    """Return the camera of a report.json, or of one of its views."""
    views = report.get("views") or {}
    if view is None and len(views) > 1:
        raise InputError(f"this report has the cameras of the views {', '.join(views)}: choose one by its name")
    if view is not None and view not in views:
        raise InputError(f"this report has no view {shown(view)}" + (f", only {', '.join(views)}" if views else ""))
    record = report["record"] if view is None else views[view]
    if record is None or RECORD not in record:
        reason = "whose time is an image, or whose table of rays is large"
        raise InputError(f"this report has no record of its camera, {reason}: export a camera.json")
    if frame not in (None, report[FRAME]):
        raise InputError(f"this report is of frame {report[FRAME]:g}, not {shown(frame)}")
    return _camera(record)


def _text(shots: Sequence[Shot]) -> str:
    cameras = []
    for name in dict.fromkeys(shot.name for shot in shots):
        by_frame = {shot.frame: plain(_said(shot)) for shot in shots if shot.name == name}
        common = shared(list(by_frame.values()))
        frames = [{FRAME: frame, **without(entry, common)} for frame, entry in by_frame.items()]
        cameras.append({"name": name, "all_frames": common, "frames": frames})
    document = {"format": FORMAT, "format_version": NUMBER, "version": VERSION, "conventions": CONVENTIONS}
    return as_text(document | {"cameras": cameras})


def _said(shot: Shot) -> dict[str, Any]:
    """Return the entry of a camera at a frame."""
    camera = shot.camera
    return {"meters": shot.meters, "camera": camera_facts(camera), **recorded(camera)}


def recorded(camera: Camera) -> dict[str, Any]:
    """Return a camera's ``record`` in JSON's types.

    A camera that moves from pixel to pixel also has ``evaluations``, ``intervals`` and other facts about its
    ``motion``.
    """
    entry: dict[str, Any] = {"record": plain(_record(camera))}
    motion = camera.motion
    if isinstance(motion, Motion):
        entry["evaluations"] = [
            {FRAME: frame, "record": without(plain(_record(_of_one_time(state))), entry["record"])}
            for frame, (state, _) in sorted(motion.states.items())
        ]
        entry["intervals"] = plain([interval.frames for interval in motion.intervals])
        entry["motion"] = plain({name: getattr(motion, name) for name in ACCURACY})
    return entry


def _of_one_time(camera: Camera) -> Camera:
    """Return a camera whose record has no settings of pixel times: they are stored once for the picture."""
    times = {setting.name for settings in pixel_time.SETTINGS.values() for setting in settings}
    settings = {name: value for name, value in camera.record.settings.items() if name not in times}
    return replace(camera, record=replace(camera.record, settings=settings | {pixel_time.MODE.name: pixel_time.NONE}))


def _record(camera: Camera) -> dict[str, Any]:
    """Return the record of a camera. It contains the numbers of a calibration file, but not the file's path."""
    record = asdict(replace(camera.record, settings={}))
    settings = dict(camera.record.settings)
    return record | {"settings": settings | ({FILE.name: ""} if FILE.name in settings else {})}


def _camera(entry: Mapping[str, Any]) -> Camera:
    """Return the camera of an entry."""
    camera = camera_from(BlenderCamera(**entry["record"]))
    if "evaluations" not in entry:
        return camera
    states = {}
    for evaluation in entry["evaluations"]:
        record = BlenderCamera(**merged(entry["record"], evaluation["record"]))
        states[evaluation[FRAME]] = replace(camera_from(record), pixel_time=camera.pixel_time), no_shapes()
    accuracy: dict[str, Any] = {
        name: tuple(value) if isinstance(value, list) else value for name, value in entry["motion"].items()
    }
    accuracy["unresolved"] = tuple(map(tuple, accuracy["unresolved"]))
    intervals = tuple(TimeInterval.of(states, tuple(frames)) for frames in entry["intervals"])
    return replace(camera, motion=Motion(intervals, states, **accuracy))


def _chosen(cameras: Sequence[Mapping[str, Any]], name: str | None) -> Mapping[str, Any]:
    name = None if name is None else word(name, "camera")
    chosen = [camera for camera in cameras if name in (None, camera["name"])]
    if len(chosen) != 1:
        known = ", ".join(repr(camera["name"]) for camera in cameras)
        raise InputError(f"this camera.json has the cameras {known}: set camera to one of them")
    return chosen[0]


def _frame(camera: Mapping[str, Any], frame: float | None) -> dict[str, Any]:
    frames = {entry[FRAME]: entry for entry in camera["frames"]}
    if not frames:
        raise InputError(f"camera {camera['name']!r} has no frame in this file: export it again")
    chosen = next(iter(frames)) if frame is None else number(frame, "frame", pixel_time.LAST_FRAME)
    if chosen not in frames:
        nearest = min(frames, key=lambda recorded_frame: abs(recorded_frame - chosen))
        raise InputError(
            f"camera {camera['name']!r} has no frame {shown(frame)} in this file: the nearest is {nearest:g}"
        )
    return merged(camera["all_frames"], frames[chosen])


def _read(path) -> str:
    try:
        return Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError, ValueError, TypeError) as error:
        reason = getattr(error, "strerror", None) or "it is not a text file"
        raise InputError(
            f"cannot read {shown(str(path))}: {reason}; give the path of a camera.json, or its text"
        ) from error
