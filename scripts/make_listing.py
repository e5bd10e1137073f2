"""Make the images of the extension's page in listing/; the project's README also shows some of them.

    python scripts/make_listing.py                    icon and featured image, from scenes of blend_scenes/
    python scripts/make_listing.py --windows FOLDER   screenshots and the animated picture, from the tests in a window

The tests in a window (`make test-blender`) leave their screenshots in out/gui. Needs pip's bpy, and Pillow, which comes
with Matplotlib.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

from make.listing import main

if __name__ == "__main__":
    sys.exit(ends.run(__file__, lambda: main(__doc__)))
