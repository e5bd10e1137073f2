"""The request for a cast: its passes and options."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..arguments import word, words

MATERIAL, GRID = "MATERIAL", "GRID"
SHADINGS = (MATERIAL, GRID)
"""Shadings of the combined pass: see ``shading``."""

AUTOMATIC = "AUTOMATIC"
PRECISIONS = {AUTOMATIC: np.float64, "ROBUST": np.float64, "FAST": np.float32}
"""Floating-point types of the search for hits. float32 is for previews: it may miss shapes smaller than 1e-7 of their
distance. Its error bound is never within the rounding of a stored float32, so AUTOMATIC never selects it. It is 1.05 to
1.15 times as fast for a whole cast of four passes, 1.1 to 1.45 times for depth and index alone.
"""


@dataclass(frozen=True)
class Request:
    """The passes and options of a cast. Raises InputError for an unknown pass, shading or precision; the message names
    the known ones.
    """

    passes: tuple[str, ...]
    known: tuple[str, ...]
    """The names of all existing passes."""
    shading: str = MATERIAL
    cull: bool = True
    """Whether shapes are tested only at pixels that may see them."""
    sampled: bool = False
    """Whether rays are spread over the pixels and the aperture, instead of through their centers."""
    precision: str = AUTOMATIC
    others: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """The pictures of other frames that passes need, by name; see ``flow``."""

    def __post_init__(self):
        words(self.passes, "passes", self.known)
        word(self.shading, "shading", SHADINGS)
        word(self.precision, "precision", PRECISIONS)

    @property
    def real(self) -> type:
        """The floating-point type of the search for hits: float64 or float32."""
        return PRECISIONS[self.precision]

    @property
    def spare(self) -> tuple[str, ...]:
        """The passes that are not requested."""
        return tuple(name for name in self.known if name not in self.passes)
