"""Shapes as one camera sees them: centre and axes in the camera's frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..conventions import EPS, gamma
from ..exact import solve, square_less_one, two_sum
from ..records import INFINITE_PLANE, PLANE, SPHERE, InputError, Pose, Shapes

SIZES = 1e-152, 1e152
"""What sizes, distances and their ratios may be: their squares are numbers, too."""

SKEW = 32.0
"""Axes beyond this ``skewness`` are inverted with twice the digits."""

FLAT = 1e13
"""Beyond this skewness axes cannot be told from ones in one plane."""

CLOSE = 2.0
"""Nearer than this many radii, c = n^2 - 1 is computed with twice the digits."""

GRAZING = 1 / 16
"""A plane whose distance from the eye is this fraction of what it is the sum of is placed with twice the digits."""


@dataclass(frozen=True)
class Placed:
    """Shapes in the camera's frame: a ray o + t d there is q(t) = t D - N in a shape's own frame, with
    D = shape_from_camera d and N = shape_from_camera (centre - o). The eye's relative position is taken first, in
    world coordinates, where float32 input makes the difference exact or nearly so; it is scaled afterwards.
    """

    centre: np.ndarray
    """(n, 3) camera frame."""
    shape_from_world: np.ndarray
    """(n, 3, 3)."""
    shape_from_camera: np.ndarray
    """(n, 3, 3)."""
    offset: np.ndarray
    """(n, 3): N of rays from the eye."""
    outside: np.ndarray
    """(n,): |N|^2 - 1, positive where the eye is outside of the unit sphere."""
    radius: np.ndarray
    """(n,): of a sphere about the centre that holds the shape, camera frame; inf for infinite planes. A parallelogram's
    reaches its farther corners, an ellipsoid's has the root of the sum of the squared axes, which no skew exceeds."""


def place(shapes: Shapes, pose: Pose) -> Placed:
    """Return the shapes as a camera at this pose sees them.

    Rounding: a component of ``centre`` is right to gamma(4) of |centre - eye| times the condition number of the
    basis (1 without shear); a row of ``shape_from_world`` to ``inverse_rounding`` of its length, of
    ``shape_from_camera`` to gamma(4) more; ``offset`` likewise times |centre - eye|. What cancels in ``outside`` near
    the surface, and in the z of ``offset`` near a plane, is a constant of the shape, and computed from its exact inputs
    with twice the digits: right to gamma(4) of itself there, so that a planet's ground is right from 2 m above it.
    Raises InputError that names a shape whose axes lie in one plane, or which is beyond SIZES.
    """
    away, lost = two_sum(shapes.centre, -pose.eye)
    camera_from_world = np.linalg.inv(pose.basis)
    with np.errstate(all="ignore"):  # what is flat or too far is refused by name
        shape_from_world = inverse(shapes.axes)
        offset = (shape_from_world @ away[..., None])[..., 0]
        _refuse(shapes, away, offset)
        axes = camera_from_world @ shapes.axes
        squares = (axes * axes).sum(axis=1)
        corner = np.sqrt(squares[:, 0] + squares[:, 1] + 2 * np.abs((axes[..., 0] * axes[..., 1]).sum(axis=1)))
        radius = np.where(shapes.kind == PLANE, corner, np.sqrt(squares.sum(axis=1)))
        distance = np.sqrt((offset * offset).sum(axis=-1))
        outside = (distance - 1) * (distance + 1)
        parts = np.abs(shape_from_world[:, 2] * away).sum(axis=-1)
        grazing = np.abs(offset[:, 2]) < GRAZING * parts
        fine = np.flatnonzero(np.where(shapes.kind == SPHERE, distance < CLOSE, grazing))
    if fine.size:
        pair = solve(shapes.axes[fine], shape_from_world[fine], away[fine], lost[fine])
        offset[fine] = pair[0]
        outside[fine] = square_less_one(*pair)
    return Placed(
        centre=away @ camera_from_world.T,
        shape_from_world=shape_from_world,
        shape_from_camera=shape_from_world @ pose.basis,
        offset=offset,
        outside=outside,
        radius=np.where(shapes.kind == INFINITE_PLANE, np.inf, radius),
    )


