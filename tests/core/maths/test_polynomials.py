"""Positive roots of polynomials, from roots that are known, with coefficients as small and as large as floats are."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from camera_ray_caster.core.maths.polynomials import positive_roots


@pytest.mark.parametrize("roots", [(2.0,), (0.5, 3.0), (-1.0, 0.25, 7.0), (0.0, 1.0), (-2.0,), (1j, -1j, 4.0)])
@pytest.mark.parametrize("scale", [1.0, 1e-200, -1e90])
def test_roots_are_those_above_zero_in_order(roots, scale):
    roots_found = positive_roots(Polynomial(scale * Polynomial.fromroots(roots).coef.real))
    assert roots_found == pytest.approx(sorted(root for root in roots if not root.imag and root > 0), rel=1e-12)


@pytest.mark.parametrize("tail", [[5e-324], [0.0, -5e-324], [1e-260], [0.0]])
def test_leading_coefficients_without_weight_change_nothing(tail):
    """Their quotients are infinite, which numpy warns of, or refuses: the tests take its warnings for errors."""
    assert positive_roots(Polynomial([6e10, -5e10, 1e10, *tail])) == pytest.approx([2, 3], rel=1e-12)


@pytest.mark.parametrize("constant", [0.0, 3.0, 5e-324])
def test_a_constant_has_none(constant):
    assert positive_roots(Polynomial([constant])).size == 0
    assert positive_roots(Polynomial([constant, 0.0])).size == 0


def test_calibrations_with_denormal_coefficients_have_a_limit():
    from camera_ray_caster.core.cameras.parts.radial_tangential import RadialTangential

    names = ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4")
    values = dict.fromkeys(names, 0.0) | {"k1": 0.1, "p1": 1e-3, "k4": 5e-324, "s2": 1e10, "s3": 1e15, "s4": 5e-324}
    assert 0 < RadialTangential(**values).limit < 1e-10
    assert np.isinf(RadialTangential(**dict.fromkeys(names, 0.0)).limit)
