"""Arithmetic that knows no camera: vectors, exact sums, inverses, intervals, polynomials, recorded formulas, speed."""
