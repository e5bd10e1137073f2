"""The rays of scanners without rows and columns, from files of other programs."""

import numpy as np

from ..any_rays.door import RayPattern
from ..cameras.parts.pose import pose_matrix
from ..programs import PROGRAMS, program_of
from ..programs.parts.document import Document
from ..programs.parts.program import in_words
from .cloud_beams import FROM_CAMERA

SCANNED = in_words(program.name for program in PROGRAMS if program.rays is not None)
"""The programs whose rays are read, in words."""


def pattern_in(path: str, pose, rate: float) -> RayPattern:
    """Return the rays of a file, in the world, with the frames at which they begin, from 0 on.

    pose: of the scanner, as of a camera, (4, 4); without it the scanner has the world's axes, at the origin. A Blender
    unit is a meter. rate: frames per second. Raises InputError, in one line, for a file without such rays.
    """
    document = Document(path)
    program = program_of(document)
    if program is None or program.rays is None:
        raise document.refusal(f"it has no rays of a scanner: give a file of {SCANNED}")
    azimuth, elevation, seconds, rings, height = program.rays(document)
    left, up = np.radians(azimuth), np.radians(elevation)
    directions = np.stack((np.cos(up) * np.cos(left), np.cos(up) * np.sin(left), np.sin(up)), axis=-1)
    origins = np.zeros_like(directions)
    origins[:, 2] = height
    if pose is not None:
        matrix = np.asarray(pose_matrix(pose))
        axes = matrix[:3, :3] @ FROM_CAMERA.T
        directions, origins = directions @ axes.T, origins @ axes.T + matrix[:3, 3]
    return RayPattern(origins, directions, seconds * rate, rings)
