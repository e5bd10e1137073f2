"""Passes as pictures: numbers of any range, mapped to colors that a screen can show."""

import numpy as np

from ..casting.passes import AS_IS, COUNTED, PASSES, RANGE, SIGNED

NOTHING = 1e9
"""Distances from this one on mean that nothing is hit: Blender stores 1e10, the caster infinity."""
WIDE = 100.0
"""Ratio of the largest to the smallest value above which the scale is logarithmic."""
DEEP = 4.0
"""The same ratio of distances, above which the scale is even in their inverse. Even in the distance, the middle half of
the pixels of the gallery's living room and street has 0.90 to 0.98 of white; so it has 0.34 to 0.71.
"""
GOLDEN = (0.618033988749895, 0.754877666246693, 0.569840290998053)
"""Steps of the three channels from one index to the next, from the golden ratio and the plastic number. They keep the
colors of small indices apart.
"""


def displayed(key: str, image: np.ndarray) -> tuple[np.ndarray, str]:
    """Return a pass as colors (rows, columns, 3), float32 from 0 to 1, and a text that says what the colors mean.

    image: (rows, columns[, channels]). Pixels without a value are black.
    """
    values = np.asarray(image, np.float64).reshape(*image.shape[:2], -1)[..., :3]
    if values.shape[-1] == 2:
        values = np.pad(values, ((0, 0), (0, 0), (0, 1)))
    how = PASSES[key].shown if key in PASSES else RANGE
    if how == AS_IS:
        colors, caption = values, "as it is"
    elif how == SIGNED:
        colors, caption = (values + 1) / 2 * (values != 0).any(axis=-1, keepdims=True), "-1 is black, 0 gray, 1 white"
    elif how == COUNTED:
        colors, caption = _colors(values[..., :1], key), "one color per number"
    else:
        colors, caption = _range(values, key in ("depth", "distance"))
    shown = np.broadcast_to(np.clip(np.nan_to_num(colors), 0, 1), (*values.shape[:2], 3))
    return shown.astype(np.float32), caption


def _colors(numbers: np.ndarray, key: str) -> np.ndarray:
    """Return a color for each whole number; black for -1, and for 0 where indices begin with 1."""
    numbers = np.where(np.isfinite(numbers), numbers, -1.0)
    none = numbers < (1 if key in ("object_index", "material_index") else 0)
    return np.where(none, 0.0, 0.25 + 0.75 * ((numbers + 1) * GOLDEN % 1.0))


def _range(values: np.ndarray, is_distance: bool) -> tuple[np.ndarray, str]:
    """Return the finite values scaled to their own range, and that range as text.

    A single component goes from white (smallest) to a tenth of white (largest), several go from black to white each. A
    wide range is on a logarithmic scale, of distances on that of their inverse.
    """
    counted = np.isfinite(values) & (np.abs(values) < NOTHING) & (values.shape[-1] > 1 or values != 0)
    if not counted.any():
        return np.zeros_like(values), "no pixel has a value"
    low = values.min(axis=(0, 1), where=counted, initial=np.inf)
    high = values.max(axis=(0, 1), where=counted, initial=-np.inf)
    low, high = (np.where(counted.any(axis=(0, 1)), end, 0.0) for end in (low, high))
    may_bend, scale = values.shape[-1] == 1 and low[0] > 0, ""
    caption = ", ".join(f"{a:.4g} to {b:.4g}" for a, b in zip(low, high, strict=True))
    if may_bend and is_distance and high[0] > DEEP * low[0]:
        values, low, high, scale = -1 / np.where(counted, values, low), -1 / low, -1 / high, ", even in 1/distance"
    elif may_bend and high[0] > WIDE * low[0]:
        values, low, high = np.log(np.where(counted, values, low)), np.log(low), np.log(high)
        scale = ", logarithmic"
    share = (values - low) / np.where(high > low, high - low, 1.0)
    if values.shape[-1] == 1:
        return np.where(counted, 1 - 0.9 * share, 0.0), f"white to dark: {caption}{scale}"
    return np.where(counted, share, 0.0), f"black to white by component: {caption}"
