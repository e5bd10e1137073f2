"""Shapes in the frame of a camera: centers, inverse axes and bounding spheres."""

import numpy as np

from ..conventions import EPS, gamma
from ..maths.exact import FLAT, invert, largest, solve, two_sum
from ..maths.vector import inverse
from ..records import InputError, Pose, Shapes
from .kinds import SHAPE_KINDS, by_kind
from .shape_frames import BOUNDS_FACTOR, InCamera

SIZES = 1e-152, 1e152
"""Range of sizes, distances and their ratios: their squares neither overflow nor underflow."""

def in_camera(shapes: Shapes, pose: Pose) -> InCamera:
    """Return the shapes as a camera at this pose sees them.

    Rounding: the error of a component of ``center`` is at most gamma(4) |center - eye| times the condition number of
    the basis (1 without shear). The error of a row of ``shape_from_world`` is at most ``rounding`` of its length, that
    of ``shape_from_camera`` gamma(4) more; that of ``offset`` is the same times |center - eye|. If a kind finds the eye
    close to a shape, such as to a sphere's surface or to a plane, ``offset`` has twice the digits: it is computed from
    the exact inputs, right to gamma(4) of itself, so that a planet's ground is right from 2 m above it.
    Raises InputError that names the shape if its axes lie in one plane or it is beyond SIZES.
    """
    away = shapes.center - pose.eye
    camera_from_world = inverse(pose.basis)
    radius, reach = np.zeros((2, len(shapes)))
    is_close = np.zeros(len(shapes), bool)
    with np.errstate(all="ignore"):  # shapes that are flat or too far are refused below
        shape_from_world, rounding, skewness = invert(shapes.axes)
        offset = np.einsum("nij,nj->ni", shape_from_world, away)
        may_be_flat = np.isin(shapes.kind, [kind.number for kind in SHAPE_KINDS if kind.may_be_flat])
        skewness[may_be_flat], offset[may_be_flat] = 1.0, 0.0
        _refuse(shapes, may_be_flat, skewness, away, offset)
        axes = np.einsum("ij,njk->nki", camera_from_world, shapes.axes)  # one axis per row
        for kind, at in by_kind(shapes.kind):
            radius[at], reach[at] = kind.extent(shapes, at, axes[at])
            is_close[at] = kind.is_close(offset[at], shape_from_world[at], away[at])
        radius = radius * BOUNDS_FACTOR + 16 * EPS * np.sqrt(np.einsum("ni,ni->n", away, away))
        close = np.flatnonzero(is_close)
    offset_rest = np.full_like(offset, np.nan)
    if close.size:
        solved = solve(shapes.axes[close], shape_from_world[close], *two_sum(shapes.center[close], -pose.eye))
        offset[close], offset_rest[close] = solved
    return InCamera(
        shapes=shapes,
        pose=pose,
        center=np.einsum("ij,nj->ni", camera_from_world, away),
        shape_from_world=shape_from_world,
        rounding=rounding,
        shape_from_camera=np.einsum("nij,kj->nik", shape_from_world, np.ascontiguousarray(pose.basis.T)),
        offset=offset,
        offset_rest=offset_rest,
        radius=radius,
        reach=reach,
    )


def _refuse(shapes: Shapes, may_be_flat, skewness, away, offset) -> None:
    """Raise InputError for the first shape that cannot be cast."""
    size = largest(shapes.axes)
    flat = ~(skewness < FLAT)
    beyond = ~((may_be_flat[:, None] | (size >= SIZES[0])) & (size <= SIZES[1])).all(axis=1)
    beyond |= ~((np.abs(away) <= SIZES[1]) & (np.abs(offset) <= SIZES[1])).all(axis=1)
    if flat.any() or beyond.any():
        first = int(np.argmax(flat | beyond))
        name = shapes.names[shapes.name_index[first]] if shapes.names else f"number {first}"
        reason = "is flat, because its axes lie in one plane: clear its scale, or its parents' (Alt S)"
        if beyond[first] and not (size[first] == 0).any():
            reason = f"has a size, a distance or their ratio beyond {SIZES[0]:g} .. {SIZES[1]:g}: scale the scene"
        elif np.isfinite(shapes.axes[first]).all():
            longest, _, shortest = np.linalg.svd(shapes.axes[first], compute_uv=False)
            if shortest > gamma(8) * longest:
                reason = (
                    f"is {longest / shortest:.3g} times as long as it is thick, and turned or sheared: float64 cannot "
                    "tell its axes from flat ones. Scale it less unevenly"
                )
        raise InputError(f"shape {name!r} {reason}")
