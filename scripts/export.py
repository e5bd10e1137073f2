"""Write the cameras of a .blend, by frame, for other programs: COLMAP, nerfstudio, OpenCV and others.

    python scripts/export.py FILE.blend --format colmap --cameras ALL --frames 1:24        with pip's bpy
    blender --background FILE.blend --python scripts/export.py -- --format json            inside Blender

``python scripts/export.py --help`` lists all options.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # Blender does not add it

import ends

if __name__ == "__main__":
    ends.begin(__file__)
    from door import through

    sys.exit(ends.run(__file__, lambda: through("export")))
