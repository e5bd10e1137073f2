"""Vectors as three components that broadcast: a pinhole's x stays a row, its y a column, its z a number."""

import numpy as np

from .recording import array

ALL = slice(None)
"""Every row, or every column."""


def matvec(matrix, components):
    """Return matrix @ vector as components; matrix is indexed [row][column], its entries are numbers or arrays.

    y and z are added first: for a pinhole only one sum is two-dimensional. Right to gamma(3) of the sum of magnitudes.
    """
    x, y, z = components
    return tuple(row[0] * x + (row[1] * y + row[2] * z) for row in matrix)


def linear(row, components, out, spare):
    """Return one row of ``matvec``, rounded alike, in ``out``; ``spare`` is a working array of the same shape.

    For many rows at once, the entries of ``row`` are arrays, (m, 1, 1): other threads wait between fewer calls.
    """
    x, y, z = components
    if not any(isinstance(component, np.ndarray) and component.shape[-1:] == out.shape[-1:] for component in (y, z)):
        return np.add(row[0] * x, row[1] * y + row[2] * z, out=out)
    np.add(np.multiply(row[1], y, out=out), np.multiply(row[2], z, out=spare), out=out)
    return np.add(np.multiply(row[0], x, out=spare), out, out=out)


def inverse(matrix) -> np.ndarray:
    """Return the inverse of a (3, 3) matrix, each row the cross product of two columns over the determinant.

    Right to gamma(8) times the condition number. LAPACK is not used: its threads keep spinning for a tenth of a second
    (OpenBLAS 0.3.23), on the core that the next tile of a picture needs.
    """
    crossed = cofactors(matrix).T
    return crossed / dot(crossed[0], array(matrix)[:, 0])


def cofactors(matrix) -> np.ndarray:
    """Return the cofactor matrix of a (3, 3) matrix, which maps the cross product of two vectors to the cross product
    of their images; right to gamma(2) of the lengths of its columns.
    """
    first, second, third = array(matrix).T
    return array([cross(second, third), cross(third, first), cross(first, second)]).T


def is_one(components) -> bool:
    """Return whether the components are one vector for all rays: three numbers."""
    return all(np.ndim(component) == 0 for component in components)


def is_grid(x, y) -> bool:
    """Return whether x is a row (..., 1, columns) and y a column (..., rows, 1), of one window or of many."""
    return np.ndim(x) == np.ndim(y) > 1 and x.shape[-2] == y.shape[-1] == 1


def is_lattice(components) -> bool:
    """Return whether x is a row, y a column and z a number, as in a pinhole's directions."""
    x, y, z = components
    return np.ndim(z) == 0 and is_grid(x, y)


def dot(left, right):
    """Return the inner product, right to gamma(3) of the sum of the magnitudes."""
    return left[0] * right[0] + (left[1] * right[1] + left[2] * right[2])


def inner(left, right, out, spare):
    """Return ``dot``, rounded alike, in ``out``; ``spare`` is a working array of the same shape."""
    np.add(np.multiply(left[1], right[1], out=out), np.multiply(left[2], right[2], out=spare), out=out)
    return np.add(np.multiply(left[0], right[0], out=spare), out, out=out)


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


def stacked(components, shape) -> np.ndarray:
    """Return components (c of them) that broadcast to a shape as an array (*shape, c), float64."""
    return np.stack([np.broadcast_to(component, shape) for component in components], axis=-1, dtype=np.float64)


def matrix_rows(array):
    """Return a (..., m, 3) array of matrices as m rows of three entries, as views, in the form ``matvec`` takes."""
    return tuple(components(array[..., i, :]) for i in range(array.shape[-2]))


def cut(component, window):
    """Return the part of a broadcastable component that covers a window, given as slices of rows and columns."""
    if not (isinstance(component, np.ndarray) and component.ndim):
        return component
    (rows, columns), (height, width) = window, component.shape
    return component[rows if height > 1 else ALL, columns if width > 1 else ALL]
