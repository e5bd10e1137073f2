"""Reads back the OpenEXR files that Blender writes: one part, scan lines, zipped. For tests inside Blender too.

Format: openexr.com, "OpenEXR File Layout". A library would have to fit each Blender's Python and numpy.
"""

import struct
import zlib

import numpy as np

MAGIC = 20000630
SEVERAL_PARTS, TILES = 0x1000, 0x200
LINES_OF_A_CHUNK = {0: 1, 2: 1, 3: 16}  # by compression: none, zip of one line, zip
TYPES = {0: "<u4", 1: "<f2", 2: "<f4"}


def read_exr(path):
    """The channels of a file by name, each (height, width) over the display window, row 0 at the bottom as in Blender.

    Pixels outside the data window are 0.
    """
    data = path.read_bytes()
    magic, version = struct.unpack_from("<II", data)
    assert magic == MAGIC
    assert not version & (SEVERAL_PARTS | TILES), "one part of scan lines is what is asked of Blender"
    header, position = _header(data, 8)
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"])
    x0, y0, x1, y1 = struct.unpack("<4i", header["displayWindow"])
    compression = header["compression"][0]
    channels = _channels(header["channels"])
    width, height = right - left + 1, bottom - top + 1
    dtype = np.dtype([(name, TYPES[kind], (width,)) for name, kind in channels])
    lines = np.zeros(height, dtype)
    chunks = -(-height // LINES_OF_A_CHUNK[compression])
    for offset in struct.unpack_from(f"<{chunks}Q", data, position):
        y, size = struct.unpack_from("<iI", data, offset)
        count = min(LINES_OF_A_CHUNK[compression], bottom + 1 - y)
        packed = data[offset + 8 : offset + 8 + size]
        plain = packed if size == count * dtype.itemsize else _unzip(packed)
        lines[y - top : y - top + count] = np.frombuffer(plain, dtype)
    images = {}
    for name, _ in channels:
        image = np.zeros((y1 - y0 + 1, x1 - x0 + 1), lines[name].dtype)
        image[top - y0 : top - y0 + height, left - x0 : left - x0 + width] = lines[name]
        images[name] = image[::-1]
    return images


def _header(data, position):
    """The values of the header's attributes by name, and where the header ends."""
    values = {}
    while data[position]:
        name, kind, _ = data[position : position + 600].split(b"\0", 2)
        position += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<I", data, position)
        values[name.decode()] = data[position + 4 : position + 4 + size]
        position += 4 + size
    return values, position + 1


def _channels(value):
    """(name, type) of each channel, in the order in which a line holds them."""
    channels = []
    while value[0]:
        name, remainder = value.split(b"\0", 1)
        channels.append((name.decode(), struct.unpack_from("<i", remainder)[0]))
        value = remainder[16:]
    return channels


def _unzip(packed):
    """What was zipped: bytes as differences, those at even places before those at odd ones."""
    differences = np.frombuffer(zlib.decompress(packed), np.uint8).astype(np.int64)
    differences[1:] -= 128
    halves = np.cumsum(differences).astype(np.uint8)
    plain = np.empty_like(halves)
    middle = (len(halves) + 1) // 2
    plain[0::2], plain[1::2] = halves[:middle], halves[middle:]
    return plain.tobytes()
