"""COLMAP's cameras.txt: one line per camera, with its id, model, width, height and parameters.

The center of the first pixel is (0.5, 0.5).
Reference: COLMAP documentation, Output Format; Camera Models.
"""

from __future__ import annotations

import re

from .parts.document import Document, Lens, matrix, one_of_several

LINE = re.compile(r"\d+\s+[A-Z][A-Z_0-9]+(\s+[-+.\d]\S*){2}(\s|$)")
FISHEYE_TERMS, PINHOLE_TERMS = "k1 k2 k3 k4", "k1 k2 p1 p2"
MODELS = {
    "SIMPLE_PINHOLE": ("OPENCV_PINHOLE", "f cx cy"),
    "PINHOLE": ("OPENCV_PINHOLE", "fx fy cx cy"),
    "SIMPLE_RADIAL": ("OPENCV_PINHOLE", "f cx cy k1"),
    "RADIAL": ("OPENCV_PINHOLE", "f cx cy k1 k2"),
    "OPENCV": ("OPENCV_PINHOLE", f"fx fy cx cy {PINHOLE_TERMS}"),
    "FULL_OPENCV": ("OPENCV_PINHOLE", f"fx fy cx cy {PINHOLE_TERMS} k3 k4 k5 k6"),
    "SIMPLE_FISHEYE": ("OPENCV_FISHEYE", "f cx cy"),
    "FISHEYE": ("OPENCV_FISHEYE", "fx fy cx cy"),
    "SIMPLE_RADIAL_FISHEYE": ("OPENCV_FISHEYE", "f cx cy k1"),
    "RADIAL_FISHEYE": ("OPENCV_FISHEYE", "f cx cy k1 k2"),
    "OPENCV_FISHEYE": ("OPENCV_FISHEYE", f"fx fy cx cy {FISHEYE_TERMS}"),
    "THIN_PRISM_FISHEYE": ("THIN_PRISM_FISHEYE", f"fx fy cx cy {PINHOLE_TERMS} k3 k4 s1 s3"),
    "RAD_TAN_THIN_PRISM_FISHEYE": ("FISHEYE624", "fx fy cx cy k1 k2 k3 k4 k5 k6 p2 p1 s1 s2 s3 s4"),
    "FOV": ("FOV", "fx fy cx cy fov_omega"),
    "SIMPLE_DIVISION": ("DIVISION", "f cx cy division_lambda"),
    "DIVISION": ("DIVISION", "fx fy cx cy division_lambda"),
    "EUCM": ("EUCM", "fx fy cx cy unified_alpha unified_beta"),
}
"""Our model, and its settings in the order of COLMAP's parameters; f stands for both focal lengths."""

SPHERE = "EQUIRECTANGULAR"
"""The whole sphere, whose parameters are width and height again; our model has the same name."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    lines = [line.split() for line in document.text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    if not lines or not LINE.match(" ".join(lines[0][:5])):
        return None
    return [one_of_several(line[0], lens, document, line) for line in lines]


def count(kind: str) -> int:
    """Return the number of parameters of one of COLMAP's models, its width and height in EQUIRECTANGULAR's case."""
    return 2 if kind == SPHERE else len(MODELS[kind][1].split())


def lens(document: Document, words: list[str]) -> Lens:
    """Return the lens of the words of a line of cameras.txt. Raises InputError."""
    name, kind, *numbers = words if len(words) > 3 else [*words, "", "", ""]
    if kind == SPHERE:
        return Lens(name, SPHERE, document.size(*document.numbers(numbers, f"camera {name}", 4)[:2]))
    if kind not in MODELS:
        known = ", ".join((*MODELS, SPHERE))
        raise document.refusal(f"camera {name} is of the model {kind!r}: it must be one of {known}")
    model, names = MODELS[kind]
    order = names.split()
    width, height, *values = document.numbers(numbers, f"camera {name}", len(order) + 2)
    settings = dict(zip(order, values, strict=True))
    focal = settings.pop("f", None)
    given = {"fx": focal, "fy": focal} if focal is not None else {one: settings.pop(one) for one in ("fx", "fy")}
    center = {one: settings.pop(one) for one in ("cx", "cy")}
    return Lens(name, model, document.size(width, height) | matrix(**given, **center, first=0.5) | settings)
