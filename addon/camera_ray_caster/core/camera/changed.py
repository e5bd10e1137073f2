"""The record of a camera with other settings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ..arguments import chosen, number
from ..arguments import name as a_name
from ..cameras import find_model
from ..cameras.behind_port import behind
from ..cameras.parts.calibration import FILE
from ..cameras.parts.port_settings import PORT
from ..cameras.parts.port_settings import SETTINGS as PORTS
from ..cameras.parts.settings import RECORD_FIELDS
from ..records import BlenderCamera
from . import pixel_time
from .completion import check_effect
from .posed import check_still
from .setting_values import checked, declared_by


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
    values = {name: setting.default for name, setting in declared.items() if name not in RECORD_FIELDS}
    values |= {**raw.settings, pixel_time.MODE.name: mode, "frame": frame, PORT.name: port}
    if values.get(FILE.name):
        values[FILE.name] = FILE.default
    now = {name: getattr(raw, name) if name in RECORD_FIELDS else values[name] for name in declared} | explicit
    for key in explicit:
        if key in declared:
            check_effect(lens.key, declared, now, declared[key])
    fields = {key: value for key, value in explicit.items() if key in RECORD_FIELDS}
    values |= {key: value for key, value in explicit.items() if key not in RECORD_FIELDS}
    if port == PORT.default != raw.settings.get(PORT.name):
        values.pop(PORT.name)
    return replace(raw, name=name, **fields, settings=values)
