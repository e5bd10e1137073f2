"""RealityCapture's and RealityScan's cameras: an .xmp for each picture, or a .csv of internal and external parameters.

Focal lengths are those of a picture whose longer side is 36 mm; the principal point is measured from the middle of the
picture in parts of its longer side. The size of the pictures is that of the frame. The rotation of an .xmp leads by
rows from the world to the camera, x right, y down, z ahead. Heading, pitch and roll of a .csv are in degrees: a camera
that looks down, with its upper side to the north, is turned about its axes y by the roll, x by the pitch, and z by the
heading, clockwise. Four radial coefficients make a Radial Polynomial. t1 and t2 are OpenCV's p2 and p1: the program's
own files for OpenCV have them in this order. Not all is documented: px, py and the angles of a .csv are taken as other
readers do.
References: RealityCapture, XMP Camera Math; RealityScan, Camera Geometry, and its OpenCV-compliant Internal/External
Camera Parameters.
"""

from collections.abc import Iterable

import numpy as np

from ..maths.rotations import rotation
from ..text_forms.xml_subset import Element
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import FRAME_SIZE, Lens, different, matrix, once_each
from .parts.placed import FROM_BLENDER, Placed, of_camera
from .parts.program import PictureFolders, ProgramFiles

PREFIX, DESCRIPTION = "xcr:", "rdf:Description"
SPLIT = {"Rotation", "Position", "DistortionCoeficients"}
"""Entries of an .xmp that are lists of numbers."""
MODELS = {
    "perspective": "", "division": "", "brown3": "k1 k2 k3", "brown3t2": "k1 k2 k3 t1 t2", "brown4": "k1 k2 k3 k4",
    "brown4t2": "k1 k2 k3 k4 t1 t2",
}  # fmt: skip
"""The coefficients of each distortion model of an .xmp."""
FILM = 36.0
"""Millimeters of a picture's longer side."""
HEAD = ("x", "y", "alt", "heading", "pitch", "roll")
FIRST_LINES = 9
"""Lines of a .csv among which one names the columns."""
COEFFICIENTS = ("k1", "k2", "k3", "k4", "t1", "t2")
TERMS = "k1", "k2", "k3", "p2", "p1"
"""The settings of a pinhole for these coefficients without k4."""


def looks(document: Document) -> bool:
    if document.text.lstrip()[:1] == "<":
        return any(
            entries.has("FocalLength35mm") or entries.has("Rotation", "Position") for entries in _of_xmp(document)
        )
    return _head(document) is not None


def _head(document: Document) -> int | None:
    """Return the number of the line of a .csv that names the columns; None of any other file."""
    lines = document.text.splitlines()[:FIRST_LINES]
    return next((i for i, line in enumerate(lines) if set(HEAD) <= set(_words(line.lstrip("# ")))), None)


def _words(line: str) -> list[str]:
    return [word.strip() for word in line.strip().replace(";", ",").split(",")]


def _of_xmp(document: Document) -> list[Fields]:
    """Return the entries of each description in an .xmp: those of attributes and elements with their prefix."""
    descriptions = []
    for description in document.xml.all(DESCRIPTION):
        texts = dict(description.attributes) | _texts(description.children)
        names = {name.removeprefix(PREFIX): text for name, text in texts.items() if name.startswith(PREFIX)}
        values = {name: text.split() if name in SPLIT else text for name, text in names.items()}
        descriptions += [Fields(document, values)] if values else []
    return descriptions


def _texts(elements: Iterable[Element]) -> dict[str, str]:
    return {element.name: element.text for element in elements}


def _pictures(document: Document) -> list[Fields]:
    """Return the entries of each picture: of an .xmp, or of the lines of a .csv, labeled by the picture's name."""
    if document.text.lstrip()[:1] == "<":
        return _of_xmp(document)[:1]
    head, *lines = document.text.splitlines()[_head(document) :]
    names = _words(head.lstrip("# "))
    pictures = []
    for number, line in enumerate(filter(str.strip, lines), 1):
        document.check()
        words = _words(line)
        if len(words) != len(names):
            raise document.refusal(f"line {number} has {len(words)} entries: it must have {len(names)}")
        pictures.append(Fields(document, dict(zip(names, words, strict=True)), words[0]))
    return pictures


