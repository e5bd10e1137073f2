"""The add-on's own camera.json and report.json: any model with all of its settings.

A camera that changes from frame to frame has one lens for each frame, named CAMERA FRAME. The size of the picture is
that of the frame, whose shape the camera had.
"""

from __future__ import annotations

from typing import Any

from ..cameras import MODELS
from ..cameras.parts.calibration import FROM_FILE
from .parts.document import Document
from .parts.lens import Lens, mapping, one_of_several

FORMAT = "camera_ray_caster camera"
RECORD = "record"


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    entries = document.raw
    if entries.get("format") != FORMAT:
        is_report = isinstance(mapping(entries.get(RECORD)).get("settings"), dict)
        return [_lens(document, "", entries)] if is_report else None
    cameras = entries.get("cameras")
    if not isinstance(cameras, list):
        raise document.refusal("its cameras are missing: export it again")
    lenses: list[Lens] = []
    for camera in map(mapping, cameras):
        frames = camera.get("frames")
        common, name = mapping(camera.get("all_frames")), str(camera.get("name", ""))
        each = [mapping(frame) for frame in (frames if isinstance(frames, list) else [])]
        own = [(one.get("frame"), one_of_several(name, _lens, document, name, common, one)) for one in each]
        if len({repr(lens[1:]) for _, lens in own}) > 1:
            lenses += [lens._replace(name=f"{name} {frame:g}") for frame, lens in own]
        else:
            lenses += [lens for _, lens in own[:1]]
    return lenses


def _lens(document: Document, name: str, *parts: dict) -> Lens:
    """Return the lens of a record, of which each part holds some entries."""
    record: dict[str, Any] = {}
    settings: dict[str, Any] = {}
    for part in (mapping(part.get(RECORD)) for part in parts):
        record |= part
        settings |= mapping(part.get("settings"))
    own = settings.get("panorama_type") if record.get("type") == "PANO" else record.get("type")
    kind = record.get("model") or own
    models = {model.key: model for model in MODELS}
    model = models[document.one_of(kind, f"model of {name or 'the camera'}", models)]
    values = {**record, **settings}
    names = [setting.name for setting in model.SETTINGS if setting not in FROM_FILE]
    if missing := [one for one in names if one not in values]:
        raise document.refusal(f"it has no {missing[0]}: export it again")
    return Lens(name, model.key, {one: _restored(values[one]) for one in names})


def _restored(value: Any) -> Any:
    """Return a value as it was before it became one of JSON, which has no infinite numbers."""
    if isinstance(value, dict) and list(value) == ["float"]:
        return float(value["float"])
    return [_restored(one) for one in value] if isinstance(value, list) else value
