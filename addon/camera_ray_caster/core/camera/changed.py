"""A camera moved to another pose, and the record of one with other settings."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ..arguments import chosen, number
from ..arguments import name as a_name
from ..cameras import find_model
from ..cameras.behind_port import behind
from ..cameras.parts.calibration import FILE
from ..cameras.parts.parameters import defaults_of, with_values
from ..cameras.parts.port_settings import PORT
from ..cameras.parts.port_settings import SETTINGS as PORTS
from ..cameras.parts.pose import pose_from, pose_matrix
from ..cameras.parts.settings import RECORD_FIELDS
from ..records import BlenderCamera, InputError
from . import pixel_time
from .completion import check_effect
from .setting_values import checked, declared_by
from .spherical_stereo import with_eye


def posed(camera, matrix):
    """Return a ``Camera`` with another pose. Raises InputError for an invalid matrix, and for a camera that
    moves while it is exposed.
    """
    check_still(camera, "pose")
    raw = replace(camera.record, matrix_world=pose_matrix(matrix))
    pose = pose_from(raw)
    model = with_eye(find_model(raw).from_blender(raw, camera.raster), raw, pose)
    others = {"motion": None, "next": None, "previous": None}
    return replace(camera, model=model, pose=pose, record=raw, aperture=model.aperture(raw, pose), **others)


def check_still(camera, remedy: str) -> None:
    """Raise InputError for a camera that moves while it is exposed."""
    if camera.motion is not None:
        raise InputError(f"camera {camera.name!r} moves from pixel to pixel: give camera.at(frame) another {remedy}")


def changed(camera, settings: Mapping[str, Any]) -> BlenderCamera:
    """Return the record of a ``Camera`` with other values of some settings; of its calibration file it keeps only the
    numbers.
    Raises InputError for what ``crc.camera`` refuses, and for a camera that moves while it is exposed.
    """
    check_still(camera, "settings")
    raw, others = camera.record, dict(settings)
    mode_now = raw.settings.get(pixel_time.MODE.name, pixel_time.NONE)
    mode = chosen(others.pop(pixel_time.MODE.name, mode_now), pixel_time.MODE.name, pixel_time.SETTINGS)
    name = a_name(others.pop("name", raw.name))
    frame = number(others.pop("frame", raw.settings.get("frame", 0.0)), "frame", pixel_time.LAST_FRAME)
    port = chosen(others.get(PORT.name, raw.settings.get(PORT.name, PORT.default)), PORT.name, PORTS)
    lens = find_model(replace(raw, settings={**raw.settings, PORT.name: PORT.default}))
    kind = behind(lens, port)
    declared = declared_by(kind, mode)
    explicit = checked(lens.key, declared, others)
    values = defaults_of(declared.values())
    values |= {**raw.settings, pixel_time.MODE.name: mode, "frame": frame, PORT.name: port}
    if values.get(FILE.name):
        values[FILE.name] = FILE.default
    now = {name: getattr(raw, name) if name in RECORD_FIELDS else values[name] for name in declared} | explicit
    for key in explicit:
        if key in declared:
            check_effect(lens.key, declared, now, declared[key])
    if port == PORT.default != raw.settings.get(PORT.name):
        values.pop(PORT.name)
        explicit.pop(PORT.name, None)
    return with_values(replace(raw, name=name, settings=values), explicit)
