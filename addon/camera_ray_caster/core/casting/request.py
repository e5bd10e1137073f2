"""The request for a cast: its passes and options."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

MATERIAL, GRID = "MATERIAL", "GRID"
SHADINGS = (MATERIAL, GRID)
"""Shadings of the combined pass: see ``shading``."""


@dataclass(frozen=True)
class Request:
    """The passes and options of a cast."""

    passes: tuple[str, ...]
    shading: str = MATERIAL
    cull: bool = True
    """Whether shapes are tested only at pixels that may see them."""
    sampled: bool = False
    """Whether rays are spread over the pixels and the aperture, instead of through their centers."""
    others: Mapping[str, Any] = field(default_factory=dict, compare=False)
    """The pictures of other frames that passes need, by name; see ``flow``."""
