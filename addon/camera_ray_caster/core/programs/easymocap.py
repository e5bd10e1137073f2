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
from .parts.lens import Lens
from .parts.placed import inverted, of_rotation
from .parts.plain import of_matrix
from .parts.program import ProgramFiles, of_cameras

LENSES, POSES = "intri.yml", "extri.yml"


def pair(path: Path) -> tuple[Path, Path] | None:
    folder = path if path.is_dir() else path.parent if path.name in (LENSES, POSES) else None
    if folder is None or not ((folder / LENSES).is_file() and (folder / POSES).is_file()):
        return None
    return folder / LENSES, folder / POSES


def looks(document: Document) -> bool:
    cameras = _cameras(document)
    return bool(cameras) and any(all(camera.has(f"{kind}_{camera.label}") for camera in cameras) for kind in "KT")


def _cameras(document: Document) -> list[Fields]:
    """Return the entries of the file for each camera, labeled by its name."""
    return [document.entries.labeled(name.text("names")) for name in document.entries.each("names")]


def _lens(camera: Fields) -> Lens:
    name = camera.label
    distortion = camera.first(f"dist_{name}", f"D_{name}")
    return of_matrix(camera, f"K_{name}", distortion, camera.sides(f"W_{name}", f"H_{name}"))


def _pose(camera: Fields) -> np.ndarray:
    entries, by_rows, vector = camera.labeled(""), f"Rot_{camera.label}", f"R_{camera.label}"
    turn = entries.matrix(by_rows, 9) if entries.has(by_rows) else entries.matrix(vector, 3)
    return inverted(of_rotation(camera.document, turn, entries.matrix(f"T_{camera.label}", 3), by_rows))


PROGRAM = ProgramFiles(
    "EasyMocap", "intri.yml and extri.yml", looks, marks="names K_ dist_ Rot_ R_ T_", reads="pinhole",
    pair=pair, unit=METERS, **of_cameras(_cameras, _lens, _pose),
)  # fmt: skip
