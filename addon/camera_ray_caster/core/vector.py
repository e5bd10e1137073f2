"""Vectors kept as three components that broadcast: a pinhole's x stays a row, its y a column, its z a number."""

from __future__ import annotations

import numpy as np


def matvec(matrix, components):
    """Return matrix @ vector as components; matrix is indexed [row][column], its entries numbers or arrays.

    y and z are added first: for a pinhole only one sum is two-dimensional. Right to gamma(3) of the sum of the
    magnitudes.
    """
    x, y, z = components
    return tuple(row[0] * x + (row[1] * y + row[2] * z) for row in matrix)


def linear(row, components, out=None):
    """Return one row of ``matvec``, rounded alike, into ``out`` where it is given."""
    x, y, z = components
    return np.add(row[0] * x, row[1] * y + row[2] * z, out=out)


def dot(left, right):
    """Return the inner product, right to gamma(3) of the sum of the magnitudes."""
    return left[0] * right[0] + (left[1] * right[1] + left[2] * right[2])


def cross(left, right):
    """Return the cross product, each component right to gamma(2) of the sum of the magnitudes of its two products."""
    return (
        left[1] * right[2] - left[2] * right[1],
        left[2] * right[0] - left[0] * right[2],
        left[0] * right[1] - left[1] * right[0],
    )


def norm(components):
    """Return the Euclidean length, right to gamma(3) relative."""
    return np.sqrt(dot(components, components))


def unit(components):
    """Return the vector scaled to unit length, right to gamma(4) relative; NaN stays NaN."""
    length = norm(components)
    return tuple(component / length for component in components)


def difference(left, right):
    """Return left - right."""
    return tuple(a - b for a, b in zip(left, right, strict=True))


def along(origin, direction, t):
    """Return the point origin + t direction."""
    return tuple(o + t * d for o, d in zip(origin, direction, strict=True))


def components(array):
    """Return the three arrays of a (..., 3) array, as views."""
    return array[..., 0], array[..., 1], array[..., 2]


def rows(array):
    """Return a (..., m, 3) array of matrices as m rows of three entries, as views: what ``matvec`` takes."""
    return tuple(components(array[..., i, :]) for i in range(array.shape[-2]))
