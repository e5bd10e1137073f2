"""What is asked of a cast, apart from camera and shapes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..arguments import word, words

MATERIAL, GRID = "MATERIAL", "GRID"
SHADINGS = (MATERIAL, GRID)
"""Of the combined pass: see ``shading``."""

AUTOMATIC = "AUTOMATIC"
PRECISIONS = {AUTOMATIC: np.float64, "ROBUST": np.float64, "FAST": np.float32}
"""What hits are searched with. float32 is for previews: it may miss what is smaller than 1e-7 of its distance, and its
bound is never within the rounding of a stored float32, so that AUTOMATIC has no picture for which it suffices. It gains
1.05 to 1.15 times the speed of a whole cast of four passes, 1.1 to 1.45 of depth and index alone.
"""


@dataclass(frozen=True)
class Request:
    """What is asked of a cast. Raises InputError for an unknown pass, shading or precision, and names those that there
    are.
    """

    passes: tuple[str, ...]
    known: tuple[str, ...]
    """The names of all passes that there are."""
    shading: str = MATERIAL
    cull: bool = True
    """Whether shapes are tested only at pixels that may see them."""
    sampled: bool = False
    """Whether rays lie all over the pixels and the aperture, not in their centers."""
    precision: str = AUTOMATIC
    others: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """The pictures of other frames that passes look into, by name; see ``flow``."""

    def __post_init__(self):
        words(self.passes, "passes", self.known)
        word(self.shading, "shading", SHADINGS)
        word(self.precision, "precision", PRECISIONS)

    @property
    def real(self) -> type:
        """What hits are searched with: float64 or float32."""
        return PRECISIONS[self.precision]

    @property
    def spare(self) -> tuple[str, ...]:
        """The passes that are not asked for."""
        return tuple(name for name in self.known if name not in self.passes)
