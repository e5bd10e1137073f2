"""Point clouds written into files."""

import os

from .. import arguments
from ..any_rays.door import RayImages
from ..clouds.cloud import AXES, SENSOR, PointCloud, scan
from ..clouds.formats import ENDINGS, POINT_FORMATS, files_of
from ..exports.file_writer import write
from ..names import file_name
from ..programs.parts.program import in_words
from .files import Exported, destination, format_came_first


@format_came_first("cloud", lambda done: done.paths)
def save_points(
    data: PointCloud | RayImages,
    path: str | os.PathLike[str],
    format: str | None = None,
    *,
    name: str = "",
    axes: str = SENSOR,
) -> Exported:
    """Write a point cloud of ``scan``, or of the rays of ``cast_rays``, to a file or a folder, for another program;
    return the paths, as ``export`` does.

    path: a file, whose ending tells the format, or with ``format`` a folder.
    format: KEYS.
    name: of the files in a folder, without an ending; default: the camera's.
    axes: "sensor", x ahead, y to the left and z up where each beam fired, or "world".

    All files are written or none. Raises InputError, in one line, for an unknown format or axes, for numbers that the
    format cannot store, and for a folder that cannot be written.
    """
    if isinstance(data, RayImages):
        data = scan(rays=data)
    if not isinstance(data, PointCloud):
        raise TypeError(f"save_points takes the points of scan or the result of cast_rays, not {type(data).__name__}")
    chosen, stem = arguments.word(axes, "axes", AXES), file_name(arguments.name(name) or data.name)
    folder, file, key = destination(path, format, ENDINGS)
    files = {(stem + ending): content for ending, content in files_of(data, key, chosen)}
    if file:
        first, *others = files
        cut = file[: -len(next(ending for ending in ENDINGS if file.lower().endswith(ending)))]
        files = {file: files[first], **{cut + other[len(stem) :]: files[other] for other in others}}
    return Exported(write(files.items(), folder), [])


save_points.__doc__ = (save_points.__doc__ or "").replace("KEYS", in_words(f'"{key}"' for key in POINT_FORMATS))
