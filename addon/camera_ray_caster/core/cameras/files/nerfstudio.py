"""transforms.json of nerfstudio and instant-ngp: one lens for all frames, or one a frame.

The center of its first pixel is (0.5, 0.5). Its k3 and k4 are those of r^6 and r^8; OpenCV's pinhole has no k4 of that.
Reference: nerfstudio documentation, Data conventions.
"""

from __future__ import annotations

from math import tan

from .document import Document, Lens, matrix, size

MODELS = {
    "OPENCV": ("OPENCV_PINHOLE", ("k1", "k2", "k3", "p1", "p2")),
    "OPENCV_FISHEYE": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "PINHOLE": ("OPENCV_PINHOLE", ()),
    "SIMPLE_PINHOLE": ("OPENCV_PINHOLE", ()),
}


def read(document: Document, key: str) -> list[Lens] | None:
    """See the package."""
    entries = document.entries
    frames = entries.get("frames")
    if not isinstance(frames, list) or not all(isinstance(frame, dict) for frame in frames):
        return None
    if not {"fl_x", "camera_angle_x"}.isdisjoint(entries):
        return [_lens(document, entries, "camera")]
    lenses: dict[str, Lens] = {}
    for number, frame in enumerate(frames):
        lens = _lens(document, entries | frame, str(frame.get("file_path", number)))
        lenses.setdefault(str(lens[1:]), lens)
    if not lenses:
        raise document.refusal("it has no fl_x, and no frames")
    return list(lenses.values())


def _lens(document: Document, entries: dict, name: str) -> Lens:
    kind = entries.get("camera_model", "OPENCV_FISHEYE" if entries.get("is_fisheye") else "OPENCV")
    if kind not in MODELS:
        raise document.refusal(f"camera_model is {kind!r}: it must be one of {', '.join(MODELS)}")
    model, terms = MODELS[kind]
    if kind == "OPENCV" and document.number(entries, "k4", 0.0):
        raise document.refusal("k4 of an OPENCV camera is of r^8, which OpenCV's model does not have: it must be 0")
    width, height = (document.number(entries, side) for side in ("w", "h"))
    if "fl_x" in entries:
        focal = document.number(entries, "fl_x")
    else:
        focal = width / (2 * tan(document.number(entries, "camera_angle_x") / 2))
    focal_y = document.number(entries, "fl_y", focal)
    cx, cy = (document.number(entries, one, side / 2) for one, side in (("cx", width), ("cy", height)))
    rest = {term: document.number(entries, term, 0.0) for term in terms}
    return Lens(name, model, size(width, height) | matrix(focal, focal_y, cx, cy, 0.5) | rest)
