"""The add-on's own camera.json and report.json: any model with all of its settings.

A camera that changes from frame to frame has one lens for each frame, named CAMERA FRAME. The size of the picture is
that of the frame, whose shape the camera had.
"""

from typing import Any

import numpy as np

from ..cameras import MODELS
from ..cameras.parts.calibration import FROM_FILE
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, one_of_several
from .parts.placed import FROM_BLENDER, Placed, checked
from .parts.program import FileWriter, ProgramFiles

FORMAT = "camera_ray_caster camera"
RECORD = "record"


def looks(document: Document) -> bool:
    entries = document.entries
    return _is_camera(entries) or (entries.has(RECORD) and entries.part(RECORD).has("settings"))


def _is_camera(entries: Fields) -> bool:
    return entries.has("format") and entries.text("format") == FORMAT


def read(document: Document) -> list[Lens]:
    entries = document.entries
    if not _is_camera(entries):
        return [_lens(entries)]
    if not entries.has("cameras"):
        raise document.refusal("its cameras are missing: export it again")
    lenses: list[Lens] = []
    for camera in entries.parts("cameras"):
        name, common = camera.text("name"), camera.part("all_frames")
        common = common.labeled(name)
        by_frame = [(frame, one_of_several(name, _lens, common, frame)) for frame in camera.parts("frames")]
        if len({repr(lens[1:]) for _, lens in by_frame}) > 1:
            lenses += [lens._replace(name=f"{name} {frame.number('frame'):g}") for frame, lens in by_frame]
        else:
            lenses += [lens for _, lens in by_frame[:1]]
    return lenses


def poses(document: Document) -> list[Placed]:
    if not _is_camera(document.entries):
        raise document.refusal("it is a report, which has a lens and no poses that are read: export a camera.json")
    placed = []
    for camera in document.entries.parts("cameras"):
        name, common = camera.text("name"), camera.part("all_frames").part(RECORD)
        for frame in camera.parts("frames"):
            record = common.merged(frame.part(RECORD)).labeled(name)
            matrix = np.reshape(record.matrix("matrix_world", 16), (4, 4))
            sizes = np.linalg.norm(matrix[:3, :3], axis=0)
            matrix[:3, :3] /= np.where(sizes > 0, sizes, 1)
            pose = checked(document, matrix, record.said("matrix_world")) @ FROM_BLENDER
            placed.append(Placed(name, name, frame.number("frame"), pose))
    return placed


def _lens(*parts: Fields) -> Lens:
    """Return the lens of a record, of which each part holds some entries."""
    record, settings, name = Fields(parts[0].document, {}), Fields(parts[0].document, {}), parts[0].label
    for fields in (fields.part(RECORD) for fields in parts):
        record, settings = record.merged(fields), settings.merged(fields.part("settings"))
    blender_type = settings.text("panorama_type") if record.text("type") == "PANO" else record.text("type")
    kind = record.text("model") or blender_type or None
    models = {model.key: model for model in MODELS}
    model = models[record.document.one_of(kind, f"model of {name or 'the camera'}", models)]
    values = record.merged(settings).values
    names = [setting.name for setting in model.SETTINGS if setting not in FROM_FILE]
    if missing := [name for name in names if name not in values]:
        raise record.document.refusal(f"it has no {missing[0]}: export it again")
    return Lens(name, model.key, {name: _restored(values[name]) for name in names})


def _restored(value: Any) -> Any:
    """Return a value as it was before it became one of JSON, which has no infinite numbers."""
    if isinstance(value, dict) and list(value) == ["float"]:
        return float(value["float"])
    return [_restored(item) for item in value] if isinstance(value, list) else value


PROGRAM = ProgramFiles(
    "this add-on", "camera.json, report.json", looks, marks="format cameras all_frames frames record settings",
    reads="every model", lost="nothing", read=read, poses=poses,
    export=FileWriter("json", "Camera JSON", "", ending=".json"),
)  # fmt: skip
