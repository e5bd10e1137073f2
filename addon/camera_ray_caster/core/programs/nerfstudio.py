"""transforms.json of nerfstudio and instant-ngp: one lens for all frames, or one per frame.

The center of the first pixel is (0.5, 0.5). k3 and k4 are the coefficients of r^6 and r^8; OpenCV's pinhole has no r^8.
Entries of the whole file count before those of a frame; if it has one coefficient, those of frames do not count at all.
Without w and h the pictures are as large as the frame, as in the files of NeRF, which have camera_angle_x alone.
EQUIRECTANGULAR is the whole sphere; an ORTHOPHOTO's rays are parallel.
Reference: nerfstudio documentation, Data conventions; its reader, nerfstudio_dataparser.py.
"""

from __future__ import annotations

from math import pi, tan
from typing import Any

from .parts.document import Document
from .parts.lens import Lens, matrix

MODELS = {
    "OPENCV": ("OPENCV_PINHOLE", ("k1", "k2", "k3", "p1", "p2")),
    "OPENCV_FISHEYE": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
}
MODELS |= {"PINHOLE": MODELS["OPENCV"], "SIMPLE_PINHOLE": MODELS["OPENCV"], "PERSPECTIVE": MODELS["OPENCV"]}
MODELS |= {"FISHEYE": MODELS["OPENCV_FISHEYE"]}
"""Our model, and its coefficients. Those of a pinhole count, too: nerfstudio distorts by them whatever the model is
called.
"""
COEFFICIENTS, LIST = ("k1", "k2", "k3", "k4", "p1", "p2"), "distortion_params"
"""All coefficients, in the order of the list that may stand in their place."""
FISHEYE624, SPHERE, PARALLEL = "FISHEYE624", "EQUIRECTANGULAR", "ORTHOPHOTO"
OF_ARIA = "k1", "k2", "k3", "k4", "k5", "k6", "p2", "p1", "s1", "s2", "s3", "s4"
"""The list of a FISHEYE624."""
SIZES, FOCAL, CENTER = ("w", "h"), ("fl_x", "fl_y", "camera_angle_x", "camera_angle_y"), ("cx", "cy")
OF_LENS = (*SIZES, *FOCAL, *CENTER, *COEFFICIENTS, LIST, "camera_model", "is_fisheye")
"""All entries of which a lens is made."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    entries = document.raw
    frames = entries.get("frames")
    if not isinstance(frames, list) or not all(isinstance(frame, dict) for frame in frames):
        return None
    if any(name.startswith("ftheta_p") for name in entries):
        raise document.refusal("it has an f-theta lens of instant-ngp, which is not read: give a file of NVIDIA's")
    for name in ("latlong", "equirectangular", "orthographic"):
        if entries.get(name):
            raise document.refusal(f"its entry {name} of instant-ngp is not read: choose that model for the camera")
    shared = not {"fl_x", "camera_angle_x"}.isdisjoint(entries) or entries.get("camera_model") == SPHERE
    lenses = {lens.name: lens for lens in of_frames(document, frames)}
    if not frames and not shared:
        raise document.refusal("it has no fl_x, and no frames")
    if len(lenses) < 2 and shared:
        return [_lens(document, (frames or [{}])[0], "camera")]
    return list(lenses.values())


def of_frames(document: Document, frames: list[dict]) -> list[Lens]:
    """Return the lens of each frame; equal lenses are one, by the name of its first frame. Raises InputError."""
    by_entries: dict[str, Lens] = {}
    by_lens: dict[str, Lens] = {}
    found = []
    for number, frame in enumerate(frames):  # a file may have 100,000 frames
        entries = repr([frame.get(one) for one in OF_LENS])
        if entries not in by_entries:
            document.check()
            lens = _lens(document, frame, str(frame.get("file_path", number)))
            by_entries[entries] = by_lens.setdefault(str(lens[1:]), lens)
        found.append(by_entries[entries])
    return found


def _focal(document: Document, entries: dict, axis: str, side: float) -> float:
    """Return the focal length along x or y, in pixels."""
    name = f"camera_angle_{axis}"
    if f"fl_{axis}" in entries or name not in entries:
        return document.number(entries, f"fl_{axis}")
    angle = document.number(entries, name)
    if not 0 < angle < pi:
        raise document.refusal(f"{name} is {angle:g}: it must be above 0 and below pi")
    return side / (2 * tan(angle / 2))


def _lens(document: Document, frame: dict, name: str) -> Lens:
    entries = frame | document.raw
    kind = entries.get("camera_model", "OPENCV_FISHEYE" if entries.get("is_fisheye") else "OPENCV")
    document.one_of(kind, "camera_model", (*MODELS, FISHEYE624, SPHERE, PARALLEL))
    given = [document.number(entries, side) if side in entries else None for side in SIZES]
    size = document.size(*given)
    if kind == SPHERE:
        return Lens(name, SPHERE, size)
    width, height = (side or own for side, own in zip(given, document.frame or (1, 1), strict=True))
    focal = _focal(document, entries, "x", width)
    focal_y = _focal(document, entries, "y", height) if {"fl_y", "camera_angle_y"} & set(entries) else focal
    cx, cy = (document.number(entries, one, side / 2) for one, side in (("cx", width), ("cy", height)))
    if kind == PARALLEL:
        return Lens(name, "ORTHO", size | _orthographic(document, (focal, focal_y), (cx, cy), (width, height)))
    size |= matrix(focal, focal_y, cx, cy, 0.5)
    if kind == FISHEYE624:
        owner = document.raw if LIST in document.raw else frame
        numbers = document.numbers(owner.get(LIST), LIST, len(OF_ARIA))
        return Lens(name, FISHEYE624, size | dict(zip(OF_ARIA, numbers, strict=True)))
    model, terms = MODELS[kind]
    rest = _coefficients(document, frame)
    for term in COEFFICIENTS:
        if term not in terms and rest.pop(term):
            raise document.refusal(f"{term} is not 0, but OpenCV's {model[7:].lower()} has no such coefficient")
    return Lens(name, model, size | rest)


def _orthographic(document: Document, focal, center, size) -> dict[str, Any]:
    """Return the settings of parallel rays, fl_x and fl_y of which pass through a unit of length."""
    if focal[0] != focal[1] or focal[0] <= 0:
        raise document.refusal(f"fl_x and fl_y of an {PARALLEL} are {focal[0]:g} and {focal[1]:g}: they must be equal")
    longer = max(size)
    return {
        "ortho_scale": longer / focal[0], "sensor_fit": "AUTO",
        "shift_x": (size[0] / 2 - center[0]) / longer, "shift_y": (center[1] - size[1] / 2) / longer,
    }  # fmt: skip


def _coefficients(document: Document, frame: dict) -> dict[str, float]:
    """Return all coefficients of a frame."""
    shared = document.raw
    owner = frame if {LIST, *COEFFICIENTS}.isdisjoint(shared) else shared
    if LIST in owner:
        return dict(zip(COEFFICIENTS, document.numbers(owner[LIST], LIST, len(COEFFICIENTS)), strict=True))
    return {term: document.number(owner, term, 0.0) for term in COEFFICIENTS}
