"""Check a data set of a static scene: re-project every pixel of each view into the next view.

    python scripts/check_set.py FOLDER

Reads NAME_FRAME.npz and camera.json, as clevr_set.py writes them; needs numpy only. The cameras are made from
camera.json. A pixel's ray and distance give a point, which the next view's camera projects. The projection must agree
with ``flow_forward``, and the next view's distance there with the distance of the point, unless ``flow_hidden`` says
that another surface hides the point. The exit status is 1 if a check fails.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from itertools import pairwise
from pathlib import Path
from zipfile import BadZipFile

import numpy as np
from arguments import Parser

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

import camera_ray_caster as crc

FLOW = 1e-3
"""Maximum difference in pixels between stored flow and re-projection: distance and flow are float32."""

SAME = 0.97
"""Minimum fraction of the unhidden pixels that must land on a pixel of the same shape; the rest lie at edges."""

NEAR = 0.02
"""Maximum median of the relative difference of distances: the nearest pixel's center is up to 0.7 pixel away."""

ROW = "{:>12} {:>10} {:>10} {:>12} {:>12} {:>12} {:>12}"
HEAD = ROW.format("views", "pixels", "in next", "flow off", "same shape", "distance off", "hidden rightly")


def views(folder: Path) -> list[tuple[int, Path]]:
    """Return the frame and the file of each view, in order."""
    found = [(path.stem.rpartition("_")[2], path) for path in folder.glob("*_*.npz")]
    return sorted((int(digits), path) for digits, path in found if digits.isdecimal())


def check(folder: Path, first: tuple[int, Path], second: tuple[int, Path]) -> tuple[list[str], bool]:
    """Re-project a view into another view; return the row of the table, and whether all checks pass."""
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
    edge = np.abs(pixels - np.clip(pixels, 0, size)).max(axis=1) < FLOW  # rounding decides there
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
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="folder made by clevr_set.py")
    folder = parser.parse_args(arguments).folder
    found = views(folder)
    if len(found) < 2 or not (folder / "camera.json").is_file():
        parser.error(f"{str(folder)!r} has no camera.json with two views NAME_FRAME.npz: make them with clevr_set.py")
    print(HEAD)
    passed = True
    for first, second in pairwise(found):
        try:
            row, right = check(folder, first, second)
        except crc.InputError as error:
            parser.error(str(error))
        except (OSError, ValueError, KeyError, BadZipFile) as error:
            names = " or ".join(repr(path.name) for _, path in (first, second))
            parser.error(f"{names} is no view made by clevr_set.py: {str(error).splitlines()[0]}")
        print(ROW.format(*row), flush=True)
        passed &= right
    print("all as it has to be" if passed else "the views do not fit together")
    return int(not passed)


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
