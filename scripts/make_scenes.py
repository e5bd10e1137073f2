"""Make the example scenes by code: every .blend in blend_scenes/, and the README that lists them.

    python scripts/make_scenes.py            all of them
    python scripts/make_scenes.py NAME ...   only these, for example spheres_and_planes

Needs pip's bpy. Run it with bpy 4.5, the oldest supported version: newer versions can open its files.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

from make.scene_files import main

if __name__ == "__main__":
    sys.exit(ends.run(__file__, lambda: main(__doc__)))
