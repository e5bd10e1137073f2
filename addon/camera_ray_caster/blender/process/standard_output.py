"""Keeps messages of Blender and its libraries (frames, saved files, settings found) out of a command's output.

No bpy here: it prints as soon as it is imported.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager


def keep_output() -> None:
    """Keep standard output for Python and discard what other code writes to it, until the process ends."""
    sys.stdout = os.fdopen(os.dup(1), "w", encoding="utf-8", errors="replace")
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)


@contextmanager
def quiet_errors() -> Iterator[None]:
    """Discard what is written to standard error inside the context, by C code, too."""
    try:
        standard_error = os.dup(2)
    except OSError:  # it is closed
        yield
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    os.close(nowhere)
    try:
        yield
    finally:
        os.dup2(standard_error, 2)
        os.close(standard_error)
