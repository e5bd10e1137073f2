"""Tables of vectors continued beyond their entries and into their holes, and the control points of the spline there.

A missing entry beside known ones continues a cubic, or with fewer than four known ones a polynomial of a lower degree,
through the nearest entries of its row or column; the mean, where several lead to it. A spline through entries that are
continued as cubics has the order of one without knots beside the ends (C. de Boor, A Practical Guide to Splines, 1978,
chapter 4: "not-a-knot"). The control points of the uniform cubic B-spline through the entries are those of M. Unser,
Splines: A Perfect Fit for Signal and Image Processing (1999); an entry's influence on them falls by 0.27 from entry to
entry, so that WIDE entries further on it is below 1e-7.
"""

import numpy as np

WIDE = 12
"""Number of entries by which tables are continued."""

BY_CURVE = 8
"""Number of entries, along rows and columns together, that are continued by curves; further ones by lines, since a
curve leads far away.
"""

CONTINUED = (1, 0, 0, 0), (2, -1, 0, 0), (3, -3, 1, 0), (4, -6, 4, -1)
"""The next entry as a weighted sum of the nearest four, if one, two, three or four are known."""

WEIGHTS = np.array((0.0, 1e-9, 1e-6, 1e-3, 1.0))
"""Weights of continuations by how many entries they follow: if several lead to an entry, the best counts alone."""

WAYS = ((0, 1), (0, -1), (1, 0), (-1, 0))


def extended(values: np.ndarray, known: np.ndarray, degree: int) -> np.ndarray:
    """Return vectors (rows + 2 WIDE, columns + 2 WIDE, k) of a table (rows, columns, k), with a number everywhere.

    known: (rows, columns) bool, which entries count; one at least. degree: 3 for cubics, 1 for lines.
    """
    reach = WIDE + 4  # so that four entries from any missing one are in the array
    values = np.pad(values, ((reach, reach), (reach, reach), (0, 0)))
    known = np.pad(known, reach)
    values[~known] = 0.0
    for step in range(2 * WIDE):  # the corners are so far, along rows and columns
        beside = np.logical_or.reduce([np.roll(known, way, (0, 1)) for way in WAYS])
        beside[:4], beside[-4:], beside[:, :4], beside[:, -4:] = False, False, False, False
        row, column = np.nonzero(beside & ~known)
        if not len(row):
            break
        total, weight = np.zeros((len(row), values.shape[2])), np.zeros((len(row), 1))
        count = 1 + (degree if step < BY_CURVE else 1)
        for down, right in WAYS:
            places = [(row + k * down, column + k * right) for k in range(1, 5)]
            order = np.minimum(np.logical_and.accumulate([known[index] for index in places]).sum(axis=0), count)
            factors = np.take(CONTINUED, order - 1, axis=0)
            estimate = sum(values[index] * factor[:, None] for index, factor in zip(places, factors.T, strict=True))
            total, weight = total + WEIGHTS[order, None] * estimate, weight + WEIGHTS[order, None]
        values[row, column], known[row, column] = total / weight, True
    _carry(values, known)
    return values[4:-4, 4:-4]


def _carry(values: np.ndarray, known: np.ndarray) -> None:
    """Fill what is still missing with the nearest known vector on the left, else on the right, else in the table."""
    if known.all():
        return
    columns = np.arange(known.shape[1])
    left = np.maximum.accumulate(np.where(known, columns, -1), axis=1)
    right = np.minimum.accumulate(np.where(known, columns, known.shape[1])[:, ::-1], axis=1)[:, ::-1]
    source = np.where(left >= 0, left, np.where(right < known.shape[1], right, -1))
    row, column = np.nonzero(~known & (source >= 0))
    values[row, column] = values[row, source[row, column]]
    values[source < 0] = values[tuple(np.argwhere(known)[0])]


def control_points(values: np.ndarray) -> np.ndarray:
    """Return the control points of the bicubic spline through a table (rows, columns, k) whose outermost entries have a
    straight way on: c[i - 1] + 4 c[i] + c[i + 1] = 6 values[i], on both axes.
    """
    for axis in (0, 1):
        lines = np.moveaxis(values, axis, 0)
        values = np.moveaxis(_along_first(lines), 0, axis)
    return values


def _along_first(values: np.ndarray) -> np.ndarray:
    """Solve the tridiagonal equations along the first axis by Thomas's method; the two ends are values themselves."""
    solution, ratio = values.copy(), np.zeros(len(values))
    for i in range(1, len(values) - 1):
        ratio[i] = 1 / (4 - ratio[i - 1])
        solution[i] = (6 * values[i] - solution[i - 1]) * ratio[i]
    for i in range(len(values) - 2, 0, -1):
        solution[i] -= ratio[i] * solution[i + 1]
    return solution
