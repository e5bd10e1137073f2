"""Make the gallery's pictures with the terminal command, from the scenes of blend_scenes/.

    python scripts/make_pictures.py            all of them
    python scripts/make_pictures.py NAME ...   only these, for example fisheye_stereographic

A name that ends in _by_cycles means the picture that Cycles renders of the same scene through the same camera, with
Cycles' lighting.

Needs pip's bpy.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

from make.pictures import main

if __name__ == "__main__":
    sys.exit(ends.run(__file__, lambda: main(__doc__)))
