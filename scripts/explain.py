"""Explain a pixel of a .blend step by step, with its numbers.

    python scripts/explain.py FILE.blend --pixel 120,80                                 with pip's bpy
    blender --background FILE.blend --python scripts/explain.py -- --pixel 120,80  inside Blender

``python scripts/explain.py --help`` lists all options.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # Blender does not add it

import ends

if __name__ == "__main__":
    ends.begin(__file__)
    from door import through

    sys.exit(ends.run(__file__, lambda: through("explain")))
