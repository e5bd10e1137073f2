"""The section of a real lens through its axis and a pixel of the film, as a picture: glass, stop, film, and rays."""

from itertools import pairwise

import numpy as np

from ..cameras.real_lens import RealLens
from .lens_diagram import GlassPath, chief_path, fan_of, film_line, sections, stop_lines

SIDE = 360
"""Rows and columns of the picture."""
PICTURE_MARGIN, LENGTH_BEFORE_LENS = 0.04, 0.25
"""Parts of the picture left free on each side, and of the lens's length in which rays are drawn before it."""
GROUND = 0.11, 0.11, 0.12, 1.0
AXIS, GLASS, STOP, FILM = (0.35, 0.35, 0.35), (0.55, 0.8, 1.0), (0.95, 0.95, 0.95), (0.75, 0.75, 0.75)
CHIEF, FAN, STOPPED = (1.0, 0.45, 0.1), (1.0, 0.8, 0.3), (0.6, 0.25, 0.2)


def section(model: RealLens, x: float, y: float) -> np.ndarray:
    """Return the section with the rays of a pixel, (SIDE, SIDE, 4) float32 from the bottom; the scene is on the left.

    Upwards is the direction from the axis in which the pixel shows the scene.
    """
    a, b = map(float, model.on_film(x, y)[1])
    radius = np.hypot(a, b)
    up = np.array((a, b)) / radius if radius else np.array((0.0, 1.0))
    glass, stop, film = list(sections(model, 0.0)), stop_lines(model), film_line(model, up, float(radius))
    all_glass = np.concatenate([*glass, *stop, film])
    length = np.ptp(all_glass[:, 2])
    front = all_glass[:, 2].min() - LENGTH_BEFORE_LENS * length
    parts = [(np.array([(front, 0.0), (film[0, 2], 0.0)]), AXIS, 1.0)]
    parts += [(line[:, [2, 1]], GLASS, 1.4) for line in glass]
    parts += [(line[:, [2, 1]], STOP, 3.0) for line in stop]
    parts.append((film[:, [2, 1]], FILM, 3.0))
    fan = [(path, FAN, 0.8) for path in fan_of(model, x, y)]
    for path, color, width in (*fan, (chief_path(model, x, y), CHIEF, 1.8)):
        parts.append((_flat(path, up, front), STOPPED if path.direction is None else color, width))
    return _drawn(parts, np.array((front, all_glass[:, 2].max())), np.abs(all_glass[:, 1]).max())


def _flat(path: GlassPath, up: np.ndarray, front: float) -> np.ndarray:
    """Return a path in the plane of the section, (n, 2), on to the left end of the picture."""
    points = path.points
    if path.direction is not None and path.direction[2] < 0:
        way = (front - points[-1, 2]) / path.direction[2]
        points = np.concatenate((points, [points[-1] + max(way, 0.0) * path.direction]))
    return np.stack((points[:, 2], points[:, :2] @ up), axis=-1)


def _drawn(parts, across: np.ndarray, high: float) -> np.ndarray:
    """Return the picture of lines (n, 2) with their colors and widths in pixels."""
    image = np.tile(np.array(GROUND, np.float32), (SIDE, SIDE, 1))
    scale = SIDE * (1 - 2 * PICTURE_MARGIN) / max(np.ptp(across), 2 * high)
    for line, color, width in parts:
        places = (line - (across.mean(), 0.0)) * scale + SIDE / 2
        for start, end in pairwise(places):
            _stroke(image, start, end, color, width)
    return image


def _stroke(image: np.ndarray, start: np.ndarray, end: np.ndarray, color, width: float) -> None:
    """Draw a segment between two places in pixels, with a soft edge."""
    low = np.clip(np.floor(np.minimum(start, end) - width - 1), 0, SIDE).astype(int)
    high = np.clip(np.ceil(np.maximum(start, end) + width + 1), 0, SIDE).astype(int)
    x, y = np.arange(low[0], high[0]) + 0.5, np.arange(low[1], high[1])[:, None] + 0.5
    if not x.size or not y.size:
        return
    way = end - start
    along = np.clip(((x - start[0]) * way[0] + (y - start[1]) * way[1]) / max(float(way @ way), 1e-30), 0, 1)
    away = np.hypot(x - start[0] - along * way[0], y - start[1] - along * way[1])
    cover = np.clip(width / 2 + 0.5 - away, 0, 1)[..., None]
    window = image[low[1] : high[1], low[0] : high[0], :3]
    window[...] = window * (1 - cover) + cover * np.array(color, np.float32)
