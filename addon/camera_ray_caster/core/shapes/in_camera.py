"""Shapes as one camera sees them: center and axes in the camera's frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..conventions import EPS, gamma
from ..maths.exact import solve, square_less_one, two_sum
from ..maths.vector import cross, dot, inverse, norm
from ..records import INFINITE_PLANE, PLANE, SPHERE, InputError, Pose, Shapes

SIZES = 1e-152, 1e152
"""What sizes, distances and their ratios may be: their squares are numbers, too."""

SKEW = 32.0
"""Axes beyond this skewness (see ``invert``) are inverted with twice the digits."""

FLAT = 1e13
"""Beyond this skewness axes cannot be told from ones in one plane."""

MARGIN = 1 + 1e-9
"""Widens what holds a shape: rounding moves its edge by 1e-12 of its size at most."""

CLOSE = 2.0
"""Nearer than this many radii, c = n^2 - 1 is computed with twice the digits."""

GRAZING = 1 / 16
"""A plane whose distance from the eye is this fraction of what it is the sum of is placed with twice the digits."""


@dataclass(frozen=True)
class Placed:
    """Shapes in the camera's frame: a ray o + t d there is q(t) = t D - N in a shape's own frame, with
    D = shape_from_camera d and N = shape_from_camera (center - o). The eye's relative position is taken first, in
    world coordinates, where float32 input makes the difference exact or nearly so; it is scaled afterwards.
    """

    center: np.ndarray
    """(n, 3) camera frame."""
    shape_from_world: np.ndarray
    """(n, 3, 3)."""
    rounding: np.ndarray
    """(n,): by how much of its length each row of ``shape_from_world`` is wrong at most."""
    shape_from_camera: np.ndarray
    """(n, 3, 3)."""
    offset: np.ndarray
    """(n, 3): N of rays from the eye."""
    outside: np.ndarray
    """(n,): |N|^2 - 1, positive where the eye is outside of the unit sphere."""
    radius: np.ndarray
    """(n,): of a sphere about the center that holds the shape, camera frame; inf for infinite planes. A parallelogram's
    reaches its farther corners; an ellipsoid's is the root of the largest row sum of its Gram matrix (Gershgorin):
    the longest axis, where they are at right angles. Widened by MARGIN and by what the center's rounding moves it."""
    reach: np.ndarray
    """(n,): how far the shape reaches from its center along the camera's Z; inf for infinite planes."""


def place(shapes: Shapes, pose: Pose) -> Placed:
    """Return the shapes as a camera at this pose sees them.

    Rounding: a component of ``center`` is right to gamma(4) of |center - eye| times the condition number of the
    basis (1 without shear); a row of ``shape_from_world`` to ``rounding`` of its length, of
    ``shape_from_camera`` to gamma(4) more; ``offset`` likewise times |center - eye|. What cancels in ``outside`` near
    the surface, and in the z of ``offset`` near a plane, is a constant of the shape, and computed from its exact inputs
    with twice the digits: right to gamma(4) of itself there, so that a planet's ground is right from 2 m above it.
    Raises InputError that names a shape whose axes lie in one plane, or which is beyond SIZES.
    """
    away, lost = two_sum(shapes.center, -pose.eye)
    camera_from_world = inverse(pose.basis)
    with np.errstate(all="ignore"):  # what is flat or too far is refused by name
        shape_from_world, rounding, skewness = invert(shapes.axes)
        offset = np.einsum("nij,nj->ni", shape_from_world, away)
        _refuse(shapes, skewness, away, offset)
        axes = np.einsum("ij,njk->nki", camera_from_world, shapes.axes)  # an axis a row
        gram = np.abs(np.einsum("nij,nkj->nik", axes, axes))
        corner = gram[:, 0, 0] + gram[:, 1, 1] + 2 * gram[:, 0, 1]
        radius = np.sqrt(np.where(shapes.kind == PLANE, corner, gram.sum(axis=2).max(axis=1)))
        radius = radius * MARGIN + 16 * EPS * np.sqrt(np.einsum("ni,ni->n", away, away))
        ahead = axes[..., 2]
        flat = np.abs(ahead[:, 0]) + np.abs(ahead[:, 1])
        reach = np.where(shapes.kind == PLANE, flat, np.sqrt(np.einsum("ni,ni->n", ahead, ahead)))
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
        center=np.einsum("ij,nj->ni", camera_from_world, away),
        shape_from_world=shape_from_world,
        rounding=rounding,
        shape_from_camera=np.einsum("nij,kj->nik", shape_from_world, np.ascontiguousarray(pose.basis.T)),
        offset=offset,
        outside=outside,
        radius=np.where(shapes.kind == INFINITE_PLANE, np.inf, radius),
        reach=np.where(shapes.kind == INFINITE_PLANE, np.inf, reach),
    )


def _refuse(shapes: Shapes, skewness, away, offset) -> None:
    """Raise InputError for the first shape that cannot be cast."""
    size = _largest(shapes.axes)
    flat = ~(skewness < FLAT)
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


def invert(axes):
    """Return the inverses of (n, 3, 3) matrices, by how much of its length each row of them is wrong at most, (n,), and
    the skewness, (n,): how far from right-angled the axes are, whatever their sizes.

    Diagonal ones are right to EPS. A row of the others is the cross product of two columns over the determinant; the
    columns are scaled to about 1 first, so that unequal sizes cost no digit; skew ones are corrected. The skewness is
    Hadamard's condition number, the product of the axes' lengths over their volume: from 1 up, inf or NaN where they
    lie in one plane.
    """
    result, rounding, skewness = np.zeros_like(axes), np.full(len(axes), EPS), np.ones(len(axes))
    straight = _straight(axes)
    for i in range(3):
        result[straight, i, i] = 1 / axes[straight, i, i]
    if not straight.all():
        turned = ~straight
        result[turned], skewness[turned] = _invert_turned(axes[turned])
        rounding[turned] = np.where(skewness[turned] > SKEW, gamma(4), gamma(16) * skewness[turned])
    return result, rounding, skewness


def _invert_turned(axes):
    """Return what ``invert`` does, for matrices that are not diagonal, but the rounding."""
    scale = np.ldexp(1.0, -np.frexp(_largest(axes))[1])
    scaled = axes * scale[:, None, :]
    columns = np.ascontiguousarray(scaled.transpose(2, 1, 0))
    first, second, third = columns
    crossed = cross(second, third), cross(third, first), cross(first, second)
    volume = dot(crossed[0], first)
    skewness = norm(first) * norm(second) * norm(third) / np.abs(volume)
    rows = np.empty_like(axes)
    for i, row in enumerate(crossed):
        for j, component in enumerate(row):
            rows[:, i, j] = component / volume
    skew = np.flatnonzero((skewness > SKEW) & (skewness < FLAT))
    if skew.size:
        units = (np.tile(unit, (len(skew), 1)) for unit in np.eye(3))
        solved = [solve(scaled[skew], rows[skew], unit, np.zeros_like(unit))[0] for unit in units]
        rows[skew] = np.stack(solved, axis=2)
    return rows * scale[..., None], skewness


def _largest(axes):
    """Return the largest magnitude in each column, (n, 3)."""
    return np.maximum(np.maximum(np.abs(axes[:, 0]), np.abs(axes[:, 1])), np.abs(axes[:, 2]))


def _straight(axes):
    """Return which matrices are diagonal, with nothing that is 0 on the diagonal."""
    straight = np.ones(len(axes), bool)
    for i in range(3):
        for j in range(3):
            straight &= (axes[:, i, j] == 0) if i != j else (axes[:, i, j] != 0)
    return straight
