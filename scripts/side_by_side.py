"""Compare other ray tracers on the extreme cases: how many cases each gets right, and with which error.

    python scripts/side_by_side.py                 prints a table in Markdown
    python scripts/side_by_side.py --details       also prints the error of each tracer on each case
    python scripts/side_by_side.py planet lens     only the cases with one of these words in their names

Needs bpy and the packages of the extras ``test`` and ``compare``; the table marks tracers that are not installed. All
tracers get the same rays, the exact chief rays rounded to the tracer's precision, except Cycles, which makes its own
rays from the camera.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT), str(ROOT / "scripts")]


def main() -> int:
    """Run every tracer on every case and print the table."""
    from camera_ray_caster.blender.process.standard_output import keep_output

    keep_output()
    try:
        from arguments import Parser
        from measure.precision import comparison, words
    except ModuleNotFoundError as missing:
        print(f"side_by_side.py: {missing}: install the packages of the test extra", file=sys.stderr)
        return 2
    parser = Parser(prog="side_by_side.py", description=__doc__.splitlines()[0])
    parser.add_argument(
        "cases", nargs="*", metavar="CASE", help="part of the name of extreme cases; default: all cases"
    )
    parser.add_argument("--details", action="store_true", help="list every case")
    options = parser.parse_args()
    names, errors = comparison.compared(words.cases_named(parser, options.cases))
    print(comparison.table(names, errors))
    if options.details:
        print(comparison.details(names, errors))
    return 0


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
