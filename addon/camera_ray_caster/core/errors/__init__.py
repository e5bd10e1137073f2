"""Forward error bounds: the effects of rounding on rays and hits."""
