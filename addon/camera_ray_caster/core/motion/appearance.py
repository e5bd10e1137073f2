"""The appearance of shapes between a few evaluations: colors, lights and maps are interpolated, indices are not."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..records import Lights, Shapes
from .means import mixed

INTERPOLATED = "color", "slots", "lights", "world_color", "uv"
"""Fields of ``Shapes`` that hold colors, lights and maps; the maps of meshes belong to ``deformation``."""


def same_indices(before: Shapes, after: Shapes) -> bool:
    """Whether two evaluations of the same shapes have the same indices, materials and lights of the same kinds."""
    return all(np.array_equal(first, second) for first, second in zip(_indices(before), _indices(after), strict=True))


def appearance(shapes: Shapes, evaluations: Sequence[Shapes], weights: Sequence[float]) -> Shapes:
    """Return shapes with interpolated colors and lights, or with their own if indices differ between evaluations."""
    if not all(same_indices(evaluations[0], other) for other in evaluations[1:]):
        return shapes
    means = mixed([tuple(getattr(evaluation, name) for name in INTERPOLATED) for evaluation in evaluations], weights)
    return replace(shapes, **dict(zip(INTERPOLATED, means, strict=True)))


def difference(shapes: Shapes, truth: Shapes, points: np.ndarray) -> float:
    """Return the largest difference of colors, of maps, of the lights' colors over the strongest one's, and of the
    light at some points, (n, 3), over all light there; infinite if indices differ.
    """
    if not same_indices(shapes, truth):
        return np.inf
    strongest = float(np.abs(truth.lights.color).max(initial=0.0)) or 1.0
    pairs = [*zip(_colors(shapes), _colors(truth), strict=True)]
    pairs.append((shapes.lights.color / strongest, truth.lights.color / strongest))
    pairs += [
        (mesh.uv, true_mesh.uv)
        for mesh, true_mesh in zip(shapes.meshes, truth.meshes, strict=True)
        if mesh.uv is not None and true_mesh.uv is not None and mesh.uv.shape == true_mesh.uv.shape
    ]
    light, true_light = (_light(record.lights, points) for record in (shapes, truth))
    all_light = np.maximum(np.linalg.norm(true_light, axis=-1).sum(axis=0), np.finfo(float).tiny)
    pairs.append((light / all_light[:, None], true_light / all_light[:, None]))
    return max(float(np.abs(np.subtract(value, true_value)).max(initial=0.0)) for value, true_value in pairs)


def _indices(shapes: Shapes) -> tuple:
    slots = () if shapes.slots is None else (shapes.slots.first, shapes.slots.material_index)
    return shapes.object_index, shapes.material_index, np.concatenate((np.zeros(0), *slots)), shapes.lights.is_sun


def _colors(shapes: Shapes) -> tuple:
    slots = np.zeros((0, 4)) if shapes.slots is None else shapes.slots.color
    return shapes.color, slots, shapes.world_color, np.zeros((0, 2, 3)) if shapes.uv is None else shapes.uv


def _light(lights: Lights, points: np.ndarray) -> np.ndarray:
    """Return the light of each lamp at points, as vectors towards it, (lamps, points, 3), in the units of
    ``shading.shade`` times 4 pi^2; of a lamp at the point itself none.
    """
    is_sun = lights.is_sun[:, None, None]
    toward = np.where(is_sun, lights.position[:, None], lights.position[:, None] - points)
    square = np.where(is_sun, 1 / (4 * np.pi), (toward * toward).sum(axis=-1, keepdims=True))
    length = np.maximum(np.linalg.norm(toward, axis=-1, keepdims=True), np.finfo(float).tiny)
    strength = lights.color.max(axis=-1, initial=0.0)[:, None, None]
    return np.where(square > 0, strength / np.where(square > 0, square, 1.0), 0.0) * toward / length
