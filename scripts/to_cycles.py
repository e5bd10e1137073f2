"""Save a copy of a .blend whose camera renders in Cycles with our rays, without this add-on.

    python scripts/to_cycles.py FILE.blend --output COPY.blend                        with pip's bpy
    blender --background FILE.blend --python scripts/to_cycles.py -- --output COPY.blend  inside Blender

``python scripts/to_cycles.py --help`` lists all options.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # Blender does not add it

import ends

if __name__ == "__main__":
    ends.begin(__file__)
    from door import through

    sys.exit(ends.run(__file__, lambda: through("to_cycles")))
