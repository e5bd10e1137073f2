"""The points of pictures in files of scanners' formats: a cloud for each picture, and sequences of a run."""

import json
import os
import shutil
from argparse import ArgumentTypeError
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import bpy

from ...core.cast import Images
from ...core.clouds.cloud import AXES, OF_DEVICE, SENSOR, scan
from ...core.clouds.formats import IN_WORDS, POINT_FORMATS, files_of
from ...core.clouds.sequences import sequence
from ...core.exports.camera_json import camera_from_json
from ...core.file_set import atomic_folder
from ...core.records import InputError
from ...core.sets.shared_facts import dataset_of
from ..read.unique import find_unique
from .annotations import CATEGORY

ERRORS = "noise", "dropout", "quantum", "seed"
"""Arguments of ``scan`` that add errors to ranges."""
SEQUENCES = "sequences"
"""Folder of sequences, one for each camera."""


def add_points(parser) -> None:
    """Add the options for points."""
    parser.add_argument("--points", type=str.lower, choices=POINT_FORMATS, help=
        f"also write the hit points as a point cloud: {IN_WORDS}")  # fmt: skip
    parser.add_argument("--points-axes", type=str.lower, choices=AXES, default=SENSOR, help=
        "axes of points: x ahead, y left, z up where each beam fires, or the world's; default: %(default)s")
    for name, text in (
        ("noise", "standard deviation of the ranges of points, in Blender units"),
        ("dropout", "range within which no point is lost on a surface perpendicular to the beam"),
    ):
        parser.add_argument(f"--{name}", type=float, default=0.0, metavar="LENGTH", help=f"{text}; default: none")
    parser.add_argument("--quantum", type=_length_or_device, default=0.0, metavar="LENGTH", help=
        "step of the ranges of points, in Blender units, or DEVICE: as the scanner's device stores them; default: none")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="seed of noise and lost points; default: 0")


def _length_or_device(text: str) -> float | str:
    if text.upper() == OF_DEVICE:
        return OF_DEVICE
    try:
        return float(text)
    except ValueError as error:
        raise ArgumentTypeError(f"{text!r} is not a length: give a number, or {OF_DEVICE}") from error


@dataclass(frozen=True)
class PointFiles:
    """How points are made and written."""

    format: str
    axes: str
    errors: Mapping[str, Any]
    """Errors of ranges, by the names of ERRORS."""

    @classmethod
    def of(cls, options) -> Self | None:
        """Return what a command line asks for; None for no points. Raises InputError for errors without points."""
        errors = {name: getattr(options, name) for name in ERRORS}
        if options.points is not None:
            return cls(options.points, options.points_axes, errors)
        if any(errors.values()):
            raise InputError("--noise, --dropout, --quantum and --seed belong to points: add --points FORMAT")
        return None

    def write(self, stem: Path, images: Images) -> None:
        """Write the points of a picture: files with this path and endings. The points are cast anew, in float64."""
        cloud = scan(images.camera, images.shapes, categories=categories_of(images.shapes.names), **self.errors)
        for ending, content in files_of(cloud, self.format, self.axes):
            stem.with_name(stem.name + ending).write_bytes(content)


def categories_of(names: Sequence[str]) -> dict[str, int]:
    """Return the category numbers, by name, of the objects that have the custom property CATEGORY.

    The property is a whole number, or a word; words are numbered from 1 in the sorted order of all words in the
    file.
    """
    words = sorted({word for item in bpy.data.objects if isinstance(word := item.get(CATEGORY), str) and word})
    numbers = {}
    for name in names:
        item = find_unique(name, bpy.data.objects)
        category = None if item is None else item.get(CATEGORY)
        if isinstance(category, str) and category:
            numbers[name] = words.index(category) + 1
        elif isinstance(category, int):
            numbers[name] = category
    return numbers


def collect_sequences(folder: Path, jobs: Iterable[Any]) -> None:
    """Make sequences of the files of pictures: one for each camera, with its frames in order."""
    for number, camera in enumerate(dict.fromkeys(job.camera for job in jobs)):
        target = folder / SEQUENCES / f"{number:02}"
        for kind, ending in (("velodyne", ".bin"), ("labels", ".label")):
            with atomic_folder(target / kind) as temporary:
                for k, job in enumerate(job for job in jobs if job.camera == camera):
                    _linked(folder / f"{job.name}{ending}", temporary / f"{k:06}{ending}")
        cameras, seconds = [], []
        for job in jobs:
            if job.camera == camera:
                text = (folder / f"{job.report}.json").read_text(encoding="utf-8")
                report = {**dataset_of(folder).get("common", {}), **json.loads(text)}
                cameras.append(camera_from_json(text))
                seconds.append(report["frame"] / report["host"]["frame_rate"])
        with atomic_folder(target) as temporary:
            for name, text in sequence(cameras, seconds):
                (temporary / name).write_text(text, encoding="utf-8", newline="\n")


def _linked(source: Path, target: Path) -> None:
    """Make a second name of a file, or a copy where the file system has none."""
    try:
        os.link(source, target)
    except OSError:
        shutil.copyfile(source, target)
