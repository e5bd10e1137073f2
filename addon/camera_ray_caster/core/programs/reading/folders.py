"""Files that belong together: of lenses and of poses, or a file for each picture in a folder."""

import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...records import InputError
from .. import PROGRAMS
from ..parts.program import PictureFolders

NEAR = 5e-3
"""Seconds by which the times of a picture and its pose may differ."""


class PictureFiles(NamedTuple):
    """The files of a folder's pictures, in the order of the numbers in their names."""

    of: PictureFolders
    files: list[Path]
    trajectory: Path | None
    """The file that has their poses, if they do not."""


def beside(path: str) -> tuple[str, ...]:
    """Return the files that a path stands for: that of lenses and that of poses, which may be the same, or the files of
    a folder's pictures and their trajectory. Raises InputError for a folder without any.
    """
    pair = pair_of(path)
    if pair is not None:
        return pair
    pictures = pictures_in(Path(path))
    return tuple(map(str, [*pictures.files, *([] if pictures.trajectory is None else [pictures.trajectory])]))


def pair_of(path: str) -> tuple[str, str] | None:
    """Return the file of lenses and that of poses that belong to a path; None of a folder of pictures. Raises
    InputError for a path that the system does not take.
    """
    file = Path(path)
    try:
        pair = next((files for program in PROGRAMS if (files := program.pair(file)) is not None), None)
        is_folder = file.is_dir()
    except OSError as error:
        raise InputError(f"calibration file {path!r} cannot be read: {error.strerror}") from error
    if pair is None:
        return None if is_folder else (str(file), str(file))
    return str(pair[0]), str(pair[1])


def pictures_in(folder: Path) -> PictureFiles:
    """Return the files of a folder's pictures. Raises InputError if there are none, or if their trajectory is missing.
    """
    for pictures in (program.pictures for program in PROGRAMS if program.pictures is not None):
        for inside in pictures.folders:
            files = sorted((folder / inside).glob(pictures.pattern), key=number_of)
            if files:
                return PictureFiles(pictures, files, _trajectory(folder, folder / inside, pictures))
    names = ", ".join(program.name for program in PROGRAMS if program.pictures is not None)
    raise InputError(f"folder {str(folder)!r} has no images.bin or images.txt, nor its sparse/0, nor a file for each "
                     f"picture as of {names}: give a file")  # fmt: skip


def _trajectory(folder: Path, inside: Path, pictures: PictureFolders) -> Path | None:
    ending = pictures.moved_by
    if not ending:
        return None
    there = [*inside.parent.glob(f"*{ending}"), *inside.glob(f"*{ending}")]
    if len(there) != 1:
        raise InputError(f"folder {str(folder)!r} has {len(there)} trajectories ({ending}) beside its files "
                         f"({pictures.pattern[1:]}): there must be one, with their poses")  # fmt: skip
    return there[0]


def number_of(file: Path) -> float:
    """Return the last number in the name of a file: a time or a frame."""
    numbers = re.findall(r"\d+(?:\.\d+)?", file.name.removesuffix(file.suffix).removesuffix(".cameras"))
    return float(numbers[-1]) if numbers else 0.0


def nearest(times: np.ndarray, time: float) -> int | None:
    """Return the index of the time of a trajectory that is nearest to a time; None if none is within NEAR."""
    index = int(np.argmin(np.abs(times - time)))
    return index if abs(times[index] - time) < NEAR else None
