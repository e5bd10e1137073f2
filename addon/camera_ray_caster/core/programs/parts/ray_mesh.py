"""Meshes of rays: a ray for each of some places in the picture, which lie in even rows and columns.

A .csv or .txt has a first line of names, then a ray a line: x and y of the place from the bottom left of the picture,
or u and v from its top left, both 0 to 1; dx, dy, dz of the direction, and ox, oy, oz of the origin if there is any;
nan where there is no ray. In an .obj a vertex is an origin, its normal the direction, and its texture coordinates
the place from the bottom left, as in the camera of a mesh that POV-Ray and bakers of textures have. Rays between the
places are those of the Ray Table.
Reference: Wavefront, Advanced Visualizer Manual, appendix B1 (Object Files); POV-Ray documentation, mesh_camera.
"""

import numpy as np

from .document import Document
from .lens import Lens
from .ray_arrays import table

DIRECTION, ORIGIN = ("dx", "dy", "dz"), ("ox", "oy", "oz")
PLACES = ("x", "y"), ("u", "v")
LINES = b"\nv ", b"\nvt ", b"\nvn ", b"\nf "
"""Begins of the lines that an .obj has."""

EVEN = 1e-4
"""Part of a step by which places may be off their rows and columns: files have some six digits."""

FARTHEST = 4.0
"""Largest coordinate of a place: pixels in place of fractions are refused."""


def looks(document: Document) -> bool:
    """Whether it is a mesh of rays."""
    return not document.is_binary and (_head(document) is not None or _is_mesh(document))


def lens_of(document: Document) -> Lens:
    """Return the lens of a mesh of rays. Raises InputError."""
    head = _head(document)
    return _lattice(document, *(_of_mesh(document) if head is None else _of_columns(document, *head)))


def _head(document: Document) -> tuple[list[str], tuple[str, str]] | None:
    """Return the names of a table's columns, and those of places; None of any other file."""
    begin = document.data[:4096].decode("utf-8", "replace").lstrip("\ufeff#").split("\n", 1)[0]
    names = begin.lower().replace(",", " ").replace(";", " ").split()
    places = next((pair for pair in PLACES if set(pair) <= set(names)), None)
    return (names, places) if places is not None and set(DIRECTION) <= set(names) else None


def _is_mesh(document: Document) -> bool:
    return all(line in b"\n" + document.data for line in LINES)


def _of_columns(document: Document, names: list[str], places: tuple[str, str]):
    """Return the places (n, 2) from the bottom left, directions (n, 3), and origins or None of a table with names."""
    rows = []
    for number, line in enumerate(document.text.splitlines()[1:], 2):
        document.check()
        words = line.replace(",", " ").replace(";", " ").split()
        if words and not words[0].startswith("#"):
            rows.append(_numbers(document, words, len(names), f"line {number}"))
    columns = dict(zip(names, np.array(rows).reshape(-1, len(names)).T, strict=True))
    positions, directions = (np.stack([columns[name] for name in group], axis=1) for group in (places, DIRECTION))
    if places == PLACES[1]:
        positions[:, 1] = 1 - positions[:, 1]
    origins = np.stack([columns[name] for name in ORIGIN], axis=1) if set(ORIGIN) <= set(names) else None
    return positions, directions, origins


def _of_mesh(document: Document):
    """Return the places, directions and origins of the corners of an .obj's faces, each place once."""
    vectors: dict[str, list] = {"v": [], "vt": [], "vn": []}
    corners = set()
    for number, line in enumerate(document.text.splitlines(), 1):
        document.check()
        kind, *words = line.split() or [""]
        if kind in vectors:
            count = 2 if kind == "vt" else 3
            vectors[kind].append(_numbers(document, words[:count], count, f"line {number}"))
        elif kind == "f":
            corners |= {tuple(word.split("/")) for word in words}
    try:
        picked = [[int(word) for word in corner] for corner in corners]
        index = np.array([[k - 1 if k > 0 else k for k in corner] for corner in picked]).reshape(-1, 3)
        each = [np.array(vectors[kind])[index[:, column]] for column, kind in enumerate(("v", "vt", "vn"))]
    except (ValueError, IndexError) as error:
        raise document.refusal("each corner of a face must be v/vt/vn: vertex, place in the picture, normal") from error
    origins, places, directions = each
    _, first = np.unique(index[:, 1], return_index=True)
    return places[first], directions[first], origins[first]


def _numbers(document: Document, words: list[str], count: int, where: str) -> list[float]:
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        numbers = []
    if len(numbers) != count:
        raise document.refusal(f"{where} must be {count} numbers")
    return numbers


def _lattice(document: Document, places: np.ndarray, directions: np.ndarray, origins: np.ndarray | None) -> Lens:
    """Return the lens of rays at places that lie in even rows and columns, one at each crossing."""
    if not len(places) or not (np.abs(places) <= FARTHEST).all():
        raise document.refusal("places must be numbers from 0 to 1 over the picture, one or more")
    columns, rows = (_steps(document, axis, name) for axis, name in zip(places.T, ("x", "y"), strict=True))
    wide, high = columns[1].max() + 1, rows[1].max() + 1
    taken = np.zeros((high, wide), int)
    np.add.at(taken, (rows[1], columns[1]), 1)
    if (taken != 1).any():
        row, column = np.argwhere(taken != 1)[0].tolist()
        raise document.refusal(
            f"rows are of unequal length: {taken[row, column]} rays at column {column}, row {row} of {wide} x {high}; "
            "give one ray for each, nan where there is none"
        )
    order = np.lexsort((columns[1], rows[1]))
    grids = [vectors[order].reshape(high, wide, 3) for vectors in (directions, origins) if vectors is not None]
    area = [(first - step / 2, first + (count - 0.5) * step)
            for (first, step), count in ((columns[0], wide), (rows[0], high))]  # fmt: skip
    (left, right), (bottom, top) = area
    lens = table(document, grids[0], grids[1] if grids[1:] else None, np.array((left, bottom, right, top)))
    sides = "calibration_width", "calibration_height"  # the picture's size is not in the file
    return lens._replace(settings={name: value for name, value in lens.settings.items() if name not in sides})


def _steps(document: Document, values: np.ndarray, name: str) -> tuple[tuple[float, float], np.ndarray]:
    """Return the first value and the step of even values, and the number of steps at which each lies."""
    known = np.sort(values)
    apart = np.diff(known)
    step = np.median(apart[apart > apart.max() / 2]) if np.ptp(known) > 0 else 0.0
    count = np.rint((known[-1] - known[0]) / step) if step else 0
    if count < 1 or count > len(known):
        raise document.refusal(f"its places have one {name} only: a mesh of rays needs two rows and columns, or more")
    step = (known[-1] - known[0]) / count
    at = (values - known[0]) / step
    if not (np.abs(at - np.rint(at)) <= EVEN * count).all():
        raise document.refusal(f"its places are not even in {name}: give rays at equal steps")
    return (float(known[0]), float(step)), np.rint(at).astype(int)
