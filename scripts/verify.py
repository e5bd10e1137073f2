"""Hold the rays of a .blend's camera against Blender's own frame.

    python scripts/verify.py FILE.blend                                      with pip's bpy
    blender --background FILE.blend --python scripts/verify.py -- --frame 1  inside Blender

``python scripts/verify.py --help`` shows what else can be given.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from door import through

if __name__ == "__main__":
    sys.exit(through("verify"))
