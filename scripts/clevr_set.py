"""Make a small data set in the style of CLEVR with a fisheye camera: pictures by Cycles and their ground truth.

    python scripts/clevr_set.py --output clevr     makes the data set
    python scripts/check_set.py clevr              loads it, and re-projects each view into the next

Files of each view: a PNG; an NPZ with Cycles' linear picture and our depth, distance, normals, indices, rays and flow
of the same pixels; a report; boxes and masks in COCO's format. Common files: clevr.blend, camera.json,
annotations.json.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

from make.clevr_set import main

if __name__ == "__main__":
    sys.exit(ends.run(__file__, lambda: main(__doc__.splitlines()[0])))
