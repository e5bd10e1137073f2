"""Measure error against run time: every method on each scene, compared with the exact picture of 60 digits.

    python scripts/work_precision.py                        the chosen extreme cases, and the diagram
    python scripts/work_precision.py FILE.blend planet      a file's camera and shapes, and the cases named "planet"
    python scripts/work_precision.py --only samples         one family of methods, on its own scenes

Needs the packages of the ``test`` extra. Writes work_precision.json, .svg and .png into --output, and prints tables.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT)]


def measured() -> int:
    """Measure and return the exit status: 2 if a package is missing."""
    try:
        from measure.precision.run import main
    except ModuleNotFoundError as missing:
        print(f"work_precision.py: {missing}: install the packages of the test extra", file=sys.stderr)
        return 2
    return main(__doc__.splitlines()[0])


if __name__ == "__main__":
    sys.exit(ends.run(__file__, measured))
