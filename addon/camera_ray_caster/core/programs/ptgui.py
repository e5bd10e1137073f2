"""PTGui's projects, .pts as JSON, from version 11 on: lenses, and groups of pictures that have one each.

A focal length and the diagonal of the sensor are in millimeters; a, b, c are those of Panorama Tools. The fisheye is
equidistant if its fisheyefactor is 0. The center is the middle of the picture: shifts and shears are refused, since
their units and directions are not documented, and readers do not agree on them. The angles are those of Panorama Tools.
Reference: PTGui documentation, Project file format; Lens parameters a, b, c.
"""

from math import hypot

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, one_of_several
from .parts.panorama_tools import FISHEYE, RECTILINEAR, lens_of, of_panorama, ptlens
from .parts.program import ProgramFiles

MOVED = "vpx", "vpy", "vpd"
"""Entries of a picture that was taken from another place."""
PROJECTIONS = {"rectilinear": RECTILINEAR, "circularfisheye": FISHEYE, "fullframefisheye": FISHEYE}


def looks(document: Document) -> bool:
    return document.entries.part("project").has("globallenses", "imagegroups")


def _lenses(document: Document) -> list[tuple[Lens, Fields]]:
    """Return the lens of each group of pictures, and the entries of its position."""
    project = document.entries.part("project")
    lenses, groups = project.parts("globallenses"), enumerate(project.parts("imagegroups"))
    return [
        (one_of_several(f"lens of group {i}", _lens, group, lenses, i), group.part("position").part("params"))
        for i, group in groups
    ]


def _lens(group: Fields, lenses: list[Fields], number: int) -> Lens:
    document, index = group.document, int(group.number("globallens", 0.0))
    images = group.parts("images")
    label = images[0].text("filename") if images else f"group {number}"
    if not 0 <= index < len(lenses):
        raise document.refusal(f"globallens of {label} is {index}: it has {len(lenses)} lenses")
    shared = lenses[index].labeled(label)
    lens = (group.part("individuallens") if group.has("individuallens") else shared.part("lens")).part("params")
    for name in ("shift", "shear"):
        single = f"individual{name}"
        moved = (group.part(single) if group.has(single) else shared.part(name)).part("params")
        if any(moved.number(name) for name in moved):
            raise document.refusal(f"{label} has a {name}, which is not read")
    model = PROJECTIONS[lens.word("projection", PROJECTIONS)]
    if model == FISHEYE and lens.number("fisheyefactor", 0.0):
        raise document.refusal(f"fisheyefactor of {label} is not 0, which is not read: a fisheye must be equidistant")
    width, height = group.numbers("size", 2)
    size, diagonal = document.size(width, height), lens.number("sensordiagonal")
    focal = lens.number("focallength") / diagonal * hypot(width, height) if diagonal > 0 else 0.0
    if focal <= 0:
        raise document.refusal(f"focallength and sensordiagonal of {label} must be above 0")
    terms = ptlens(*(lens.number(name, 0.0) for name in "abc"))
    return lens_of(label, model, size, focal, (width / 2, height / 2), min(width, height) / 2, terms)


PROGRAM = ProgramFiles(
    "PTGui", ".pts of version 11 or later", looks, marks="project globallenses imagegroups focallength sensordiagonal",
    reads="rectilinear and equidistant fisheye with a, b, c",
    lost="shifts, shears, viewpoints and other projections are refused", **of_panorama(_lenses, MOVED),
)  # fmt: skip
