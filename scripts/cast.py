"""Cast the rays of a .blend's cameras: write pictures, passes and reports.

    python scripts/cast.py FILE.blend                                      with pip's bpy
    blender --background FILE.blend --python scripts/cast.py -- --frame 1  inside Blender

``python scripts/cast.py --help`` lists all options.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # Blender does not add it

import ends

if __name__ == "__main__":
    ends.begin(__file__)
    from door import through

    sys.exit(ends.run(__file__, lambda: through("cast")))
