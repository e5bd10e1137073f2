"""Writing the files of an export: all of them, or none."""

import os
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np

from ..file_set import atomic_folder
from ..names import folded
from ..openexr.writing import exr
from ..records import InputError
from .format import Content


def exr_file(path: Path, pixels: np.ndarray) -> None:
    """Write an image of an export, (rows, columns, 3) float32 from the bottom up, to an EXR file."""
    path.write_bytes(exr(pixels))


def write(
    files: Iterable[tuple[str, Content]], folder: Path, image: Callable[[Path, np.ndarray], None] = exr_file
) -> list[Path]:
    """Write the names and contents of an export into a folder, images by ``image``; return the paths, sorted: of files
    in folders the outermost folder's.

    Raises InputError if two files have one name, or the folder cannot be written; then no file is left behind.
    """
    written: set[str] = set()
    with atomic_folder(folder) as temporary:
        for name, content in files:
            if folded(name) in written:
                raise InputError(f"two cameras would have the file {name!r}: rename one of the cameras")
            written.add(folded(name))
            path = temporary / name
            path.parent.mkdir(parents=True, exist_ok=True)
            if isinstance(content, np.ndarray):
                image(path, content)
            elif isinstance(content, bytes):
                path.write_bytes(content)
            else:
                with path.open("w", encoding="utf-8", newline="\n") as file:
                    file.writelines([content] if isinstance(content, str) else content)
        names = sorted(os.listdir(temporary))
    return [folder / name for name in names]
