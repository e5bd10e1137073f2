"""A camera as a whole: a model with pose, raster, clip range and pixel times. Pixels become world rays here."""
