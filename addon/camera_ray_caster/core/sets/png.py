"""PNG files of gray values and colors, 8 or 16 bits, and the colors of linear values.

Reference: Portable Network Graphics Specification, ISO/IEC 15948.
"""

import struct
import zlib

import numpy as np

SIGNATURE = b"\x89PNG\r\n\x1a\n"
COLOR = {1: 0, 3: 2, 4: 6}
"""The color type of a number of channels."""

LEVEL = 6
MOST_16_BITS = 65535


def png(pixels: np.ndarray) -> bytes:
    """Return an image (rows, columns) or (rows, columns, 1, 3 or 4), uint8 or uint16, the first row at the top."""
    pixels = pixels[..., None] if pixels.ndim == 2 else pixels
    height, width, channels = pixels.shape
    rows = np.ascontiguousarray(pixels, pixels.dtype.newbyteorder(">")).view(np.uint8).reshape(height, -1)
    filtered = np.zeros((height, rows.shape[1] + 1), np.uint8)
    filtered[:, 1:] = rows
    head = struct.pack(">IIBBBBB", width, height, 8 * pixels.dtype.itemsize, COLOR[channels], 0, 0, 0)
    parts = (b"IHDR", head), (b"IDAT", zlib.compress(filtered.tobytes(), LEVEL)), (b"IEND", b"")
    return SIGNATURE + b"".join(_chunk(*chunk) for chunk in parts)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def srgb(linear: np.ndarray) -> np.ndarray:
    """Return linear values as 8 bits of sRGB (IEC 61966-2-1)."""
    value = np.clip(np.nan_to_num(linear.astype(np.float64)), 0, 1)
    curved = np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    return np.round(255 * curved).astype(np.uint8)
