"""Large tables as textures, which a shader reads texel by texel: as part of its text they would be too long.

A texture has up to three columns of a table, as red, green and blue, an entry after the other in rows of WIDE texels.
Sides are powers of two, so that the middles of texels are exact in float32, where any interpolation gives the texel
itself. Its first and last row are marks: they tell whether t runs from the top (Blender 4.5, 5.0) or from the bottom
(5.2), and whether there is a file, in place of which Cycles gives one color without an error.
Reference: Open Shading Language 1.14, Language Specification, chapter 7, texture.
"""

from hashlib import sha256

import numpy as np

from ..maths.recording import Entries
from ..records import InputError

MOST_IN_TEXT = 27_000
"""Length of the largest table in a text: of 25,000 rays with their continuation, up to 2 MB of text, some 0.2 s."""

WIDE = 2048
MOST_ROWS = 8190
"""Rows of the largest texture, without its marks: 2**24, up to which float32 has all whole numbers, over WIDE."""

FIRST_ROW, LAST_ROW = (0.25, 0.5, 0.75), (0.75, 0.5, 0.25)
"""Colors of the first and the last row, from the top. Cycles gives (1, 0, 1) for a file that is missing."""


def texture_of(entries: Entries) -> tuple[str, np.ndarray]:
    """Return the name of the file of a table, by its content, and its image, (rows, WIDE, 3) float32 from the bottom.

    Raises InputError for a table that is too large.
    """
    columns = entries.table[:, entries.column // 3 * 3 :][:, :3]
    rows = -(-len(columns) // WIDE)
    if rows > MOST_ROWS:
        raise InputError(
            f"a table of {len(columns)} rays is too large for a shader, which has up to {MOST_ROWS * WIDE}: give a "
            "coarser table"
        )
    high = 1 << (rows + 1).bit_length()
    texels = np.zeros((high, WIDE, 3), np.float32)
    texels[0], texels[-1] = FIRST_ROW, LAST_ROW
    texels[1:-1].reshape(-1, 3)[: len(columns), : columns.shape[1]] = columns
    return f"rays_{sha256(texels.tobytes()).hexdigest()[:16]}.exr", texels[::-1]
