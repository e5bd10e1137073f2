"""Arithmetic without cameras: vectors, exact sums, inverses, intervals, polynomials, recorded formulas, speed."""
