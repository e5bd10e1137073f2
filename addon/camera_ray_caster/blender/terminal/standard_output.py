"""Keeps Blender's own messages (frames, saved files, settings found) out of a command's output.

No bpy here: it prints as soon as it is imported.
"""

import os
import sys


def keep_output() -> None:
    """Keep standard output for Python and discard what other code writes to it, until the process ends."""
    sys.stdout = os.fdopen(os.dup(1), "w", encoding="utf-8", errors="replace")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