def _refuse(shapes: Shapes, away, offset) -> None:
    """Raise InputError for the first shape that cannot be cast."""
    size = np.abs(shapes.axes).max(axis=1)
    flat = ~(skewness(shapes.axes) < FLAT)
    beyond = ~((size >= SIZES[0]) & (size <= SIZES[1])).all(axis=1)
    beyond |= ~((np.abs(away) <= SIZES[1]) & (np.abs(offset) <= SIZES[1])).all(axis=1)
    if flat.any() or beyond.any():
        first = int(np.argmax(flat | beyond))
        name = shapes.names[shapes.name_index[first]] if shapes.names else f"number {first}"
        reason = (
            f"has a size, a distance or their ratio beyond {SIZES[0]:g} .. {SIZES[1]:g}: scale the scene"
            if beyond[first] and not (size[first] == 0).any()
            else "is flat, its axes lie in one plane: clear its scale, or its parents' (Alt S)"
        )
        raise InputError(f"shape {name!r} {reason}")


def inverse(axes):
    """Return the inverses of (n, 3, 3) matrices, whose rows are right to ``inverse_rounding`` of their lengths.

    Diagonal ones are right to EPS. A row of the others is the cross product of two columns over the determinant; the
    columns are scaled to about 1 first, so that unequal sizes cost no digit; skew ones are corrected.
    """
    result = np.zeros_like(axes)
    straight = _straight(axes)
    diagonal = np.einsum("nii->ni", axes)
    np.einsum("nii->ni", result)[straight] = 1 / diagonal[straight]
    if not straight.all():
        turned = axes[~straight]
        scaled, power = _scaled(turned)
        first, second, third = np.moveaxis(scaled, 2, 0)
        rows = np.stack((np.cross(second, third), np.cross(third, first), np.cross(first, second)), axis=1)
        rows /= (rows[:, 0] * first).sum(axis=1)[:, None, None]
        skew = skewness(turned)
        skew = np.flatnonzero((skew > SKEW) & (skew < FLAT))
        if skew.size:
            units = (np.tile(unit, (len(skew), 1)) for unit in np.eye(3))
            columns = [solve(scaled[skew], rows[skew], unit, np.zeros_like(unit))[0] for unit in units]
            rows[skew] = np.stack(columns, axis=2)
        result[~straight] = np.ldexp(rows, -power[..., None])
    return result


def inverse_rounding(axes):
    """Return by how much of its length, at most, each row of ``inverse`` is wrong: (n,)."""
    skew = skewness(axes)
    return np.where(_straight(axes), EPS, np.where(skew > SKEW, gamma(4), gamma(16) * skew))


def skewness(axes):
    """Return how far from right-angled axes (n, 3, 3) are: the product of their lengths over their volume, from 1 up.

    Hadamard's condition number: the sizes of the axes do not count. inf or NaN where the axes lie in one plane.
    """
    result = np.ones(len(axes))
    turned = ~_straight(axes)
    scaled, _ = _scaled(axes[turned])
    first, second, third = np.moveaxis(scaled, 2, 0)
    volume = np.abs((np.cross(first, second) * third).sum(axis=1))
    with np.errstate(divide="ignore", invalid="ignore"):
        result[turned] = np.sqrt((scaled * scaled).sum(axis=1)).prod(axis=1) / volume
    return result


def _scaled(axes):
    """Return matrices with columns scaled by powers of two to about 1, and the powers that were taken out, (n, 3)."""
    power = np.frexp(np.abs(axes).max(axis=1))[1]
    return np.ldexp(axes, -power[:, None, :]), power


def _straight(axes):
    diagonal = np.einsum("nii->ni", axes)
    return (np.count_nonzero(axes, axis=(1, 2)) == 3) & (diagonal != 0).all(axis=1)
