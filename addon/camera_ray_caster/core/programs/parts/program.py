"""The contract of a program: what its files are called and look like, how they are read, and how they are written.

A program is a module of ``core.programs`` with a ``PROGRAM``, and a word in MODULES. Each part is optional. Functions
work on plain records: lenses, poses, sizes, names and times.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

from ...records import InputError
from ...units import BLENDER_UNITS, Unit
from .document import Document
from .fields import Fields
from .lens import Lens, Models, different, once_each, one_of_several
from .placed import FROM_BLENDER, Placed, Rolling, inverted

Picture = TypeVar("Picture")

Content = str | bytes | np.ndarray | Iterator[str]
"""Content of a file: text, also in parts, bytes, or an image, (rows, columns, 3) float32 from the bottom up, stored as
float32 EXR.
"""


SEPARATELY = "export them separately, each by its name (--cameras NAME)"
"""What to do if lenses do not fit into one file."""


@dataclass(frozen=True, eq=False)
class CameraRecord:
    """A camera to write, at a time."""

    name: str
    """Name of its files for all times together."""
    stem: str
    """Name of its files at this time, without an ending."""
    lens: Lens
    """Its settings have the camera matrix and the size of the picture."""
    pose: np.ndarray
    """(4, 4) float64: from the camera's frame, x right, y down, z ahead, to the world, in the program's unit."""
    frame: float = 0.0
    seconds: float = 0.0
    meters: float = 1.0
    """Length of a Blender unit in meters."""
    fit: str = ""
    """Remark on a lens that was fitted to the camera's; empty for the camera's own lens."""
    rolling: Rolling | None = None
    """Of a rolling shutter, whose ``pose`` is that of the first row that is read."""

    @property
    def image(self) -> str:
        """Name of the picture's file."""
        return f"{self.stem}.png"

    @cached_property
    def world_to_camera(self) -> np.ndarray:
        """Return the inverse of the pose, (4, 4)."""
        return inverted(self.pose)

    @property
    def blenders(self) -> np.ndarray:
        """Return the pose of Blender's camera frame, y up and z back, (4, 4)."""
        return self.pose @ FROM_BLENDER

    @property
    def remark(self) -> dict[str, str]:
        """Return the entry of JSON with the remark on a fitted lens; none for the camera's own lens."""
        return {"fit": self.fit} if self.fit else {}


class ScanPattern(NamedTuple):
    """Rays of a scanner that are no rows and columns, in its axes, x ahead, y to the left, z up; (n,) arrays."""

    azimuth: np.ndarray
    """To the left, degrees."""
    elevation: np.ndarray
    """Degrees."""
    seconds: np.ndarray
    """From the begin of the scan."""
    rings: np.ndarray | None = None
    """Numbers of the emitters, if the file tells them."""
    height: np.ndarray | float = 0.0
    """Of the origins above the center, in the program's unit."""


@dataclass(frozen=True)
class FileWriter:
    """How a program's files are written."""

    key: str
    """Name in a command line."""
    label: str
    """Name in menus."""
    description: str
    """Description in menus, one line."""
    files: Callable[[Sequence[CameraRecord]], Iterator[tuple[str, Content]]] | None = None
    """Yields the name and the content of each file; raises InputError for cameras that cannot be written together. None
    if the files need whole cameras: ``core.exports`` writes them.
    """
    models: Models = field(default_factory=dict)
    """Models that are written, the preferred ones first; {} for poses alone."""
    refusal: Callable[[CameraRecord], str | None] = lambda record: None
    """Returns why a camera cannot be written, as a clause ("whose frame is not a whole number"); None if it can."""
    rigid: bool = True
    """Whether a pose is stored as a rotation."""
    rolling: bool = False
    """Whether a rolling shutter is written, by its first and last pose."""
    ending: str = ""
    """End of the names of files by which an export tells the format; "" if none does."""


class PictureFolders(NamedTuple):
    """Folders with a file for each picture."""

    pattern: str
    """Of the names of files."""
    folders: tuple[str, ...] = ("",)
    """In which they are looked for."""
    numbered: bool = False
    """Whether their names have frames; else they are in the order of the times in their names, from frame 1 on."""
    moved_by: str = ""
    """End of the name of the trajectory that moves the camera, in the folder or above; "" without one."""


