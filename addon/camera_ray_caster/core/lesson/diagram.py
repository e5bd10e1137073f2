"""A diagram of a camera in space, as points and line segments: its image in front of it, and some of its rays."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..camera.camera import Camera
from ..casting.pixels import passes_at
from ..maths.vector import matvec
from ..records import Shapes

GRID_LINES = 9
"""Lines across and up the image; the first and the last are its border."""

LINE_POINTS = 65
"""Number of points per line: most models bend lines."""

MISS, NORMAL, LIFT = 1.25, 0.03, 0.002
"""Lengths in units of the longest ray that hits: of a ray that hits nothing, of a normal, and of the lift of hit points
off their surface, which would hide half of them otherwise.
"""


PROBED = "ray_origin", "ray_direction", "distance", "shape_index", "valid"
"""Passes from which a ``Probe`` is made."""


@dataclass(frozen=True)
class Probe:
    """Ray of one pixel and its hit."""

    pixel: tuple[int, int]
    """Column and row in the full frame, from the bottom left."""
    view: tuple[float, float]
    """Center of the pixel in normalized view coordinates."""
    origin: np.ndarray
    direction: np.ndarray
    """Origin and direction in the world, (3,) each; NaN if the pixel has no ray."""
    distance: float
    """Distance of the hit; inf if nothing is hit."""
    name: str
    """Name of the object that is hit; empty if nothing is hit."""
    shape_index: int


@dataclass(frozen=True)
class Diagram:
    """Diagram of a camera in the world. Segments are (n, 2, 3) float32, points (n, 3) float32."""

    border: np.ndarray
    """The image's border, and for a planar image lines from the rays' origins to its corners."""
    grid: np.ndarray
    """Lines of constant pixel coordinates across the image."""
    basis: np.ndarray
    """Axes u, v and w."""
    hit_rays: np.ndarray
    missed_rays: np.ndarray
    hits: np.ndarray
    """Hit points, lifted off their surface."""
    normals: np.ndarray


def diagram(camera: Camera, shapes: Shapes, size: float, rays_across: int) -> Diagram:
    """Return the diagram of a camera at its current frame.

    ``size`` is the distance (Blender units) of the image from the rays' origins: the depth of a planar image, the
    radius of any other. ``rays_across`` rays are drawn across the render window; the number of rays up makes their
    spacing square.
    """
    raster = camera.raster
    height, width = raster.shape
    rays_up = max(1, round(rays_across * height * raster.pixel_aspect / width))
    columns, rows = raster.x0 + _spread(width, rays_across), raster.y0 + _spread(height, rays_up)
    passes = ("ray_origin", "ray_direction", "distance", "position", "normal", "valid")
    images = passes_at(camera, shapes, columns, rows, passes)
    flat = {name: image.reshape(-1, *image.shape[2:]) for name, image in images.items()}
    hit = np.isfinite(flat["distance"])
    missed = flat["valid"] & ~hit
    longest = flat["distance"][hit].max(initial=0.0) or 10 * size
    ends = flat["ray_origin"] + MISS * longest * flat["ray_direction"]
    hits, normals = flat["position"][hit], flat["normal"][hit]
    across, up = _image(camera, size)
    border = np.concatenate((across[[0, -1]], up[[0, -1]]))
    u, v, z = camera.pose.basis.T
    edges = [segments_of(border), *([_corners(camera, size)] if camera.model.planar else [])]
    return Diagram(
        border=_drawn(np.concatenate(edges)),
        grid=_drawn(segments_of(np.concatenate((across[1:-1], up[1:-1])))),
        basis=_drawn(np.stack([(camera.pose.eye, camera.pose.eye + size * axis) for axis in (u, v, -z)])),
        hit_rays=_drawn(np.stack((flat["ray_origin"][hit], hits), axis=1)),
        missed_rays=_drawn(np.stack((flat["ray_origin"], ends), axis=1)[missed]),
        hits=(hits + LIFT * longest * normals).astype(np.float32),
        normals=_drawn(np.stack((hits, hits + NORMAL * longest * normals), axis=1)),
    )


def probe(camera: Camera, shapes: Shapes, column: int, row: int, **options) -> Probe:
    """Return the ray of one pixel of the full frame and its hit; ``options`` are those of ``passes_at``."""
    images = passes_at(camera, shapes, np.array([column]), np.array([row]), PROBED, **options)
    return probe_of(camera, shapes, column, row, images)


def probe_of(camera: Camera, shapes: Shapes, column: int, row: int, images: Mapping[str, np.ndarray]) -> Probe:
    """Return the ray of one pixel and its hit from the passes PROBED, (1, 1[, channels]) each."""
    values = {name: images[name][0, 0] for name in PROBED}
    index = int(values["shape_index"])
    raster = camera.raster
    blank = np.full(3, np.nan)
    return Probe(
        pixel=(column, row),
        view=(2 * (column + 0.5) / raster.width - 1, 2 * (row + 0.5) / raster.height - 1),
        origin=values["ray_origin"] if values["valid"] else blank,
        direction=values["ray_direction"] if values["valid"] else blank,
        distance=float(values["distance"]),
        name=shapes.names[shapes.name_index[index]] if index >= 0 else "",
        shape_index=index,
    )


def pixel_outline(camera: Camera, size: float, column: int, row: int) -> np.ndarray:
    """Return the segments (n, 2, 3) of a pixel's outline on the image in space: see ``diagram``."""
    x, y = column + np.array([0.0, 1.0, 1.0, 0.0, 0.0]), row + np.array([0.0, 0.0, 1.0, 1.0, 0.0])
    return _drawn(segments_of(_ahead(camera, size, x, y)[None]))


