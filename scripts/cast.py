"""Render a .blend with the rays of its camera.

    python scripts/cast.py FILE.blend                                      with pip's bpy
    blender --background FILE.blend --python scripts/cast.py -- --frame 1  inside Blender

``python scripts/cast.py --help`` shows what else can be given.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from door import through

if __name__ == "__main__":
    sys.exit(through("cast"))
