"""Makes the C library keep freed memory for new arrays; used in our own processes only.

glibc returns freed blocks above a threshold to the system, which clears new memory page by page. Successive casts of
1920 x 1080 took 1.1 to 1.8 times as long without this setting. It affects the whole process, so the add-on never
changes it in a user's Blender. Source: mallopt(3).
"""

import sys
from ctypes import CDLL

LARGEST_KEPT, MOST_KEPT = 32 << 20, 128 << 20
"""Maximum bytes to keep: of one array, and in total."""

M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3
"""Parameter numbers of mallopt, from glibc's malloc.h."""


def keep_memory() -> None:
    """Keep freed memory in this process; do nothing if the C library has no mallopt."""
    library = CDLL(None) if sys.platform == "linux" else None
    if hasattr(library, "mallopt"):
        library.mallopt(M_MMAP_THRESHOLD, LARGEST_KEPT)
        library.mallopt(M_TRIM_THRESHOLD, MOST_KEPT)
