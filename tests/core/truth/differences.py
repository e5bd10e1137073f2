"""Derivatives by differences of 60 digits, of which some 20 stay: of vectors that depend on two numbers."""

from itertools import product

from mpmath import mpf

from . import truth

STEP = mpf(10) ** -20
"""Its square, and what rounding leaves of a difference over it, are 1e-40: nothing beside float64's rounding."""


def derivatives(function, x, y):
    """The derivatives of a vector by x and by y, and those of each of these by x and by y.

    None where the function gives none somewhere around.
    """
    values = {
        (i, j): function(mpf(float(x)) + i * STEP, mpf(float(y)) + j * STEP) for i, j in product((-1, 0, 1), repeat=2)
    }
    if any(vector is None for vector in values.values()):
        return None

    def total(weights, divisor):
        return [sum(w * values[at][c] for at, w in weights.items()) / divisor for c in range(len(values[0, 0]))]

    first = [total({(1, 0): 1, (-1, 0): -1}, 2 * STEP), total({(0, 1): 1, (0, -1): -1}, 2 * STEP)]
    along = [total({axis: 1, (0, 0): -2, tuple(-a for a in axis): 1}, STEP**2) for axis in ((1, 0), (0, 1))]
    mixed = total({(1, 1): 1, (1, -1): -1, (-1, 1): -1, (-1, -1): 1}, 4 * STEP**2)
    return first, [[along[0], mixed], [mixed, along[1]]]


def unit_ray(raw, x, y):
    """The world origin and the unit direction through pixel coordinates, six numbers; None where there is no ray."""
    ray = truth.recorded_ray(raw, x, y)
    return ray and [*ray.origin, *(number / ray.length for number in ray.direction)]


def moved(second, rounding):
    """How far derivatives move at most where the pixel is moved by so much in x and in y."""
    return sum(truth.norm(vector) * mpf(float(r)) for vector, r in zip(second, rounding, strict=True))
