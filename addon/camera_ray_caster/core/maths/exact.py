"""Arithmetic in pairs of float64: sums and products that keep their rounding errors, for a few critical constants; and
the inverses of matrices that need it.

A pair (high, low) stands for high + low, about 32 digits. The error of one addition or multiplication is itself a
float64, which a few operations compute for numbers and for arrays, unless a value overflows or underflows.
References: D. Knuth, The Art of Computer Programming, vol. 2, 4.2.2 (two_sum); T. J. Dekker, A Floating-Point Technique
for Extending the Available Precision (1971); Ogita, Rump, Oishi, Accurate Sum and Dot Product (2005); N. Higham,
Accuracy and Stability of Numerical Algorithms, 2nd ed., chapter 12 (refinement with precise residuals).
"""

import math

import numpy as np

from ..conventions import EPS, gamma
from .vector import cross, dot, norm

SPLITTER = 2.0**27 + 1
"""Cuts the 53 bits of a float64 into two numbers of 26, whose products are exact (Veltkamp)."""

REFINEMENTS = 5
"""Number of corrections of a solution. Each reduces the error by a factor of some EPS times the condition number, so
that the precision of pairs, EPS^2 times the condition number, is reached up to a condition number of 1e13."""

SKEW = 32.0
"""Axes beyond this skewness (see ``invert``) are inverted with twice the digits."""

FLAT = 1e13
"""Beyond this skewness axes cannot be distinguished from coplanar axes."""


def two_sum(a, b):
    """Return a + b rounded, and its rounding error: their sum is a + b exactly."""
    total = a + b
    b_part = total - a
    return total, (a - (total - b_part)) + (b - b_part)


def two_product(a, b):
    """Return a b rounded, and its rounding error; exact for magnitudes of 1e-140 to 1e290."""
    product = a * b
    (a_high, a_low), (b_high, b_low) = _split(a), _split(b)
    return product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)


def _split(a):
    scaled = SPLITTER * a
    high = scaled - (scaled - a)
    return high, a - high


def total(terms):
    """Return the sum of terms as a pair, as if summed with twice the digits: right to EPS^2 of their magnitudes."""
    high, low = 0.0, 0.0
    for term in terms:
        high, lost = two_sum(high, term)
        low = low + lost
    return two_sum(high, low)


def solve(matrices, inverses, high, low):
    """Return x as a pair, (n, 3) each, with matrices @ x = high + low, from inverses that are right to some digits."""
    x_high, x_low = (inverses @ high[..., None])[..., 0], np.zeros_like(high)
    for _ in range(REFINEMENTS):
        residual = np.empty_like(high)
        for i in range(3):
            terms = [high[:, i], low[:, i]]
            for j in range(3):
                terms += [-product for product in two_product(matrices[:, i, j], x_high[:, j])]
                terms.append(-matrices[:, i, j] * x_low[:, j])
            residual[:, i] = total(terms)[0]
        x_high, lost = two_sum(x_high, (inverses @ residual[..., None])[..., 0])
        x_high, x_low = two_sum(x_high, lost + x_low)
    return x_high, x_low


def invert(axes):
    """Return the inverses of (n, 3, 3) matrices, upper bounds of the errors of their rows over the rows' lengths, (n,),
    and the skewness, (n,): how far from right-angled the axes are, whatever their sizes.

    Inverses of diagonal matrices are right to EPS. A row of the others is the cross product of two columns over the
    determinant. The columns are scaled to about 1 first, so that unequal sizes cost no digits; inverses of skew
    matrices are refined. The skewness is Hadamard's condition number, the product of the axes' lengths over their
    volume: at least 1, inf or NaN for coplanar axes.
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
    """Return the inverses and the skewness of matrices that are not diagonal: see ``invert``."""
    scale = np.ldexp(1.0, -np.frexp(largest(axes))[1])
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


def largest(axes):
    """Return the largest magnitude in each column, (n, 3)."""
    return np.maximum(np.maximum(np.abs(axes[:, 0]), np.abs(axes[:, 1])), np.abs(axes[:, 2]))


def _straight(axes):
    """Return which matrices are diagonal, with no 0 on the diagonal."""
    straight = np.ones(len(axes), bool)
    for i in range(3):
        for j in range(3):
            straight &= (axes[:, i, j] == 0) if i != j else (axes[:, i, j] != 0)
    return straight


def square_less_one(high, low):
    """Return |high + low|^2 - 1 of vectors (n, 3), right to EPS relative and EPS^2 of |high|^2 + 1."""
    terms = [np.full(len(high), -1.0)]
    for i in range(3):
        terms += [*two_product(high[:, i], high[:, i]), 2 * high[:, i] * low[:, i]]
    return total(terms)[0]


def volume_sign(a, b, c) -> np.ndarray:
    """Return the sign of a . (b x c) of vectors (3, n) each, exactly: -1, 0 or 1, (n,).

    The 24 parts of its six products are exact unless one underflows, and so is the sign of their sum.
    """
    terms = []
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        for sign, (left, right) in ((1, (j, k)), (-1, (k, j))):
            for product in two_product(b[left], c[right]):
                terms += two_product(sign * a[i], product)
    return sum_sign(np.array(terms))


def sum_sign(terms) -> np.ndarray:
    """Return the exact signs, (n,), of the sums of terms, (m, n).

    Each pass leaves the leading digits of a sum in its last term and the rounding errors in the others, until the last
    term exceeds them (T. Ogita, S. Rump, S. Oishi, Accurate Sum and Dot Product, 2005: distillation).
    """
    sign, left = np.zeros(terms.shape[1]), np.arange(terms.shape[1])
    for _ in range(len(terms)):
        for k in range(1, len(terms)):
            terms[k], terms[k - 1] = two_sum(terms[k], terms[k - 1])
        others = np.abs(terms[:-1]).sum(axis=0)
        open_ = ~(np.abs(terms[-1]) > 2 * others) & (others > 0)
        sign[left] = np.sign(terms[-1])
        left, terms = left[open_], terms[:, open_]
        if not left.size:
            return sign
    sign[left] = np.sign([math.fsum(column) for column in terms.T.tolist()])
    return sign