@dataclass(frozen=True)
class ProgramFiles:
    """A program's files."""

    name: str
    files: str
    """Names of its files, in words."""
    looks: Callable[[Document], bool] | None = None
    """Whether a document is of this program; raising InputError means no."""
    marks: str = ""
    """Words that its files have: a file of no known format is nearest to the program with most of them."""
    reads: str = ""
    """Lenses that are read, in the program's words; "" if none is."""
    lost: str = ""
    """What its files do not tell, or what is refused."""
    models: Models = field(default_factory=dict)
    """Its models by their words; one table for reading and writing."""
    read: Callable[[Document], list[Lens] | None] | None = None
    """Returns the lenses of a document; None if they are further inside, in entries by name."""
    poses: Callable[[Document], list[Placed]] | None = None
    """Returns the poses of a document in its order."""
    rays: Callable[[Document], ScanPattern] | None = None
    """Returns the rays of a scanner that has no rows and columns."""
    note: Callable[[Document], str] = lambda document: ""
    """Returns what is left out of the poses of a document, in one line; "" if nothing is."""
    export: FileWriter | None = None
    unit: Unit = BLENDER_UNITS
    """Unit of lengths in its files."""
    general: bool = False
    """Whether others may look like it: it reads what no other does."""
    endings: tuple[str, ...] = ()
    """Ends of the names of its files, of which ``hint`` says what is wrong."""
    hint: Callable[[Document], str | None] = lambda document: None
    """Returns why a document with such a name is not of this program; None if it cannot tell."""
    pictures: PictureFolders | None = None
    """Its folders with a file for each picture."""
    columns: str = ""
    """How many numbers a line of its trajectories has, in words; "" for other files."""
    pair: Callable[[Path], tuple[Path, Path] | None] = lambda path: None
    """Returns the file of lenses and that of poses to which a file or a folder belongs, of a program with one each."""

    def recognizes(self, document: Document) -> bool:
        """Whether a document is of this program."""
        try:
            return self.looks is not None and self.looks(document)
        except InputError:
            return False


def of_cameras(
    cameras: Callable[[Document], Iterable[Fields]],
    lens: Callable[[Fields], Lens],
    pose: Callable[[Fields], np.ndarray] | None = None,
) -> dict[str, Any]:
    """Return ``read``, and ``poses`` if there are any, of a program whose files have entries for each camera, labeled
    by its name.
    """

    def read(document: Document) -> list[Lens]:
        return [one_of_several(camera.label, lens, camera) for camera in cameras(document)]

    def poses(document: Document) -> list[Placed]:
        return [Placed(camera.label, "", None, pose(camera)) for camera in cameras(document)] if pose else []

    return {"read": read} | ({"poses": poses} if pose else {})


def of_pictures(
    pictures: Callable[[Document], Sequence[Picture]],
    lens: Callable[[Document, Picture], Lens],
    placed: Callable[[Document, Picture], Placed | None],
) -> dict[str, Any]:
    """Return ``read`` and ``poses`` of a program whose files have a lens for each picture; equal ones are one, after
    which the camera of a pose is named. A picture without a pose is left out.
    """

    def read(document: Document) -> list[Lens]:
        return different(lens(document, picture) for picture in pictures(document))

    def poses(document: Document) -> list[Placed]:
        several = pictures(document)
        lenses = once_each(lens(document, picture) for picture in several)
        pairs = [(placed(document, picture), first) for picture, first in zip(several, lenses, strict=True)]
        return [pose._replace(camera=first.name) for pose, first in pairs if pose is not None]

    return {"read": read, "poses": poses}


def by_lens(
    records: Sequence[CameraRecord], text: Callable[[Lens], str]
) -> Iterator[tuple[str, str, list[CameraRecord]]]:
    """Yield for each lens the name of its file without ending, the lens as text, and its records.

    The name is the camera's, or if the lens changes from frame to frame the name of each record.
    """
    for name in dict.fromkeys(record.name for record in records):
        with_texts = [(record, text(record.lens)) for record in records if record.name == name]
        if len({lens for _, lens in with_texts}) == 1:
            yield name, with_texts[0][1], [record for record, _ in with_texts]
        else:
            yield from ((record.stem, lens, [record]) for record, lens in with_texts)


def line_by_line(ending: str, line: Callable[[CameraRecord], str], head: str = "") -> Callable:
    """Return ``FileWriter.files`` of trajectories: a file for each camera, with a line for each frame."""

    def write(records: Sequence[CameraRecord]) -> Iterator[tuple[str, str]]:
        for name in dict.fromkeys(record.name for record in records):
            lines = [f"{line(record)}\n" for record in records if record.name == name]
            yield f"{name}{ending}", head + "".join(lines)

    return write


def in_words(names: Iterable[str]) -> str:
    """Return names as a list in a sentence."""
    *before, last = names
    return f"{', '.join(before)} or {last}"


def written(models: Models, *words: str) -> Models:
    """Return some models of a program, in this order."""
    return {word: models[word] for word in words}


