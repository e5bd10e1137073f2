"""The measurements of scripts/benchmark.py: which one the command line chooses."""

from __future__ import annotations

import json
from pathlib import Path

import arguments
from kept_memory import keep_memory

from . import contenders as c
from .turns import compare, spheres

COUNTS = (10, 1_000, 10_000, 100_000)


def main(description: str) -> int:
    """Run the benchmark that the arguments choose and print tables; with --json also write them."""
    parser = arguments.Parser(prog="benchmark.py", description=description)
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
    parser.add_argument("--rays", action="store_true", help="measure rays given as arrays, by processor time")
    parser.add_argument(
        "--redraws", action="store_true", help="measure the pictures of a viewport, 574x287, of every camera model"
    )
    parser.add_argument("--passes", action="store_true", help="measure each pass beside writing its array alone")
    parser.add_argument(
        "--casts", action="store_true", help="measure whole casts beside writing their arrays, with one thread and two"
    )
    parser.add_argument("--renders", action="store_true", help="measure F12 beside the cast alone")
    parser.add_argument("--scaling", action="store_true", help="measure the cost against pixels, shapes and triangles")
    parser.add_argument(
        "--dataset", action="store_true", help="measure pictures of a data set, with one process and with two"
    )
    parser.add_argument(
        "--sets", action="store_true", help="measure sets of many small pictures: processor time, memory and bytes"
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
    if not (options.casts or options.renders):  # which are timed as users cast
        keep_memory()
    for path in filter(None, (options.json, options.picture)):
        if not path.absolute().parent.is_dir():
            parser.error(f"there is no folder for {str(path)!r}: create the folder or choose another folder")
    if options.same and not options.against:
        parser.error("--same compares two checkouts: add --against COMMIT")
    width, height = options.size
    rounds = options.rounds or (3 if options.quick else 9)
    if options.against:
        from . import against, same_pictures

        try:
            if options.same:
                figures = same_pictures.run(options.against)
            else:
                figures = against.run(options.against, rounds, options.size)
        except LookupError as error:
            parser.error(str(error))
    elif options.passes:
        from . import by_pass

        figures = by_pass.run(options.size, rounds)
    elif options.casts:
        from . import whole_casts

        figures = whole_casts.run(options.size, rounds)
    elif options.renders:
        from . import renders

        figures = renders.run(options.size, rounds)
    elif options.models:
        from . import by_model

        figures = by_model.run(width, height, rounds, options.threads)
    elif options.rays:
        from . import given_rays

        figures = given_rays.run(rounds, options.quick)
    elif options.redraws:
        from . import redraws

        figures = redraws.run(rounds, options.threads, (574, 287))
    elif options.meshes:
        from . import mesh_contest

        figures = mesh_contest.run(compare, options.quick, width, height, rounds, options.threads)
    elif options.dataset:
        from . import dataset_speed

        figures = dataset_speed.run(8 if options.quick else 100)
    elif options.sets:
        from . import sets

        figures = sets.run(sets.COUNTS[:1] if options.quick else sets.COUNTS)
    elif options.scaling:
        from . import scaling

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
    from . import in_blender

    return in_blender.run(*c.scene(10, width, height), c.PASSES, threads, rounds)
