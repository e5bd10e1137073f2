"""Images as arrays, and their values at coordinates, interpolated and extended beyond their edges as in Cycles.

Reference: Blender's manual, Image Texture Node; the order of the steps is that of Cycles: texels of byte images are
multiplied by their alpha and interpolated as they are stored, then converted to linear.
"""

from dataclasses import dataclass

import numpy as np

from .values import Places, Value

REPEAT, EXTEND, CLIP, MIRROR = "REPEAT", "EXTEND", "CLIP", "MIRROR"

MISSING = (1.0, 0.0, 1.0, 1.0)
"""RGBA of an image that cannot be loaded, as in Blender."""


@dataclass(frozen=True, eq=False)
class Texels:
    """The texels of an image, which all its textures share."""

    name: str
    texels: np.ndarray
    """(rows, columns, 4) uint8 or float32, rows from the bottom; colors are multiplied by alpha unless ``is_data``."""
    is_srgb: bool
    """Whether colors are stored in sRGB, to be converted to linear."""
    is_data: bool
    """Whether colors and alpha have nothing to do with each other."""


class UnreadTexture(Value):
    """An image that was not read, since no pass that is cast shows it."""

    def at(self, places: Places) -> np.ndarray:
        """Raise an error: a pass shows the image."""
        raise RuntimeError("a texture is evaluated whose image was not read")


@dataclass(frozen=True, eq=False)
class Texture(Value):
    """An image at coordinates: its color, (3, m), or its alpha, (1, m)."""

    image: Texels
    vector: Value
    extension: str = REPEAT
    is_smooth: bool = True
    """Whether texels are interpolated, linearly; otherwise the nearest one counts."""
    divides: bool = False
    """Whether colors are divided by alpha: where the material uses the image's alpha, too."""
    is_alpha: bool = False
    """Whether the value is alpha."""

    def at(self, places: Places) -> np.ndarray:
        """See ``Value``; the coordinates run from 0 to 1 over the image."""
        x, y = places.value(self.vector)[:2]
        values = self._texels(np.atleast_1d(x), np.atleast_1d(y))
        if self.is_alpha:
            return values
        if self.divides and not self.image.is_data:
            alpha = values[3]
            values /= np.where((alpha == 0) | (alpha == 1), 1.0, alpha)
        return linear(values[:3]) if self.image.is_srgb else values[:3]

    def _texels(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the stored values, 0 .. 1 for bytes, (4, m), or of alpha alone, (1, m)."""
        high, wide = self.image.texels.shape[:2]
        x, y = (np.where(np.isfinite(coordinate), coordinate, 0.0) for coordinate in np.broadcast_arrays(x, y))
        if not self.is_smooth:
            return self._read(np.floor(x * wide), np.floor(y * high))
        x, y = x * wide - 0.5, y * high - 0.5
        column, row = np.floor(x), np.floor(y)
        right, up = x - column, y - row
        below = self._read(column, row) * (1 - right) + self._read(column + 1, row) * right
        above = self._read(column, row + 1) * (1 - right) + self._read(column + 1, row + 1) * right
        return below * (1 - up) + above * up

    def _read(self, column: np.ndarray, row: np.ndarray) -> np.ndarray:
        """Return texels by column and row, whole numbers also beyond the edges, as ``_texels`` does."""
        texels = self.image.texels
        high, wide = texels.shape[:2]
        texel = _wrapped(row, high, self.extension) * wide + _wrapped(column, wide, self.extension)
        if self.is_alpha:
            values = texels.reshape(-1).take(4 * texel + 3)[None].astype(float)
        else:
            values = texels.reshape(-1, 4).take(texel, axis=0).T.astype(float)
        if texels.dtype == np.uint8:
            values /= 255
        if self.extension == CLIP:
            values[:, (column < 0) | (column >= wide) | (row < 0) | (row >= high)] = 0.0
        return values


def _wrapped(texel: np.ndarray, count: int, extension: str) -> np.ndarray:
    """Return the texels that stand for texels beyond the edges, along one side."""
    if extension == REPEAT:
        return np.mod(texel, count).astype(np.intp)
    if extension == MIRROR:
        twice = np.mod(texel, 2 * count)
        return np.minimum(twice, 2 * count - 1 - twice).astype(np.intp)
    return np.clip(texel, 0, count - 1).astype(np.intp)


def linear(color: np.ndarray) -> np.ndarray:
    """Return linear values of sRGB values (IEC 61966-2-1)."""
    return np.where(color < 0.04045, np.maximum(color, 0) / 12.92, ((np.maximum(color, 0) + 0.055) / 1.055) ** 2.4)
