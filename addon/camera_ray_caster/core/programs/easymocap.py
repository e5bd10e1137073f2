"""EasyMocap's intri.yml and extri.yml: names, and for each K_NAME, dist_NAME; Rot_NAME or R_NAME, and T_NAME.

Rot is a rotation by rows, R a rotation vector; with T they lead from the world, in meters, to the camera, x right, y
down, z ahead. H and W tell the size of pictures in newer files. The center of the first pixel is (0, 0).
Reference: EasyMocap documentation, Camera calibration.
"""

from pathlib import Path

import numpy as np

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, one_of_several
from .parts.placed import Placed, inverted, of_rotation
from .parts.plain import of_matrix
from .parts.program import ProgramFiles

LENSES, POSES = "intri.yml", "extri.yml"


def pair(path: Path) -> tuple[Path, Path] | None:
    folder = path if path.is_dir() else path.parent if path.name in (LENSES, POSES) else None
    if folder is None or not ((folder / LENSES).is_file() and (folder / POSES).is_file()):
        return None
    return folder / LENSES, folder / POSES


def looks(document: Document) -> bool:
    names = _names(document)
    return bool(names) and any(all(document.entries.has(f"{kind}_{name}") for name in names) for kind in "KT")


def _names(document: Document) -> list[str]:
    return [name.text("names") for name in document.entries.each("names")]


def read(document: Document) -> list[Lens]:
    return [one_of_several(name, _lens, document, name) for name in _names(document)]


def _lens(document: Document, name: str) -> Lens:
    entries = document.entries.labeled(name)
    distortion = entries.first(f"dist_{name}", f"D_{name}")
    return of_matrix(entries, f"K_{name}", distortion, entries.sides(f"W_{name}", f"H_{name}"))


def poses(document: Document) -> list[Placed]:
    return [Placed(name, "", None, _pose(document.entries, name)) for name in _names(document)]


def _pose(entries: Fields, name: str) -> np.ndarray:
    by_rows, vector = f"Rot_{name}", f"R_{name}"
    turn = entries.matrix(by_rows, 9) if entries.has(by_rows) else entries.matrix(vector, 3)
    return inverted(of_rotation(entries.document, turn, entries.matrix(f"T_{name}", 3), by_rows))


PROGRAM = ProgramFiles(
    "EasyMocap", "intri.yml and extri.yml", looks, marks="names K_ dist_ Rot_ R_ T_", reads="pinhole",
    read=read, poses=poses, pair=pair, unit=METERS,
)  # fmt: skip
