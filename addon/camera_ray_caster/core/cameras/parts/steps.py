"""What a camera model says of itself: the steps of its formula, and when its pixels fire."""

from typing import NamedTuple

import numpy as np


class Step(NamedTuple):
    """One step of a formula from the pixel to the ray."""

    words: str
    symbols: str


class Firing(NamedTuple):
    """When the pixels of a scanner fire, in seconds from the begin of a sweep."""

    per_column: float
    rows: np.ndarray
    """(height,): what each row adds."""
