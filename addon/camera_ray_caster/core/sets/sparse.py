"""A COLMAP model of a set, with seed points: images, sparse/0, and points of the surfaces with their tracks.

Points are hits of random pixels, of a fixed seed, the same number in each view; a track has every view that sees the
point: there its projection lies in the picture, and the distance to it is that of the pixel's hit, up to the difference
that the surface makes within a pixel. Gaussian splatting starts from such points, and leaves
out the pictures in test.txt, those for validation.
Reference: COLMAP documentation, Output Format.
"""

from itertools import chain

import numpy as np

from ..exports import remarks
from ..programs.colmap import IMAGES, POINTS, texts
from ..records import InputError
from .finished_set import VALIDATION, Files, View
from .png import srgb
from .set_formats import SetFormat
from .streams import Tracks, Waiting, records_of

POINT_COUNT = 10_000
"""Number of points of a set."""

BESIDE = 1.5
"""Pixels by which the neighbors of a hit tell how far its distance may differ from the one that a view has there."""


def files(views: list[View], count: int = POINT_COUNT) -> Files:
    """Yield the files of a model; see the package. Raises InputError for cameras that COLMAP cannot represent."""
    cameras, images = texts(records_of("colmap", views))
    head = remarks("colmap", [views[0].shot])
    places, colors = _seeds(views, count)
    tracks, lines = Tracks(len(places)), Waiting()
    for number, (view, (line, _)) in enumerate(zip(views, images, strict=True), 1):
        rows, pixels = _seen(view, places)
        tracks.add(number, rows)
        observations = zip(rows.tolist(), pixels.tolist(), strict=True)
        lines.add(f"{line} {view.name}.png\n", "")
        lines.add(" ".join(f"{x!r} {y!r} {row + 1}" for row, (x, y) in observations) + "\n", "")
    yield "sparse/0/cameras.txt", head + cameras
    yield "sparse/0/images.txt", chain([head + IMAGES], lines)
    points = enumerate(zip(places.tolist(), colors.tolist(), tracks, strict=True), 1)
    yield "sparse/0/points3D.txt", chain([POINTS], (
        f"{row} {' '.join(map(repr, position))} {' '.join(map(str, color))} 0 {track}\n"
        for row, (position, color, track) in points
    ))  # fmt: skip
    if views[0].split:
        yield "sparse/0/test.txt", "".join(f"{view.name}.png\n" for view in views if view.split == VALIDATION)
    for view in views:
        yield from view.picture_as(f"images/{view.name}.png")


def _seeds(views: list[View], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points on surfaces, (n, 3) float64, and their colors, (n, 3) uint8."""
    random = np.random.default_rng(0)
    places, colors = [], []
    for view in views:
        points, hit = view.points()
        row, column = np.nonzero(hit)
        chosen = random.permutation(len(row))[: -(-count // len(views))]
        row, column = row[chosen], column[chosen]
        places.append(points[row, column])
        gray = np.full((len(row), 3), 128, np.uint8)
        colors.append(srgb(view.pixels("combined")[row, column, :3]) if view.has("combined") else gray)
    seeds, of = np.concatenate(places)[:count], np.concatenate(colors)[:count]
    if not len(seeds):
        raise InputError("no ray of the set hits anything: there are no seed points")
    return seeds, of


def _seen(view: View, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the rows of points that a view sees, and where: x and y from the top left corner, y down."""
    camera, raster = view.camera, view.camera.raster
    points, hit = view.points()
    pixels = camera.project(places)
    with np.errstate(invalid="ignore"):
        column, row = np.floor(pixels[:, 0]) - raster.x0, np.floor(pixels[:, 1]) - raster.y0
        inside = (column >= 0) & (column < hit.shape[1]) & (row >= 0) & (row < hit.shape[0])
    rows = np.flatnonzero(inside)
    row, column = row[rows].astype(int), column[rows].astype(int)
    eye = camera.pose.eye
    with np.errstate(invalid="ignore"):
        distances = np.where(hit, np.linalg.norm(points - eye, axis=-1), np.nan)
    low, high = _around(distances)
    distance = np.linalg.norm(places[rows] - eye, axis=1)
    same = (distance >= low[row, column]) & (distance <= high[row, column])
    rows = rows[same]
    x0, _, _, y1 = raster.picture
    return rows, (pixels[rows] - (x0, y1)) * (1, -1)


def _around(distances: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the largest distance that a surface through a pixel's hit may have within the pixel: by the
    smaller of the differences to both neighbors along each axis.
    """
    slack = np.zeros_like(distances)
    for axis in (0, 1):
        before = np.abs(np.diff(distances, axis=axis, prepend=np.nan))
        after = np.abs(np.diff(distances, axis=axis, append=np.nan))
        slack += np.nan_to_num(np.fmin(before, after))
    slack = BESIDE * slack + 1e-6 * np.nan_to_num(distances)
    return distances - slack, distances + slack


FORMAT = {"colmap-scene": SetFormat(
    "COLMAP: images, sparse/0, seed points with tracks from the hits", files, splits=True, option="points"
)}  # fmt: skip
