"""Lens cards: a line per picture with its name, width, height, focal lengths, center and pose. A toy in one file.

A pose is the first three rows of the matrix from the camera, x right, y down, z ahead, to the world. The center of the
first pixel is (0.5, 0.5).
"""

from __future__ import annotations

from .parts.lens import Lens, matrix, matrix_of
from .parts.placed import Placed, pose_of
from .parts.program import FileWriter, ProgramFiles

HEAD = "LENS CARDS"
MODELS = {"card": ("OPENCV_PINHOLE", ())}


def looks(document):
    """See ProgramFiles."""
    return document.lines()[:1] == [HEAD]


def _cards(document):
    lines = [line.split() for line in document.lines()[1:]]
    return [(name, document.numbers(numbers, f"card of {name}", 18)) for name, *numbers in lines]


def read(document):
    """See ProgramFiles."""
    return [
        Lens(name, "OPENCV_PINHOLE", document.size(width, height) | matrix(fx, fy, cx, cy, 0.5))
        for name, (width, height, fx, fy, cx, cy, *_) in _cards(document)
    ]


def poses(document):
    """See ProgramFiles."""
    return [Placed(name, name, None, pose_of(document, numbers[6:], name)) for name, numbers in _cards(document)]


def write(records):
    """See FileWriter."""
    lines = [HEAD]
    for record in records:
        numbers = *record.lens.size, *matrix_of(record.lens.settings, 0.5), *record.pose[:3].ravel().tolist()
        lines.append(f"{record.stem} {' '.join(map(repr, numbers))}")
    yield "lens_cards.txt", "\n".join(lines) + "\n"


PROGRAM = ProgramFiles(
    "Lens Cards", "lens_cards.txt", looks, marks="lens cards", reads="pinholes", lost="distortion",
    models=MODELS, read=read, poses=poses,
    export=FileWriter("cards", "Lens Cards", "lens_cards.txt: pinholes and poses", write, MODELS),
)  # fmt: skip
