"""Time this caster against Blender, Cycles and the compiled ray tracers that are installed, in one run.

    python scripts/benchmark.py                 1920 x 1080: 10, 1,000, 10,000 and 100,000 spheres
    python scripts/benchmark.py --quick         the first two, fewer rounds
    python scripts/benchmark.py --meshes        triangle meshes, also against Open3D
    python scripts/benchmark.py --models        rays and pictures of every camera model
    python scripts/benchmark.py --redraws       every camera model in scenes of triangles, by processor time
    python scripts/benchmark.py --passes        each pass beside writing its array alone
    python scripts/benchmark.py --dataset       a data set of meshes: cost against writing alone, and two processes
    python scripts/benchmark.py --against v0.1.0    this checkout against a commit: casts and the rays of each model
    python scripts/benchmark.py --against v0.1.0 --same    whether the pictures of the example scenes are the same
    python scripts/benchmark.py --scaling --picture FILE.png    cost against pixels, shapes and triangles

In each round all contenders run in turn, so that other load on the machine affects all of them. A pause before each run
lets the threads of the previous contender come to rest. Times are in milliseconds: minimum, median, and spread (the
middle half of the rounds). Ratios are ratios of medians.
"""

from __future__ import annotations

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import json
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1] / "addon")]

import arguments  # noqa: E402  (it lies beside this file)
from kept_memory import keep_memory  # noqa: E402
from measure import contenders as c  # noqa: E402
from measure.turns import compare, spheres  # noqa: E402

COUNTS = (10, 1_000, 10_000, 100_000)


def main() -> int:
    """Run the benchmark that the arguments choose and print tables; with --json also write them."""
    parser = arguments.Parser(prog="benchmark.py", description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="run the smaller half of the scenes, with fewer rounds")
    parser.add_argument("--rounds", type=arguments.count, help="number of rounds; default: 9, or 3 with --quick")
    parser.add_argument("--threads", type=arguments.count, default=2, help="default: %(default)s")
    parser.add_argument(
        "--size", type=arguments.size, default=(1920, 1080), help="resolution in pixels; default: 1920x1080"
    )
    parser.add_argument("--meshes", action="store_true", help="measure triangle meshes of 1,000 to a million triangles")
    parser.add_argument(
        "--models", action="store_true", help="measure ray generation and casting for every camera model"
    )
    parser.add_argument(
        "--redraws", action="store_true", help="measure the pictures of a viewport, 574x287, of every camera model"
    )
    parser.add_argument("--passes", action="store_true", help="measure each pass beside writing its array alone")
    parser.add_argument("--scaling", action="store_true", help="measure the cost against pixels, shapes and triangles")
    parser.add_argument(
        "--dataset", action="store_true", help="measure pictures of a data set, with one process and with two"
    )
    parser.add_argument(
        "--against", metavar="COMMIT", help="compare the processor time of this checkout with that of another commit"
    )
    parser.add_argument(
        "--same", action="store_true", help="with --against: compare all passes of all example scenes, not times"
    )
    parser.add_argument("--picture", type=Path, metavar="FILE", help="draw a diagram; with --scaling only")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the measurements to this file")
    options = parser.parse_args()
    keep_memory()
    for path in filter(None, (options.json, options.picture)):
        if not path.absolute().parent.is_dir():
            parser.error(f"there is no folder for {str(path)!r}: create the folder or choose another folder")
    if options.same and not options.against:
        parser.error("--same compares two checkouts: add --against COMMIT")
    width, height = options.size
    rounds = options.rounds or (3 if options.quick else 9)
    if options.against:
        from measure import against, same_pictures

        try:
            if options.same:
                figures = same_pictures.run(options.against)
            else:
                figures = against.run(options.against, rounds, options.size)
        except LookupError as error:
            parser.error(str(error))
    elif options.passes:
        from measure import by_pass

        figures = by_pass.run(options.size, rounds)
    elif options.models:
        from measure import by_model

        figures = by_model.run(width, height, rounds, options.threads)
    elif options.redraws:
        from measure import redraws

        figures = redraws.run(rounds, options.threads, (574, 287))
    elif options.meshes:
        from measure import mesh_contest

        figures = mesh_contest.run(compare, options.quick, width, height, rounds, options.threads)
    elif options.dataset:
        from measure import dataset_speed

        figures = dataset_speed.run(8 if options.quick else 100)
    elif options.scaling:
        from measure import scaling

        figures = scaling.run(rounds, options.threads, options.quick)
        if options.picture:
            scaling.draw(figures, options.picture)
    else:
        counts = COUNTS[:2] if options.quick else COUNTS
        figures = [row for count in counts for row in spheres(count, width, height, rounds, options.threads)]
        figures += blender(width, height, options.threads, min(rounds, 3))
    if options.json:
        options.json.write_text(json.dumps(figures, indent=1) + "\n")
    return 0


def blender(width: int, height: int, threads: int, rounds: int) -> list[dict]:
    """Time ``scene.ray_cast`` in a loop, and Cycles at one sample with the same passes, if bpy is installed."""
    if not c.has("bpy"):
        print("\nBlender: not installed here")
        return []
    from measure import in_blender

    return in_blender.run(*c.scene(10, width, height), c.PASSES, threads, rounds)


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
