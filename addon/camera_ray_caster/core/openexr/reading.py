"""Reads OpenEXR images: all channels with their numbers, of scan lines or tiles, of one part or several.

Compressions with loss are refused: they change numbers that should be exact.
Reference: openexr.com, "OpenEXR File Layout".
"""

import struct
import zlib

import numpy as np

from .. import memory
from ..records import InputError
from .piz import unpacked

MAGIC = b"\x76\x2f\x31\x01"
TILED, DEEP, SEVERAL_PARTS = 0x200, 0x800, 0x1000
"""Bits of the version."""
COMPRESSIONS = {"none": 1, "RLE": 1, "ZIPS": 1, "ZIP": 16, "PIZ": 32}
"""The compressions by number, and how many lines each compresses together."""
LOSSY = "PXR24", "B44", "B44A", "DWAA", "DWAB"
"""The compressions that follow them."""
PER_NUMBER = 220
"""Bytes for a number of a chunk of PIZ while it is unpacked: 215 of random numbers in 32 lines of 4096 x 6."""
TYPES = "<u4", "<f2", "<f4"
DAMAGED = struct.error, LookupError, ValueError, ArithmeticError, zlib.error

Channels = dict[str, np.dtype]


def channels_of(content: bytes, path: str) -> dict[str, np.ndarray]:
    """Return the channels of an image by name, (rows, columns) from the top: those of half floats as float16.

    Raises InputError, in one line with the path, for an image that is damaged, too large, or of a kind that is not
    read.
    """
    try:
        if not content.startswith(MAGIC):
            raise InputError(f"{path!r} is no EXR image")
        (version,) = struct.unpack_from("<I", content, len(MAGIC))
        if version & DEEP:
            raise InputError(f"{path!r} is a deep EXR image: give one with flat pixels")
        has_parts = bool(version & SEVERAL_PARTS)
        parts, position = _parts(content, has_parts)
        channels: dict[str, np.ndarray] = {}
        for attributes in parts:
            tiled = attributes["type"].startswith(b"tiled") if has_parts else version & TILED
            image, position = _image(content, position, attributes, bool(tiled), has_parts, path)
            if channels.keys() & image.keys():
                raise InputError(f"EXR image {path!r} has several parts with the same channels: give each a file")
            channels |= image
        return channels
    except DAMAGED as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"EXR image {path!r} is damaged, or cut off") from error


def is_part(content: bytes) -> bool:
    """Whether an image that ``channels_of`` reads has pixels for a part of its display window, or beyond it."""
    parts, _ = _parts(content, False)
    return parts[0].get("displayWindow", parts[0]["dataWindow"]) != parts[0]["dataWindow"]


def _parts(content: bytes, several: bool) -> tuple[list[dict[str, bytes]], int]:
    """Return the attributes of each part by name, and where their tables begin."""
    parts: list[dict[str, bytes]] = []
    position = 8
    while not parts or (several and content[position]):
        attributes = {}
        while content[position]:
            end = content.index(b"\0", content.index(b"\0", position) + 1)
            (size,) = struct.unpack_from("<I", content, end + 1)
            attributes[content[position:end].split(b"\0")[0].decode()] = content[end + 5 : end + 5 + size]
            position = end + 5 + size
        parts.append(attributes)
        position += 1
    return parts, position + several


def _channels(value: bytes, path: str) -> Channels:
    """Return the type of each channel, in the order in which a line has them."""
    channels = {}
    while value[0]:
        name, value = value.split(b"\0", 1)
        kind, _, *steps = struct.unpack_from("<II2i", value)
        if steps != [1, 1]:
            raise InputError(f"channel {name.decode()!r} of EXR image {path!r} does not have all pixels")
        channels[name.decode()], value = np.dtype(TYPES[kind]), value[16:]
    return channels


def _image(content: bytes, position: int, attributes: dict[str, bytes], tiled: bool, has_parts: bool, path: str):
    """Return the channels of a part whose table of chunks is at a position, and the position behind the table."""
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels, number = _channels(attributes["channels"], path), attributes["compression"][0]
    names = [*COMPRESSIONS, *LOSSY]
    if number >= len(COMPRESSIONS):
        reason = f"{names[number]}, which changes its numbers" if number < len(names) else f"number {number}"
        raise InputError(f"the compression of EXR image {path!r} is {reason}: save it with ZIP, PIZ or none")
    compression = names[number]
    tile = struct.unpack_from("<II", attributes["tiles"]) if tiled else None
    across, down = tile or (width, COMPRESSIONS[compression])
    count = -(-width // across) * -(-height // down)  # smaller levels of tiles follow
    needed = 8 * width * height + (PER_NUMBER if compression == "PIZ" else 0) * across * down
    memory.require(needed * len(channels), f"the channels of {path!r}", "give a smaller file")
    offsets = struct.unpack_from(f"<{count}Q", content, position)
    image = {name: np.zeros((height, width), kind) for name, kind in channels.items()}
    for offset in offsets:
        start = offset + 4 * has_parts
        x, y = struct.unpack_from("<ii", content, start) if tile else (0, 0)
        x, y = (x * across, y * down) if tile else (0, struct.unpack_from("<i", content, start)[0] - top)
        start += 16 if tile else 4
        rows, columns = min(down, height - y), min(across, width - x)
        if min(x, y) < 0 or min(rows, columns) < 1:
            raise ValueError("a chunk is outside of the image")
        (size,) = struct.unpack_from("<I", content, start)
        lines = _lines(content[start + 4 : start + 4 + size], compression, channels, rows, columns)
        for k, values in enumerate(image.values()):
            values[y : y + rows, x : x + columns] = lines[f"f{k}"]
    (chunks,) = struct.unpack("<i", attributes["chunkCount"]) if has_parts else (count,)
    return image, position + 8 * chunks


def _lines(packed: bytes, compression: str, channels: Channels, rows: int, columns: int) -> np.ndarray:
    """Return the lines of a chunk: a field for each channel."""
    lines = np.dtype([("", kind, (columns,)) for kind in channels.values()])
    size = rows * lines.itemsize
    if len(packed) < size:  # else it is stored as it is
        if compression == "PIZ":
            packed = unpacked(packed, [kind.itemsize // 2 for kind in channels.values()], rows, columns)
        else:
            packed = _whole(_runs(packed) if compression == "RLE" else zlib.decompressobj().decompress(packed, size))
    return np.frombuffer(packed, lines, rows)


def _runs(packed: bytes) -> bytes:
    """Return bytes of which runs are stored as a length and a byte, and others after their negative number."""
    content, position = bytearray(), 0
    while position < len(packed):
        (length,) = struct.unpack_from("b", packed, position)
        end = position + (1 - length if length < 0 else 2)
        content += packed[position + 1 : end] * (1 if length < 0 else length + 1)
        position = end
    return bytes(content)


def _whole(differences: bytes) -> bytes:
    """Return bytes that are stored as differences, those at even places before those at odd ones."""
    steps = np.frombuffer(differences, np.uint8).copy()
    steps[1:] -= 128
    halves = np.cumsum(steps, dtype=np.uint8)
    content, middle = np.empty_like(halves), (len(halves) + 1) // 2
    content[0::2], content[1::2] = halves[:middle], halves[middle:]
    return content.tobytes()