def _lens(document: Document, picture: Fields) -> Lens:
    width, height = document.picture_size or (1, 1)
    longer = max(width, height)
    if picture.has("heading"):
        coefficients = [picture.number(name, 0.0) for name in COEFFICIENTS]
        focal, center = picture.number("f"), ("px", "py")
    else:
        focal, center = picture.number("FocalLength35mm"), ("PrincipalPointU", "PrincipalPointV")
        kind = picture.word("DistortionModel", MODELS, "perspective")
        coefficients = picture.numbers("DistortionCoeficients", 6, default=[0.0] * 6)
        if kind == "division" and any(coefficients):
            raise document.refusal("its DistortionModel is division, which is not read: choose Brown3 or Brown4")
        if kind == "perspective":
            coefficients = [0.0] * 6
        others = [name for name, value in zip(COEFFICIENTS, coefficients, strict=True)
                  if value and name not in MODELS[kind].split()]  # fmt: skip
        if others:
            raise document.refusal(
                f"its DistortionModel is {kind}, but its {others[0]} is not 0: set it to 0, or name a model that has it"
            )
        if picture.number("Skew", 0.0) or picture.number("AspectRatio", 1.0) != 1:
            raise document.refusal("its Skew is not 0, or its AspectRatio not 1: undistort the pictures first")
    *radial, k4, t1, t2 = coefficients
    if k4 and (t1 or t2):
        raise document.refusal(
            f"k4, t1 and t2 of {picture.label or 'the picture'} are not 0, which no model here has: choose the "
            "distortion model Brown4, or Brown3 with tangential distortion, in RealityCapture"
        )
    x, y = (side / 2 + picture.number(name, 0.0) * longer for side, name in zip((width, height), center, strict=True))
    pixels = focal / FILM * longer
    settings = FRAME_SIZE | matrix(pixels, pixels, x, y, 0.5)
    if k4:
        polynomial = " 0 ".join(map(repr, (*radial, k4)))
        return Lens(picture.label, "RADIAL_POLYNOMIAL", settings | {"radial_polynomial": f"0 1 0 {polynomial}"})
    return Lens(picture.label, "OPENCV_PINHOLE", settings | dict(zip(TERMS, (*radial, t1, t2), strict=True)))


def read(document: Document) -> list[Lens]:
    return different(_lens(document, picture) for picture in _pictures(document))


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: none of an .xmp that has only a lens."""
    pictures = [picture for picture in _pictures(document)
                if picture.has("heading") or picture.has("Rotation", "Position")]  # fmt: skip
    lenses = once_each(_lens(document, picture) for picture in pictures)
    return [Placed(lens.name, picture.label, None, _pose(picture))
            for picture, lens in zip(pictures, lenses, strict=True)]  # fmt: skip


def _pose(picture: Fields) -> np.ndarray:
    if picture.has("Rotation"):
        rows, center = picture.numbers("Rotation", 9), picture.numbers("Position", 3)
        return of_camera(picture.document, rows, center, picture.label or "the picture")
    heading, pitch, roll = np.radians([picture.number(name) for name in ("heading", "pitch", "roll")])
    about_z, about_x, about_y = rotation(np.array([[0, 0, -heading], [pitch, 0, 0], [0, roll, 0]]))
    pose = np.eye(4)
    pose[:3, :3] = about_z @ about_x @ about_y
    pose[:3, 3] = [picture.number(name) for name in ("x", "y", "alt")]
    return pose @ FROM_BLENDER


PROGRAM = ProgramFiles(
    "RealityCapture", "an .xmp for each picture; .csv of internal and external camera parameters", looks,
    marks="DistortionModel FocalLength35mm PrincipalPointU DistortionCoeficients Rotation Position",
    reads="perspective, brown3, brown3t2, brown4",
    lost="the size of the pictures; division, and k4 with tangential distortion, are refused",
    read=read, poses=poses, pictures=PictureFolders("*.xmp"),
)  # fmt: skip
