"""Keeps what Blender prints by itself (frames, saved files, settings that it found) out of a command's output.

No bpy here: it prints from its first import on.
"""

import os
import sys


def keep_output() -> None:
    """Leave standard output to Python and send nowhere what others write to it, to the end of this process."""
    sys.stdout = os.fdopen(os.dup(1), "w", encoding="utf-8", errors="replace")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
