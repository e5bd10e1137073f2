"""Hugin's projects, .pto: a line i for each picture, with letters for its numbers; those of Panorama Tools, too.

w, h: size; f: projection; v: horizontal field of view in degrees; a, b, c: lens correction; d, e: shift of the center
from the middle of the picture, in pixels, to the right and down; y, p, r: yaw, pitch and roll. v=0 means that v is that
of picture 0.
Reference: Hugin documentation, Nona: the format of its scripts; Panorama Tools documentation.
"""

import re
from math import pi, radians, tan

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import ANGLES, Lens, one_of_several
from .parts.panorama_tools import FISHEYE, RECTILINEAR, lens_of, of_panorama, ptlens
from .parts.program import ProgramFiles

PROJECTIONS = {"0": RECTILINEAR, "2": FISHEYE, "3": FISHEYE, "4": "EQUIRECTANGULAR"}
MOVED = "TrX", "TrY", "TrZ", "Tpy", "Tpp"
WORD = re.compile(r'([A-Za-z]+)("[^"]*"|\S+)')


def looks(document: Document) -> bool:
    return any(picture.has("w", "h", "f", "v") for picture in _pictures(document))


def _pictures(document: Document) -> list[Fields]:
    """Return the entries of each picture, with those of another one in place of references to it."""
    lines = [line[2:] for line in document.text.splitlines() if line.startswith(("i ", "o "))]
    pictures: list[dict[str, str]] = []
    for line in lines:
        document.check()
        words = {name: value.strip('"') for name, value in WORD.findall(line)}
        for name, value in words.items():
            if value.startswith("="):
                other = int(value[1:]) if value[1:].isdecimal() else len(pictures)
                words[name] = pictures[other].get(name, "") if other < len(pictures) else ""
        pictures.append(words)
    return [Fields(document, words, words.get("n", f"picture {i}")) for i, words in enumerate(pictures)]


def _lenses(document: Document) -> list[tuple[Lens, Fields]]:
    return [(one_of_several(picture.label, _lens, picture), picture) for picture in _pictures(document)]


def _lens(picture: Fields) -> Lens:
    document = picture.document
    model = PROJECTIONS[picture.word("f", PROJECTIONS)]
    width, height, angle = picture.number("w"), picture.number("h"), radians(picture.number("v"))
    size = document.size(width, height)
    if not 0 < angle < (radians(180) if model == RECTILINEAR else radians(720)):
        raise picture.refusal("v", "a field of view above 0, and of a rectilinear lens below 180")
    if picture.has("C"):
        raise document.refusal(f"{picture.label} is cropped (C), which changes v and is not read")
    if any(picture.number(name, 0.0) for name in "gt"):
        raise document.refusal(f"{picture.label} is sheared (g, t), which is not read")
    if model == PROJECTIONS["4"]:
        ends = angle / 2, angle / 2 * height / width
        if ends[0] > pi or ends[1] > pi / 2 or any(picture.number(name, 0.0) for name in "abcde"):
            raise document.refusal(f"{picture.label} is a panorama of more than the sphere, or corrected (a to e)")
        angles = (sign * end for end in ends for sign in (-1, 1))
        return Lens(picture.label, model, size | dict(zip(ANGLES, angles, strict=True)))
    focal = width / 2 / (tan(angle / 2) if model == RECTILINEAR else angle / 2)
    center = width / 2 + picture.number("d", 0.0), height / 2 + picture.number("e", 0.0)
    terms = ptlens(*(picture.number(name, 0.0) for name in "abc"))
    return lens_of(picture.label, model, size, focal, center, min(width, height) / 2, terms)


PROGRAM = ProgramFiles(
    "Hugin", ".pto of Hugin and Panorama Tools", looks, marks="hugin pto image lines TrX Ra Va",
    reads="rectilinear and fisheye with a, b, c, d, e; equirectangular",
    lost="other projections are refused, and moved pictures", **of_panorama(_lenses, MOVED, "ypr"),
)  # fmt: skip
