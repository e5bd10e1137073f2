"""The appearance of shapes between a few evaluations: colors, lights and maps are interpolated, indices are not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..records import Shapes
from .means import mixed

INTERPOLATED = "color", "slots", "lights", "world_color"
"""Fields of ``Shapes`` that hold colors and lights; the maps of meshes belong to ``deformation``."""


def same_indices(before: Shapes, after: Shapes) -> bool:
    """Whether two evaluations of the same shapes have the same indices, materials and lights of the same kinds."""
    return all(np.array_equal(one, other) for one, other in zip(_indices(before), _indices(after), strict=True))


def appearance(shapes: Shapes, evaluations: Sequence[Shapes], weights: Sequence[float]) -> Shapes:
    """Return shapes with interpolated colors and lights, or with their own if indices differ between evaluations."""
    if not all(same_indices(evaluations[0], other) for other in evaluations[1:]):
        return shapes
    found = mixed([tuple(getattr(one, name) for name in INTERPOLATED) for one in evaluations], weights)
    return replace(shapes, **dict(zip(INTERPOLATED, found, strict=True)))


def difference(shapes: Shapes, truth: Shapes, eye: np.ndarray) -> float:
    """Return the largest difference of colors, of maps, of the lights' directions from the eye, and of their strengths
    over the strongest one's; infinite if indices differ.
    """
    if not same_indices(shapes, truth):
        return np.inf
    own, true = (_values(one, eye) for one in (shapes, truth))
    strongest = float(np.abs(truth.lights.color).max(initial=0.0)) or 1.0
    pairs = [*zip(own, true, strict=True), (shapes.lights.color / strongest, truth.lights.color / strongest)]
    pairs += [
        (one.uv, other.uv)
        for one, other in zip(shapes.meshes, truth.meshes, strict=True)
        if one.uv is not None and other.uv is not None and one.uv.shape == other.uv.shape
    ]
    return max(float(np.abs(np.subtract(one, other)).max(initial=0.0)) for one, other in pairs)


def _indices(shapes: Shapes) -> tuple:
    slots = () if shapes.slots is None else (shapes.slots.first, shapes.slots.material_index)
    return shapes.object_index, shapes.material_index, np.concatenate((np.zeros(0), *slots)), shapes.lights.is_sun


def _values(shapes: Shapes, eye: np.ndarray) -> tuple:
    lights = shapes.lights
    toward = np.where(lights.is_sun[:, None], lights.position, lights.position - eye)
    length = np.linalg.norm(toward, axis=1, keepdims=True)
    slots = np.zeros((0, 4)) if shapes.slots is None else shapes.slots.color
    return shapes.color, slots, shapes.world_color, toward / np.where(length > 0, length, 1.0)
