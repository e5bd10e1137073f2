"""Load a data set of scenes that stand still back, and re-project every pixel of each view into the next one.

    python scripts/check_set.py FOLDER

Reads the NPZ files NAME_FRAME.npz and camera.json, as clevr_set.py writes them; needs numpy only. The cameras are made
of camera.json. A pixel's distance along its ray is a point; the next view's camera projects it. Where it comes out has
to be where ``flow_forward`` leads, and the next view's own distance there has to be the point's, unless ``flow_hidden``
says that something is before it. Exit status 1 where that is not so.
"""

if __name__ == "__main__":
    import ends  # it lies beside this file

    ends.begin(__file__)

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
from arguments import Parser

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

import camera_ray_caster as crc

FLOW = 1e-3
"""Pixels that the stored flow and the re-projection may be apart: distance and flow are float32."""

SAME = 0.97
"""Of the pixels that nothing hides, the part that has to land on a pixel of the same shape: the others meet an edge."""

NEAR = 0.02
"""Of the distance: the median of what nearest pixels may be apart, whose centers are up to 0.7 pixel away."""

ROW = "{:>12} {:>10} {:>10} {:>12} {:>12} {:>12} {:>12}"
HEAD = ROW.format("views", "pixels", "in next", "flow off", "same shape", "distance off", "hidden rightly")


def views(folder: Path) -> list[tuple[int, Path]]:
    """Return the frame and the file of each view, in order."""
    return sorted((int(path.stem.rpartition("_")[2]), path) for path in folder.glob("*_[0-9]*.npz"))


def check(folder: Path, first: tuple[int, Path], second: tuple[int, Path]) -> tuple[list[str], bool]:
    """Re-project a view into another one; return the row of the table, and whether all is as it has to be."""
    camera, other = (crc.camera_from_json(folder / "camera.json", frame=frame) for frame, _ in (first, second))
    here, there = (np.load(path) for _, path in (first, second))
    rays = camera.rays()
    hit = np.isfinite(here["distance"])
    points = rays.origins[hit] + here["distance"][hit][:, None].astype(float) * rays.directions[hit]
    stored = np.abs(rays.directions[hit] - here["ray_direction"][hit]).max()
    pixels = other.project(points)
    size = other.raster.size
    with np.errstate(invalid="ignore"):
        inside = ((pixels >= 0) & (pixels <= size)).all(axis=1)
    own = np.argwhere(hit)[:, ::-1] + 0.5
    flow, hidden = here["flow_forward"][hit], here["flow_hidden"][hit][:, 0]
    flow_off = np.abs(pixels - own - flow)[inside]
    edge = np.abs(pixels - np.clip(pixels, 0, size)).max(axis=1) < FLOW  # there rounding decides who is inside
    column, row = np.minimum(np.floor(pixels[inside]), np.array(size) - 1).astype(int).T
    same = there["shape_index"][row, column] == here["shape_index"][hit][inside]
    distance = np.linalg.norm(points[inside] - other.rays_at(*pixels[inside].T).origins, axis=1)
    off = np.abs(there["distance"][row, column] / distance - 1)
    seen, covered = ~hidden[inside], hidden[inside]
    nearer = (there["distance"][row, column] < distance)[covered].mean() if covered.any() else 1.0
    numbers = flow_off.max(initial=0.0), same[seen].mean(), np.median(off[seen]), nearer
    passed = (
        numbers[0] < FLOW and numbers[1] > SAME and numbers[2] < NEAR and nearer > 0.9 and stored < 1e-6
        and bool((np.isnan(flow[:, 0]) == ~inside)[~edge | inside].all())
    )  # fmt: skip
    names = f"{first[0]} to {second[0]}", f"{hit.sum():,}", f"{inside.mean():.1%}"
    values = f"{numbers[0]:.1e} px", f"{numbers[1]:.2%}", f"{numbers[2]:.1e}", f"{nearer:.1%}"
    return [*names, *values], passed


def main(arguments: list[str] | None = None) -> int:
    """Check a folder and print a table; return the exit status."""
    parser = Parser(prog="check_set.py", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="what clevr_set.py has made")
    folder = parser.parse_args(arguments).folder
    found = views(folder)
    if len(found) < 2 or not (folder / "camera.json").is_file():
        parser.error(f"{str(folder)!r} has no camera.json with two views NAME_FRAME.npz: make them with clevr_set.py")
    print(HEAD)
    passed = True
    for first, second in pairwise(found):
        row, right = check(folder, first, second)
        print(ROW.format(*row), flush=True)
        passed &= right
    print("all as it has to be" if passed else "the views do not fit together")
    return int(not passed)


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
