"""Check a data set: re-project every pixel of each view into another view.

    python scripts/check_set.py FOLDER

Reads what cast.py, dataset.py and clevr_set.py write: see measure/views.py. The exit status is 1 if a check fails.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

from measure.views import main

if __name__ == "__main__":
    sys.exit(ends.run(__file__, lambda: main(__doc__.splitlines()[0])))
