"""The camera rigs (ncamera) of maplab and SVO, in YAML: cameras with their type, intrinsics and distortion.

The center of the first pixel is (0, 0). The distortion fisheye is the field-of-view model.
References: maplab documentation, Sensor calibration; SVO's rpg_svo_pro, calibration files.
"""

from __future__ import annotations

from typing import Any

from ..parts.filestorage import flat
from .document import Document, Lens, mapping, matrix, one_of_several
from .kalibr import DISTORTIONS, SHAPES, spelled

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
    names = [str(one.get("label") or f"cam{number}") for number, one in enumerate(inside)]
    return [one_of_several(name, _lens, document, name, one) for name, one in zip(names, inside, strict=True)]


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
