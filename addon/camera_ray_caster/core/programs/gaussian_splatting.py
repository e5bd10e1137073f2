"""cameras.json of 3D Gaussian splatting: a pinhole for each picture, with its place and its rotation to the world.

The center is the middle of the picture, unless cx and cy tell it from the corner, in pixels or, if both are at most 1,
in fractions of its sides. x is right, y down, z ahead.
Reference: 3D Gaussian Splatting for Real-Time Radiance Field Rendering, its code: camera_to_JSON.
"""

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, different, matrix, once_each
from .parts.placed import Placed, of_rotation
from .parts.plain import LEAST
from .parts.program import ProgramFiles


def looks(document: Document) -> bool:
    pictures = list(document.entries.named().values())
    return bool(pictures) and all(picture.has("position", "rotation", "fx") for picture in pictures)


def _pictures(document: Document) -> list[Fields]:
    pictures = document.entries.named()
    return [picture.labeled(picture.text("img_name", name)) for name, picture in pictures.items()]


def _lens(picture: Fields) -> Lens:
    width, height, fx = picture.number("width"), picture.number("height"), picture.number("fx")
    picture.document.check()
    fy, center = picture.number("fy", fx), [picture.number(name) for name in ("cx", "cy") if picture.has(name)]
    cx, cy = picture.number("cx", width / 2), picture.number("cy", height / 2)
    if center and all(0 < fraction <= 1 for fraction in center) and min(width, height) >= LEAST:
        if max(fx, fy) < LEAST:
            raise picture.refusal("fx", "in pixels: multiply it by the picture's side of which it is a part")
        cx, cy = picture.number("cx", 0.5) * width, picture.number("cy", 0.5) * height
    camera_matrix = matrix(fx, fy, cx, cy, 0.5)
    return Lens(picture.label, "OPENCV_PINHOLE", picture.document.size(width, height) | camera_matrix)


def read(document: Document) -> list[Lens]:
    return different(map(_lens, _pictures(document)))


def poses(document: Document) -> list[Placed]:
    pictures = _pictures(document)
    lenses = once_each(map(_lens, pictures))
    placed = []
    for picture, lens in zip(pictures, lenses, strict=True):
        turn, position = picture.matrix("rotation", 9), picture.numbers("position", 3)
        pose = of_rotation(document, turn, position, picture.said("rotation"))
        placed.append(Placed(lens.name, picture.label, None, pose))
    return placed


PROGRAM = ProgramFiles(
    "Gaussian splatting", "cameras.json of 3D Gaussian splatting", looks,
    marks="img_name position rotation fx fy width height", reads="pinhole", read=read, poses=poses,
)  # fmt: skip
