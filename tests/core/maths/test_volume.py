"""The exact sign of a volume, against fractions."""

from fractions import Fraction

import numpy as np

from camera_ray_caster.core.maths.exact import volume_sign


def by_fractions(a, b, c) -> int:
    """The sign of a . (b x c) in rational numbers."""
    a, b, c = ([Fraction(float(x)) for x in vector] for vector in (a, b, c))
    volume = sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3))
    return (volume > 0) - (volume < 0)


def test_it_is_the_sign_in_rational_numbers_and_turns_with_two_vectors_swapped():
    """Vectors in one plane up to the last bit, whose volume rounds to nothing or to the wrong sign."""
    rng = np.random.default_rng(5)
    a, b = rng.normal(size=(2, 3, 400))
    weights = rng.normal(size=(2, 400))
    c = weights[0] * a + weights[1] * b
    c[:, 200:] += rng.integers(-2, 3, (3, 200)) * np.spacing(c[:, 200:])
    a[:, 390:], b[:, 390:], c[:, 390:] = np.rint([a, b, c])[:, :, 390:]
    expected = [by_fractions(*vectors) for vectors in zip(a.T, b.T, c.T, strict=True)]
    assert {-1, 0, 1} == set(expected)
    assert volume_sign(a, b, c).tolist() == expected
    assert (volume_sign(a, c, b) == -volume_sign(a, b, c)).all()
