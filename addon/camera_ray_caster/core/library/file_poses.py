"""The pose of a camera that a calibration file has beside its lens."""

import re
import warnings

import numpy as np

from ..maths.rotations import rigid
from ..programs import program_of
from ..programs.parts import ray_arrays
from ..programs.parts.document import Document
from ..programs.parts.lens import Lens
from ..programs.reading.mounted import mounted
from ..records import InputError

WITHOUT = "it has no", "neither YAML nor JSON", "is not XML"
"""Words of the refusals of files of lenses alone."""

ENTRY = re.compile(
    r"\b((?:\w+_)?(?:[Rr]otation|[Tt]ranslation|[Ee]xtrinsic|[Pp]ose|[Qq]uaternion|[rt]vec)s?|T|T_\w+)[\"']?\s*[:>]"
)
"""Names of entries in which files have poses."""

FRAME_RATE = 24.0
"""Frames in a second, by which the times of a file become frames; only their number counts here."""

CALLER = 3
"""Levels of functions from the warning up to the user's line."""


def pose_in_file(path: str, lens: Lens, model: str, picture_size: tuple[int, int]) -> np.ndarray | None:
    """Return the pose of a lens in a file, (4, 4) from Blender's camera frame to the file's, as the nearest rotation;
    None if the file has none. The world is the file's: of a rig without one, OpenCV's axes of its first camera.
    Warns, and returns None, if the file has several poses of the lens, or bad ones.
    """
    document = Document(path)
    is_table, program = lens.model == ray_arrays.KEY, program_of(document)
    if document.is_binary or (is_table and (program is None or program.poses is None)):
        return ray_arrays.pose_in(document)
    try:
        cameras = mounted(path, model, picture_size, FRAME_RATE)
    except InputError as error:
        entry = ENTRY.search(document.text)
        if not any(words in str(error) for words in WITHOUT):
            warnings.warn(f"the poses in {path!r} are left out: {error}", stacklevel=CALLER)
        elif entry:
            warnings.warn(
                f"the poses that {path!r} may have in {entry[1]!r} are not read: give pose=", stacklevel=CALLER
            )
        return None
    poses = [pose for camera in cameras for mounted_lens, pose in zip(camera.lenses, camera.poses, strict=False)
             if (mounted_lens.name == lens.name if is_table else mounted_lens == lens)]  # fmt: skip
    if len(poses) > 1:
        warnings.warn(
            f"the {len(poses)} poses of camera {lens.name!r} in {path!r} are left out: give pose=", stacklevel=CALLER
        )
    if len(poses) != 1:
        return None
    return rigid(poses[0])