def _spread(count: int, wanted: int) -> np.ndarray:
    """Return the indices of up to ``wanted`` of ``count`` pixels, each in the middle of one of as many equal parts."""
    wanted = min(count, wanted)
    return ((2 * np.arange(wanted) + 1) * count) // (2 * wanted)


def _image(camera: Camera, size: float):
    """Return the lines of constant x and of constant y across the frame, (GRID_LINES, LINE_POINTS, 3) each."""
    raster = camera.raster
    fixed, free = np.linspace(0, 1, GRID_LINES)[:, None], np.linspace(0, 1, LINE_POINTS)[None, :]
    return (
        _ahead(camera, size, raster.width * fixed, raster.height * free),
        _ahead(camera, size, raster.width * free, raster.height * fixed),
    )


def _corners(camera: Camera, size: float) -> np.ndarray:
    """Return segments from the rays' origins to the corners of the image, (4, 2, 3)."""
    raster = camera.raster
    x, y = np.array([0.0, 0.0, 1.0, 1.0]) * raster.width, np.array([0.0, 1.0, 0.0, 1.0]) * raster.height
    return np.stack((_ahead(camera, 0.0, x, y), _ahead(camera, size, x, y)), axis=1)


def _ahead(camera: Camera, t: float, x, y) -> np.ndarray:
    """Return the points (..., 3) at t along the rays of pixel coordinates; NaN where there is no ray."""
    origin, direction = camera.camera_rays(x, y)
    points = matvec(camera.pose.basis, tuple(a + t * b for a, b in zip(origin, direction, strict=True)))
    shape = np.broadcast_shapes(np.shape(x), np.shape(y))
    return np.stack([np.broadcast_to(component, shape) for component in points], axis=-1) + camera.pose.eye


def segments_of(lines: np.ndarray) -> np.ndarray:
    """Return the segments (n, 2, 3) of lines (k, points, 3)."""
    return np.stack((lines[:, :-1], lines[:, 1:]), axis=2).reshape(-1, 2, 3)


def _drawn(segments: np.ndarray) -> np.ndarray:
    """Return the segments whose ends are both finite, as float32 for the graphics card."""
    return segments[np.isfinite(segments).all(axis=(1, 2))].astype(np.float32)
