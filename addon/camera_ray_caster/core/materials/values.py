"""Expressions of numbers that change over a surface: constants, coordinates, attributes, and functions of these.

An expression gives an array (channels, m) at m points of surfaces, or (channels, 1) where it is constant. Colors are
linear RGB, coordinates are three numbers. What is constant is computed once, when the expression is made.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

GRAY = np.array([[0.2126], [0.7152], [0.0722]])
"""Weights of linear red, green and blue in the gray of a color (Rec. 709), as in Blender."""


class Places(ABC):
    """Points at which expressions are evaluated: of surfaces, or directions into the background."""

    def __init__(self) -> None:
        self._known: dict[Value, np.ndarray] = {}

    def value(self, of: Value) -> np.ndarray:
        """Return the values of an expression, which is evaluated once for these points."""
        if of not in self._known:
            self._known[of] = of.at(self)
        return self._known[of]

    @abstractmethod
    def coordinates(self, name: str) -> np.ndarray:
        """Return coordinates by name, (3, m), see ``Coordinates``; 0 where there are none."""

    @abstractmethod
    def layer(self, name: str, channels: int) -> np.ndarray:
        """Return an attribute of the mesh by the name of its layer, (channels, m); 0 where there is none."""


class Value(ABC):
    """An expression."""

    @abstractmethod
    def at(self, places: Places) -> np.ndarray:
        """Return the values at some points, (channels, m) or (channels, 1)."""


@dataclass(frozen=True, eq=False)
class Constant(Value):
    """The same numbers everywhere, (channels, 1)."""

    values: np.ndarray

    def at(self, places: Places) -> np.ndarray:
        return self.values


UV, GENERATED, OBJECT, DIRECTION = "uv", "generated", "object", "direction"
"""Names of coordinates: the render UV map, the texture space, the object's space, and the direction of the ray."""


@dataclass(frozen=True, eq=False)
class Coordinates(Value):
    """The coordinates of this name, (3, m)."""

    name: str

    def at(self, places: Places) -> np.ndarray:
        return places.coordinates(self.name)


@dataclass(frozen=True, eq=False)
class Layer(Value):
    """A layer of the mesh, such as a UV map or a color attribute, (channels, m)."""

    name: str
    channels: int

    def at(self, places: Places) -> np.ndarray:
        return places.layer(self.name, self.channels)


@dataclass(frozen=True, eq=False)
class Function(Value):
    """A function of the values of other expressions."""

    function: Callable[..., np.ndarray]
    inputs: tuple[Value, ...]

    def at(self, places: Places) -> np.ndarray:
        return self.function(*map(places.value, self.inputs))


def constant(*numbers: float) -> Constant:
    """Return the constant expression of some numbers; 0 in place of those that are not finite."""
    values = np.array(numbers, float)[:, None]
    return Constant(np.where(np.isfinite(values), values, 0.0))


def function_of(function: Callable[..., np.ndarray], *inputs: Value) -> Value:
    """Return a function of expressions; a constant if all of these are constants."""
    known = [value.values for value in inputs if isinstance(value, Constant)]
    if len(known) < len(inputs):
        return Function(function, inputs)
    with np.errstate(all="ignore"):
        return Constant(np.asarray(function(*known), float))


def gray(color: Value) -> Value:
    """Return the gray of a color."""
    return function_of(lambda values: (GRAY * values).sum(axis=0, keepdims=True), color)


def mean(vector: Value) -> Value:
    """Return the mean of the components of a vector."""
    return function_of(lambda values: values.mean(axis=0, keepdims=True), vector)


def channel(value: Value, k: int) -> Value:
    """Return a channel of an expression."""
    return function_of(lambda values: values[k : k + 1], value)


def all_constant(value: Value | None) -> bool:
    """Whether an expression is constant, or missing."""
    return value is None or isinstance(value, Constant)
