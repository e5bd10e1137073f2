"""Directions into the background, at which the color of the world is evaluated."""

from typing import Any

import numpy as np

from .values import DIRECTION, Places, Value


class Directions(Places):
    """Directions, three components (m,) of any length, in the world: see ``values.Places``."""

    def __init__(self, direction: Any):
        super().__init__()
        self._direction = np.array(direction, float)

    def coordinates(self, name: str) -> np.ndarray:
        """See ``Places``; of DIRECTION, unit vectors."""
        if name != DIRECTION:
            return np.zeros_like(self._direction)
        return self._direction / np.sqrt((self._direction * self._direction).sum(axis=0))

    def layer(self, name: str, channels: int) -> np.ndarray:
        """See ``Places``; there is none."""
        return np.zeros((channels, self._direction.shape[1]))


def over_all_directions(value: Value, count: int) -> np.ndarray:
    """Return the mean of a value over ``count`` directions, evenly spread (Fibonacci's lattice), (channels,)."""
    k = np.arange(count) + 0.5
    z, turn = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    radius = np.sqrt(1 - z * z)
    return Directions((radius * np.cos(turn), radius * np.sin(turn), z)).value(value).mean(axis=1)
