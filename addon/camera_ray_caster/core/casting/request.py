"""The request for a cast: its passes and options."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..arguments import word, words

MATERIAL, GRID = "MATERIAL", "GRID"
SHADINGS = (MATERIAL, GRID)
"""Shadings of the combined pass: see ``shading``."""


@dataclass(frozen=True)
class Request:
    """The passes and options of a cast. Raises InputError for an unknown pass or shading; the message names the known
    ones.
    """

    passes: tuple[str, ...]
    known: tuple[str, ...]
    """The names of all existing passes."""
    shading: str = MATERIAL
    cull: bool = True
    """Whether shapes are tested only at pixels that may see them."""
    sampled: bool = False
    """Whether rays are spread over the pixels and the aperture, instead of through their centers."""
    others: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """The pictures of other frames that passes need, by name; see ``flow``."""

    def __post_init__(self):
        words(self.passes, "passes", self.known)
        word(self.shading, "shading", SHADINGS)

    @property
    def spare(self) -> tuple[str, ...]:
        """The passes that are not requested."""
        return tuple(name for name in self.known if name not in self.passes)
