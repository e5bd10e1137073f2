"""An OpenEXR file of three float32 channels, which is written: one part, scan lines, not compressed.

Reference: openexr.com, "OpenEXR File Layout".
"""

import struct

import numpy as np

from .reading import MAGIC

VERSION = 2
FLOAT, NO_COMPRESSION, INCREASING_Y = 2, 0, 0


def exr(pixels: np.ndarray) -> bytes:
    """Return the file of an image, (rows, columns, 3): red, green and blue, row 0 at the bottom."""
    height, width, _ = pixels.shape
    channels = b"".join(name + struct.pack("<xiB3xii", FLOAT, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = MAGIC + struct.pack("<i", VERSION) + b"".join(
        name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
        for name, kind, value in (
            (b"channels", b"chlist", channels),
            (b"compression", b"compression", bytes([NO_COMPRESSION])),
            (b"dataWindow", b"box2i", window),
            (b"displayWindow", b"box2i", window),
            (b"lineOrder", b"lineOrder", bytes([INCREASING_Y])),
            (b"pixelAspectRatio", b"float", struct.pack("<f", 1.0)),
            (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0.0, 0.0)),
            (b"screenWindowWidth", b"float", struct.pack("<f", 1.0)),
        )
    )
    header += b"\0"
    lines = np.empty(height, np.dtype([("y", "<i4"), ("size", "<i4"), ("channels", "<f4", (3, width))]))
    lines["y"], lines["size"] = np.arange(height), 12 * width
    lines["channels"] = pixels[::-1, :, ::-1].transpose(0, 2, 1)  # from the top; channels in the order of their names
    first = len(header) + 8 * height
    offsets = first + lines.itemsize * np.arange(height, dtype="<u8")
    return header + offsets.astype("<u8").tobytes() + lines.tobytes()
