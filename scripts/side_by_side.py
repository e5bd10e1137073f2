"""The extreme cases through other ray tracers: how many each gets right, and to which error.

    python scripts/side_by_side.py                 prints a table in Markdown
    python scripts/side_by_side.py --details       and what each tracer made of each case

Needs bpy and the packages of the ``compare`` extra; a tracer that is not installed is left out by name. All get the
same rays, the exact chief rays rounded to their own precision, but Cycles, which makes its own from the camera.
"""

import argparse
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT), str(ROOT / "scripts")]


def main() -> int:
    """Run every tracer on every case and print the table."""
    from precision import comparison

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--details", action="store_true", help="list each case")
    options = parser.parse_args()
    names, found = comparison.compared()
    print(comparison.table(names, found))
    if options.details:
        print(comparison.details(names, found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
