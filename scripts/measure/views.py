"""The views of a data set, re-projected into each other.

Reads what cast.py, dataset.py and clevr_set.py write, with the passes shape_index and distance (or depth); needs numpy
only, but bpy for EXR files. The cameras are made from the reports. A pixel's ray and distance give a point, which
another view's camera projects: the next view of the same camera if the set has the pass flow_forward, which is for
scenes that stand still; else each other camera's view of the same frame, or if there is none the next view, which has
to show the same objects at the same places. The other view's distance there must agree with the distance of the point,
and its shape with the point's, unless another surface hides the point, as ``flow_hidden`` or a smaller distance says.
The projection must agree with ``flow_forward``, and stored rays with the camera's. The exit status is 1 if a check
fails.
"""

from collections.abc import Iterator
from itertools import groupby, pairwise
from pathlib import Path

import numpy as np
from arguments import Parser

import camera_ray_caster as crc
from camera_ray_caster.core.sets import View, read_set

FLOW = 1e-3
"""Maximum difference in pixels between stored flow and re-projection: distance and flow are float32."""

SAME = 0.97
"""Minimum fraction of the unhidden pixels that must land on a pixel of the same shape; the rest lie at edges."""

NEAR = 0.02
"""Maximum median of the relative difference of distances: the nearest pixel's center is up to 0.7 pixel away."""

NEARER = 0.95
"""Part of a point's distance below which what is seen there hides it, if no pass says so."""

ROW = "{:>24} {:>10} {:>10} {:>12} {:>12} {:>12} {:>14}"
HEAD = ROW.format("views", "pixels", "in other", "flow off", "same shape", "distance off", "hidden rightly")


def pairs(views: list[View]) -> Iterator[tuple[View, View]]:
    """Yield the pairs of views that are compared."""
    frames: dict[float, list[View]] = {}
    for view in views:
        frames.setdefault(view.frame, []).append(view)
    flows = all(view.has("flow_forward") for view in views)
    several = max(map(len, frames.values())) > 1
    if flows or not several:
        for _, of_camera in groupby(views, key=lambda view: view.camera_name):
            yield from pairwise(of_camera)
    else:
        for there in frames.values():
            yield from ((first, second) for first in there for second in there if first is not second)


def distances(view: View, points: np.ndarray) -> np.ndarray:
    """Return the distances of points (..., 3) from the eye, or from where the rays of their pixels begin."""
    if view.camera.model.central:
        return np.linalg.norm(points - view.camera.pose.eye, axis=-1)
    pixels = view.camera.project(points)
    return np.linalg.norm(points - view.camera.rays_at(pixels[..., 0], pixels[..., 1]).origins, axis=-1)


def check(first: View, second: View) -> tuple[list[str], bool]:
    """Re-project a view into another view; return the row of the table, and whether all checks pass."""
    points, hit = first.points()
    raster = first.camera.raster
    points, own_pixels = points[hit], np.argwhere(hit)[:, ::-1] + 0.5 + (raster.x0, raster.y0)
    raster = second.camera.raster
    low, high = (raster.x0, raster.y0), (raster.x1, raster.y1)
    pixels = second.camera.project(points)
    with np.errstate(invalid="ignore"):
        inside = ((pixels >= low) & (pixels <= high)).all(axis=1)
    stored = 0.0
    if first.has("ray_direction"):
        stored = np.abs(first.camera.rays().directions[hit] - first.pixels("ray_direction")[hit]).max(initial=0.0)
    column, row = (np.minimum(np.floor(pixels[inside]), np.array(high) - 1).astype(int) - low).T
    same = second.pixels("shape_index")[row, column] == first.pixels("shape_index")[hit][inside]
    theirs, ends = second.points()
    with np.errstate(invalid="ignore"):
        there = np.where(ends, np.linalg.norm(theirs - second.camera.rays().origins, axis=-1), np.inf)[row, column]
    distance = distances(second, points[inside])
    flow_off, right = np.zeros(0), True
    if first.has("flow_forward"):
        flow, hidden = first.pixels("flow_forward")[hit], first.pixels("flow_hidden")[hit][:, 0].astype(bool)[inside]
        flow_off = np.abs(pixels - own_pixels - flow)[inside]
        away = np.abs(pixels - np.clip(pixels, 0, raster.size)).max(axis=1)  # NaN where there is no pixel
        edge = (away > 0) & (away < FLOW)  # rounding decides there
        right = bool((np.isnan(flow[:, 0]) == ~(away == 0))[~edge].all())
    else:
        hidden = there < NEARER * distance
    off = np.abs(there / distance - 1)
    seen = ~hidden
    nearer = (there < distance)[hidden].mean() if hidden.any() else 1.0
    share, middle = (same[seen].mean(), np.median(off[seen])) if seen.any() else (1.0, 0.0)
    passed = flow_off.max(initial=0.0) < FLOW and share > SAME and middle < NEAR and nearer > 0.9 and stored < 1e-6
    names = f"{first.name} to {second.name}", f"{hit.sum():,}", f"{inside.mean() if inside.size else 0:.1%}"
    worst = f"{flow_off.max(initial=0.0):.1e} px" if first.has("flow_forward") else "-"
    return [*names, worst, f"{share:.2%}", f"{middle:.1e}", f"{nearer:.1%}"], bool(passed and right)


def main(description: str) -> int:
    """Check a folder and print a table; return the exit status."""
    parser = Parser(prog="check_set.py", description=description)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder of a set")
    folder = parser.parse_args().folder
    passed = True
    try:
        views = read_set(folder)
        view_pairs = list(pairs(views))
        if not view_pairs:
            parser.error(f"{str(folder)!r} has one view: a set has two or more")
        print(HEAD)
        for first, second in view_pairs:
            row, right = check(first, second)
            print(ROW.format(*row), flush=True)
            passed &= right
    except crc.InputError as error:
        parser.error(str(error))
    except (OSError, ValueError, KeyError, IndexError) as error:
        parser.error(f"the set in {str(folder)!r} is damaged: {str(error).splitlines()[0]}")
    print("all as it has to be" if passed else "the views do not fit together")
    return int(not passed)
