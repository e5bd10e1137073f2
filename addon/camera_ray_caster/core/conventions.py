"""The conventions of all modules of the caster.

Frames
    world     Blender's world, right-handed, Z up, in Blender units.
    camera    +X right, +Y up, the camera looks along -Z. The orthobasis is u = +X, v = +Y, w = -Z. The camera's axes
              in the world are the columns of its matrix, each normalized by itself, as in Blender: scale is ignored,
              a negative scale mirrors, shear stays (then u, v, w have unit length but are not orthogonal).
    shape     the unit sphere |q| = 1, the square |q_x| <= 1, |q_y| <= 1 on q_z = 0, or the vertices of a mesh relative
              to the middle of their bounding box; world = center + axes @ q.
    Arrays and matrices name the target first: ``world_from_camera``.

Pixels
    Column 0 is the left column, row 0 the BOTTOM row, y is up, as in Blender's image buffers. Pixel coordinates are
    continuous over the full frame: (0, 0) is its bottom left corner, the center of pixel (i, j) is (i + 1/2, j + 1/2).
    Normalized view coordinates are [-1, 1] x [-1, 1] over the full frame.
    With a render border, arrays and NPZ files contain only the border. PNG, EXR and masks keep the full frame unless
    Crop to Border is on.
    K (the camera matrix of computer vision) has y DOWN and its origin in the center of the top left pixel, as OpenCV.

Rays
    A ray is origin + t direction. Public directions have unit length. Internally a direction is scaled so that t is
    the depth in Blender's Depth pass: planar cameras (perspective, orthographic) have direction_z = -1 and t is the
    distance along -Z; radial cameras (panoramas) have unit directions and t is the distance from the ray's origin.
    The clip range limits t. A pixel without a ray has NaN in its direction and False in ``valid``.

Numbers
    The arithmetic is float64; numbers that Blender stores as float32 are taken as exact. The ``dtype`` of a cast is
    only the type of the stored passes. Angles are in radians, lengths in Blender units; lengths of lenses, sensors and
    film are in millimeters.
"""

import numpy as np

EPS = float(np.finfo(np.float64).eps) / 2
"""Unit roundoff of float64, 2**-53: the largest relative error of one correctly rounded operation."""

EPS32 = float(np.finfo(np.float32).eps) / 2
"""Unit roundoff of float32, 2**-24."""

FROM_BLENDER = np.diag((1.0, -1.0, -1.0, 1.0))
"""From Blender's camera axes, x right, y up, z back, to OpenCV's: x right, y down, z ahead; the same the other way."""

LAST_FRAME = 1048574
"""Largest frame number in Blender; the smallest is its negative."""


BOTTOM, TOP = "bottom", "top"
"""Where row 0 is: ``rows`` of a function. TOP has OpenCV's pixels: y down from the center of the top left pixel."""


def gamma(n: int, unit_roundoff: float = EPS) -> float:
    """Return n u / (1 - n u), the upper bound of the relative error of n rounded operations in sequence.

    Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., lemma 3.1; pbrt uses it the same way.
    """
    return n * unit_roundoff / (1 - n * unit_roundoff)
