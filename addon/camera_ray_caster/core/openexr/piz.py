"""The compression PIZ of OpenEXR: a wavelet of 16-bit numbers, in a Huffman code.

Reference: openexr.com, "OpenEXR File Layout", and the library's ImfPizCompressor, ImfHuf and ImfWav.
"""

import struct
from bisect import bisect_right
from collections.abc import Sequence

import numpy as np

VALUES = 1 << 16
LONGEST = 57
"""Bits of a code: a word of 64 bits has it, with up to 7 bits before it in its first byte."""
RUN, LONG_RUN = 59, 63
"""Lengths of codes from which on they stand for runs of values without a code."""


def unpacked(packed: bytes, words: Sequence[int], rows: int, columns: int) -> bytes:
    """Return the lines of a chunk, whose channels have these numbers of 16-bit words a pixel.

    Raises ValueError, IndexError or struct.error for a damaged chunk.
    """
    first, last = struct.unpack_from("<HH", packed)
    used, position = np.zeros(VALUES, bool), 4
    if first <= last:
        bits = np.frombuffer(packed, np.uint8, last - first + 1, position)
        used[8 * first : 8 * last + 8] = np.unpackbits(bits, bitorder="little")
        position += len(bits)
    used[0] = True
    table = np.flatnonzero(used).astype("<u2")
    numbers = _numbers(packed[position + 4 :], rows * columns * sum(words))
    lines, begin = np.empty((rows, columns * sum(words)), "<u2"), 0
    for count in words:
        end = begin + columns * count
        channel = numbers[rows * begin : rows * end].reshape(rows, columns, count)
        for k in range(count):
            _unfold(channel[..., k], _step_14 if len(table) <= 1 << 14 else _step_16)
        lines[:, begin:end], begin = table[channel.reshape(rows, -1)], end
    return lines.tobytes()


def _numbers(packed: bytes, count: int) -> np.ndarray:
    """Return as many numbers of a Huffman code, int32."""
    least, run, _, bits, _ = struct.unpack_from("<5I", packed)
    lengths, begin = _lengths(_words(packed[20 : 20 + VALUES]), least, run)
    of_length = {length: np.flatnonzero(lengths == length).tolist() for length in range(58, 0, -1)}
    bounds, present, code = [], [], 0
    for length, symbols in of_length.items():  # canonical: long codes have small numbers
        if symbols:
            bounds.append(code << 64 - length)
            present.append(length)
        code = code + len(symbols) >> 1
    words, mask, position = _words(packed[20 + begin :]), (1 << 64) - 1, 0
    numbers: list[int] = []
    while position < bits:
        code = words[position >> 3] << (position & 7) & mask
        k = bisect_right(bounds, code) - 1
        symbol = of_length[present[k]][code - bounds[k] >> 64 - present[k]]
        position += present[k]
        if symbol == run:
            numbers += numbers[-1:] * (words[position >> 3] >> 56 - (position & 7) & 255)
            position += 8
        else:
            numbers.append(symbol)
        if len(numbers) > count:
            break
    if len(numbers) != count or max(present) > LONGEST:
        raise ValueError(f"{len(numbers)} numbers in place of {count}")
    return np.array(numbers, np.int32)


def _lengths(words: list[int], least: int, last: int) -> tuple[np.ndarray, int]:
    """Return how many bits the code of each value has, 0 if it has none, and the number of bytes that tell it."""
    lengths, value, position = np.zeros(VALUES + 1, np.int64), least, 0

    def bits(count: int) -> int:
        return words[position >> 3] >> 64 - (position & 7) - count & (1 << count) - 1

    while value <= last:
        length, position = bits(6), position + 6
        if length == LONG_RUN:
            value, position = value + bits(8) + LONG_RUN - RUN + 2, position + 8
        elif length >= RUN:
            value += length - RUN + 2
        else:
            lengths[value], value = length, value + 1
    return lengths, position + 7 >> 3


def _words(content: bytes) -> list[int]:
    """Return the 64 bits that begin at each byte."""
    padded = np.frombuffer(content + bytes(8), np.uint8)
    return np.lib.stride_tricks.sliding_window_view(padded, 8).copy().view(">u8").ravel().tolist()


def _unfold(values: np.ndarray, step) -> None:
    """Undo the wavelet of a channel's words, (rows, columns), in place."""
    rows, columns = values.shape
    apart = 1 << min(rows, columns).bit_length() - 1
    while apart > 1:
        half = apart >> 1
        (y, x), (y_half, x_half) = (
            [slice(begin, side - apart + 1 + begin, apart) for side in values.shape] for begin in (0, half)
        )
        above, below = step(values[y, x], values[y_half, x])
        above_right, below_right = step(values[y, x_half], values[y_half, x_half])
        values[y, x], values[y, x_half] = step(above, above_right)
        values[y_half, x], values[y_half, x_half] = step(below, below_right)
        if columns & half:
            edge = columns // apart * apart
            values[y, edge], values[y_half, edge] = step(values[y, edge], values[y_half, edge])
        if rows & half:
            edge = rows // apart * apart
            values[edge, x], values[edge, x_half] = step(values[edge, x], values[edge, x_half])
        apart = half


def _step_14(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return two numbers below 2^14 of their mean and their difference."""
    mean, difference = _signed(low), _signed(high)
    first = mean + (difference & 1) + (difference >> 1)
    return first & 0xFFFF, first - difference & 0xFFFF


def _step_16(low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return two numbers of 16 bits of their mean and their difference, modulo 2^16."""
    second = low - (high >> 1) & 0xFFFF
    return high + second - 0x8000 & 0xFFFF, second


def _signed(values: np.ndarray) -> np.ndarray:
    return (values & 0xFFFF ^ 0x8000) - 0x8000
