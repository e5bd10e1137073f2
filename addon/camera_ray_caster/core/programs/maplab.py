"""The camera rigs (ncamera) of maplab and SVO, in YAML: cameras with their type, intrinsics, distortion and pose.

The center of the first pixel is (0, 0). The distortion fisheye is the field-of-view model. T_B_C leads from the camera
to the rig's body; in maplab's files of all sensors, T_B_S from the rig to the body of all.
References: maplab documentation, Sensor calibration; SVO's rpg_svo_pro, calibration files.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..text_forms.content import flat
from .kalibr import DISTORTIONS, SHAPES, spelled
from .parts.document import Document, Lens, mapping, matrix, one_of_several
from .parts.placed import Placed, pose_of

KINDS = {"pinhole": "pinhole", "unifiedprojection": "omni"}
BENDS = {"fisheye": "fov", "rationalradtan": "radialtangential8", "radtan": "radtan", "equidistant": "equidistant"}
"""Kalibr's words for a type of camera and of distortion, by their plain names."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    cameras = document.entries.get("cameras")
    if not isinstance(cameras, list) or not cameras:
        return None
    inside = [mapping(mapping(one).get("camera")) for one in cameras]
    if not all({"type", "intrinsics"} <= one.keys() for one in inside):
        return None
    return [one_of_several(name, _lens, document, name, one)
            for name, one in zip(_names(inside), inside, strict=True)]  # fmt: skip


def poses(document: Document) -> list[Placed] | None:
    """Return the poses of the rigs' cameras in the body; None of any other file. Raises InputError."""
    entries = document.entries
    sensors = entries.get("sensors")
    rigs = [entries] if "cameras" in entries else [mapping(one) for one in sensors] if isinstance(sensors, list) else []
    rigs = [one for one in rigs if isinstance(one.get("cameras"), list)]
    if not rigs or not all("T_B_C" in mapping(camera) for rig in rigs for camera in rig["cameras"]):
        return None
    extrinsics = entries.get("extrinsics")
    known = list(map(mapping, extrinsics)) if isinstance(extrinsics, list) else []
    bodies = {str(one["sensor_id"]): one.get("T_B_S") for one in known if "sensor_id" in one}
    placed = []
    for rig in rigs:
        id_ = str(rig.get("id"))
        body = pose_of(document, bodies[id_], f"T_B_S of {id_}") if id_ in bodies else np.eye(4)
        names = _names([mapping(one.get("camera")) for one in rig["cameras"]])
        placed += [Placed(name, "", None, body @ pose_of(document, camera["T_B_C"], f"T_B_C of {name}"))
                   for name, camera in zip(names, rig["cameras"], strict=True)]  # fmt: skip
    if len({one.camera for one in placed}) < len(placed):
        raise document.refusal("its rigs have cameras of one name: give each a label of its own")
    return placed


def _names(cameras: list[dict]) -> list[str]:
    return [str(one.get("label") or f"cam{number}") for number, one in enumerate(cameras)]


def _lens(document: Document, name: str, camera: dict) -> Lens:
    def numbers(value: Any, of: str, count: int) -> list[float]:
        return document.numbers(flat(value, f"{of} of {name}", document.path), f"{of} of {name}", count)

    kind = KINDS[document.one_of(spelled(camera["type"]), f"type of {name}", KINDS)]
    model, shape = SHAPES[kind]
    given = mapping(camera.get("distortion"))
    word = spelled(given.get("type", "none"))
    terms: tuple[str, ...] = ()
    if word not in ("none", ""):
        known = [one for one, bend in BENDS.items() if (kind, bend) in DISTORTIONS]
        model, terms = DISTORTIONS[kind, BENDS[document.one_of(word, f"distortion of {name}", known)]]
    first = numbers(camera["intrinsics"], "intrinsics", len(shape) + 4)
    rest: list[float] = numbers(given.get("parameters"), "distortion parameters", len(terms)) if terms else []
    size = [document.number(camera, side) if side in camera else None for side in ("image_width", "image_height")]
    settings = dict(zip((*shape, *terms), (*first[: len(shape)], *rest), strict=True))
    return Lens(name, model, document.size(*size) | matrix(*first[len(shape) :]) | settings)
