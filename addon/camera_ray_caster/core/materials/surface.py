"""The surface of a material as the passes show it, and which of its points are hit."""

from dataclasses import dataclass

import numpy as np

from .values import Places, Value, all_constant


@dataclass(frozen=True, eq=False)
class Surface:
    """A material that changes over the surface, or that glows; others are a row of ``Shapes.color``."""

    lit: Value
    """The color that light shows, three channels."""
    emission: Value | None = None
    """The color of its emission, before the strength; None without emission shaders."""
    glow: Value | None = None
    """The light that it emits, three channels; None for no light."""
    alpha: Value | None = None
    """One channel, 0 transparent to 1 opaque; None if every point is hit."""
    threshold: float = 0.5
    """The alpha from which on a point is hit: the view layer's Alpha Threshold."""

    def is_hit(self, places: Places, count: int) -> np.ndarray:
        """Return which of some points, (count,), are hit."""
        if self.alpha is None:
            return np.ones(count, bool)
        return np.broadcast_to(places.value(self.alpha)[0] >= self.threshold, (count,))

    @property
    def changes(self) -> bool:
        """Whether anything changes over the surface."""
        return not all(map(all_constant, (self.lit, self.emission, self.glow, self.alpha)))
