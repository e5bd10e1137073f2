"""The pictures of the gallery, by the terminal command."""

from __future__ import annotations

import os
import signal
import sys
import tempfile
from argparse import RawDescriptionHelpFormatter
from pathlib import Path

import bpy  # noqa: F401  (first: bmesh, which the scenes use, comes with it)
from arguments import Parser
from door import through
from ends import listen

from .lens_sheet import make_sheet
from .scenes import BY_CYCLES, PICTURES

FOLDER = Path(__file__).resolve().parents[2] / "blend_scenes"

CYCLES = "_by_cycles"
SHEET = "lenses"
NAMES = [*PICTURES, *(name + CYCLES for name in BY_CYCLES), SHEET]


def make_picture(name: str) -> int:
    """Cast a scene of blend_scenes, put its picture into blend_scenes/pictures, and return the exit status. SHEET is a
    picture of its own.
    """
    if name == SHEET:
        return make_sheet()
    scene = name.removesuffix(CYCLES)
    by_cycles = ["--engine", "CYCLES", "--samples", "12"] if name != scene else []
    with tempfile.TemporaryDirectory(dir=FOLDER) as folder:
        sys.argv[1:] = [str(FOLDER / f"{scene}.blend"), "--passes", "combined", "--output", folder, *by_cycles]
        status = through("cast")
        if status == 0:
            picture = Path(folder) / f"{scene}.png"
            picture.write_bytes(without_text(picture.read_bytes()))
            os.replace(picture, FOLDER / "pictures" / f"{name}.png")
    return status


def without_text(png: bytes) -> bytes:
    """Return a PNG file without its text chunks, in which Blender writes the file's path and date.

    Source: PNG Specification, section 5: an 8-byte signature, then chunks of length, type, data and checksum.
    """
    kept, at = [png[:8]], 8
    while at < len(png):
        size = 12 + int.from_bytes(png[at : at + 4], "big")
        if png[at + 4 : at + 8] != b"tEXt":
            kept.append(png[at : at + size])
        at += size
    return b"".join(kept)


def main(description: str) -> int:
    """Make the named pictures, or all; stop at the first failure and return its exit status."""
    parser = Parser(prog="make_pictures.py", description=description, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("names", metavar="NAME", nargs="*", help=", ".join(NAMES))
    names = parser.parse_args().names or NAMES
    if unknown := [name for name in names if name not in NAMES]:
        parser.error(f"no picture is called {', '.join(unknown)}: choose from {', '.join(NAMES)}")
    listen(signal.default_int_handler)  # so that temporary folders are removed
    return next((status for status in map(make_picture, names) if status), 0)
