"""The one page of conventions that every module of the caster keeps.

Frames
    world     Blender's world, right-handed, Z up, in Blender units.
    camera    +X right, +Y up, the camera looks along -Z. The lecture's orthobasis is u = +X, v = +Y, w = -Z. Its
              axes in the world are the columns of the camera's matrix, each normalized for itself, as Blender does:
              scale is ignored, a negative scale mirrors, shear stays (then u, v, w are unit but not orthogonal).
    shape     the unit sphere |q| = 1, the square |q_x| <= 1, |q_y| <= 1 on q_z = 0, or a mesh's vertices less the
              middle of their box; world = center + axes @ q.
    Arrays and matrices name the target first: ``world_from_camera``.

Pixels
    Column 0 is the left one, row 0 the BOTTOM one, y is up, as in Blender's image buffers. Pixel coordinates are
    continuous over the full frame: (0, 0) is its bottom left corner, the center of pixel (i, j) is (i + 1/2, j + 1/2).
    Normalized view coordinates are [-1, 1] x [-1, 1] over the full frame.
    K (the camera matrix of computer vision) has y DOWN and its origin in the center of the top left pixel, as OpenCV.

Rays
    A ray is origin + t direction. Public directions have unit length. Inside, a direction is scaled so that t is the
    depth that Blender's Depth pass shows: planar cameras (perspective, orthographic) have direction_z = -1 and t is
    the distance along -Z; radial cameras (panoramas) have unit directions and t is the distance from the eye.
    The clip range limits t. A pixel without a ray has NaN in its direction and False in ``valid``.

Numbers
    float64 inside; what Blender stores as float32 is taken as exact. ``dtype`` of a cast is only what is stored.
    Angles are radians, lengths Blender units except lens, sensor and film lengths, which are millimeters.
"""

import numpy as np

EPS = float(np.finfo(np.float64).eps) / 2
"""Unit roundoff of float64, 2**-53: the largest relative error of one correctly rounded operation."""

EPS32 = float(np.finfo(np.float32).eps) / 2
"""Unit roundoff of float32, 2**-24."""


def gamma(n: int, unit_roundoff: float = EPS) -> float:
    """Return n u / (1 - n u): the relative error that n rounded operations in sequence cannot exceed.

    Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., lemma 3.1; pbrt uses it the same way.
    """
    return n * unit_roundoff / (1 - n * unit_roundoff)
