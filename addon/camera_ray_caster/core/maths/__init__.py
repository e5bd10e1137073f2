"""Arithmetic that knows no camera: vectors, exact sums, inverses, intervals, polynomials, what makes numpy fast."""
