"""The extreme cases through other ray tracers: how many each gets right, and to which error.

    python scripts/side_by_side.py                 prints a table in Markdown
    python scripts/side_by_side.py --details       and what each tracer made of each case
    python scripts/side_by_side.py planet lens     the cases with one of these in their names

Needs the packages of the ``test`` extra, bpy and those of the ``compare`` extra; of a tracer that is not installed the
table says so. All get the same rays, the exact chief rays rounded to their own precision, but Cycles, which makes its
own from the camera.
"""

if __name__ == "__main__":
    import ends  # it lies beside this file

    ends.begin(__file__)

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT), str(ROOT / "scripts")]


def main() -> int:
    """Run every tracer on every case and print the table."""
    from camera_ray_caster.blender.terminal.standard_output import keep_output

    keep_output()
    try:
        from arguments import Parser
        from precision import comparison, words
    except ModuleNotFoundError as missing:
        print(f"side_by_side.py: {missing}: install the packages of the test extra", file=sys.stderr)
        return 2
    parser = Parser(prog="side_by_side.py", description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="*", metavar="CASE", help="a part of the names of extreme cases; default: all")
    parser.add_argument("--details", action="store_true", help="list each case")
    options = parser.parse_args()
    names, found = comparison.compared(words.cases_named(parser, options.cases))
    print(comparison.table(names, found))
    if options.details:
        print(comparison.details(names, found))
    return 0


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
