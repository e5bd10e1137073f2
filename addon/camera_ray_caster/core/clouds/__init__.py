"""Point clouds: the hits of a cast as the points of a scanner, with its errors, and as files of other programs."""
