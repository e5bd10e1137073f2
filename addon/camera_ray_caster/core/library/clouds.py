"""Point clouds written into files."""

from __future__ import annotations

import os
from pathlib import Path

from .. import arguments
from ..clouds.cloud import AXES, SENSOR, PointCloud
from ..clouds.formats import files_of
from ..exports.writing import write
from ..names import file_name


def save_points(
    format: str, cloud: PointCloud, folder: str | os.PathLike[str], name: str = "", *, axes: str = SENSOR
) -> list[Path]:
    """Write a point cloud of ``scan`` into a folder, for another program; return the paths.

    format: "ply", "pcd", "kitti" (.bin, and SemanticKITTI's .label), "nuscenes" (.pcd.bin and labels), "las" (1.4) or
        "npz".
    name: of the files, without an ending; default: the camera's.
    axes: "sensor", x ahead, y to the left and z up where each beam fired, or "world".

    All files are written or none. Raises InputError, in one line, for an unknown format or axes, for numbers that the
    format cannot store, and for a folder that cannot be written.
    """
    if not isinstance(cloud, PointCloud):
        raise TypeError(f"save_points takes the points of scan, not {type(cloud)}")
    chosen, stem = arguments.word(axes, "axes", AXES), file_name(arguments.name(name) or cloud.name)
    files = ((stem + ending, content) for ending, content in files_of(cloud, format, chosen))
    return write(files, arguments.folder(folder))
