"""Cameras made from a model's key and settings, or from a calibration file."""

import os
from textwrap import fill
from typing import Any

import numpy as np

from ..arguments import chosen as the_word
from ..arguments import count, keywords, number, shown, word
from ..arguments import name as a_name
from ..camera import pixel_time
from ..camera.build import camera_from
from ..camera.calibration_file import chosen_lens
from ..camera.camera import Camera
from ..camera.completion import completed
from ..camera.setting_values import checked, declared_by, line_in_words
from ..cameras.behind_port import behind
from ..cameras.parts.aperture import DEPTH_OF_FIELD
from ..cameras.parts.calibration import FILE, SIZE
from ..cameras.parts.parameters import defaults_of, with_values
from ..cameras.parts.port_settings import PORT
from ..cameras.parts.port_settings import SETTINGS as PORTS
from ..cameras.parts.pose import pose_matrix
from ..cameras.parts.settings import Line
from ..programs import READ
from ..programs.parts.lens import FRAME_SIZE, Lens
from ..records import BlenderCamera, InputError
from .file_poses import pose_in_file
from .models import models

LARGEST_SIDE = 65536
"""Blender's largest resolution."""


def camera(model: str, size, pose=None, **settings: Any) -> Camera:
    """Return a camera, made without Blender.

    model: the key of a camera model: see ``models``.
    size: (width, height) of the picture, in pixels.
    pose: (4, 4) matrix from the camera's frame to the world: x right, y up, the camera looks along -z. Each of its axes
        is normalized, as in Blender. Default: the identity. See ``look_at`` and ``pose_from_opencv``. A matrix that is
        transposed, mirrored or sheared is refused.
    settings: the model's settings, such as ``lens=35.0`` (mm) or ``fx=510.0`` (pixels), in the units of Blender's
        properties, angles in radians, also those of a scanner's tables (as text these are in degrees). What is not
        given has its declared default. Of a calibration the size is that of the picture, fy is fx, and the center is in
        the middle, unless they are given; a lens of which nothing is given has the declared field of view on the longer
        side. A setting that has no effect beside the others is refused.
        Nothing is clipped unless ``clip_start`` or ``clip_end`` is given. A slit is a point and a direction, (2, 3); a
        path is (n, 3) points; a time image is (rows, columns), a table of rays (rows, columns, 3), both from the bottom
        left. Every model also takes ``clip_start``, ``clip_end``, ``pixel_aspect_x``, ``use_border``,
        ``border_min_x``, ...; depth of field ``use_dof``, ``focus_distance``, ``aperture_fstop``, ...; and pixel times
        ``time_mode`` with its settings, and ``frame``. Models whose rays leave one eye may be behind glass: ``port``,
        "FLAT" or "DOME", with ``port_thickness``, ``port_glass``, ``port_medium``, ... (lengths in mm).
        ``name`` is the camera's name, by default "Camera".

    Raises InputError, in one line, for a model or a setting that does not exist (it names the nearest one that does),
    and for values without meaning.
    """
    known = models()
    model = the_word(model, "model", known)
    width, height = pair_of_pixels(size)
    name = a_name(settings.pop("name", "Camera"))
    frame = number(settings.pop("frame", 0.0), "frame", pixel_time.LAST_FRAME)
    mode = the_word(settings.pop(pixel_time.MODE.name, pixel_time.NONE), pixel_time.MODE.name, pixel_time.SETTINGS)
    port = the_word(settings.get(PORT.name, PORT.default), PORT.name, PORTS)
    kind = behind(known[model], port)
    declared = declared_by(kind, mode)
    explicit = checked(model, declared, settings)
    for setting in declared.values():
        if isinstance(setting, Line) and setting.name not in settings:
            raise InputError(f"{model} needs {setting.name}: {line_in_words(setting)}")
    if port == PORT.default:
        explicit.pop(PORT.name, None)
    explicit |= completed(model, declared, explicit, (width, height))
    explicit = {**kind.following(explicit), **explicit}
    others = {pixel_time.MODE.name: mode, "frame": frame, "focus_position": None, **defaults_of(declared.values())}
    raw = BlenderCamera(
        name=name, type="PERSP", model=model, matrix_world=pose_matrix(pose), settings=others, clip_start=0.0,
        clip_end=np.inf, resolution_x=width, resolution_y=height,
    )  # fmt: skip
    raw = with_values(raw, explicit)
    for setting in DEPTH_OF_FIELD:
        setting.read(raw)
    return camera_from(raw)


@keywords
def load_calibration(
    path: str | os.PathLike[str], camera: str | None = None, *, size=None, pose=None, model: str = ""
) -> Camera:
    """Return a camera with the lens of a calibration file.

    Programs whose files are read: PROGRAMS.

    camera: name of the camera in the file; default the only one.
    size: (width, height) of the picture; default that of the calibrated picture, which is scaled to another size.
    pose: as in ``camera``; default that of the file, if it has one pose of the camera. Poses in meters become Blender
        units of 1 m. If it has several, a ``UserWarning`` says that they are left out.
    model: key of the model of a file that does not name its own, such as "OPENCV_FISHEYE" for one of OpenCV.

    Raises InputError, in one line, for a file that cannot be read, has no such camera, or does not state its size.
    """
    file, model = checked_path(path), model and the_word(model, "model", models())
    chosen = "" if camera is None else word(camera, "camera")
    lens = chosen_lens(file, model, chosen, None if size is None else pair_of_pixels(size))
    size = size_of(file, lens) if size is None else size
    pose = pose_in_file(file, lens, model, tuple(size)) if pose is None else pose
    return of_lens(file, lens, chosen, size, pose)


_READ = fill(f"Programs whose files are read: {READ}.", 116, subsequent_indent="    ", break_on_hyphens=False)
load_calibration.__doc__ = (load_calibration.__doc__ or "").replace("Programs whose files are read: PROGRAMS.", _READ)

_of_model = camera  # where an argument has the name of the function


def of_lens(file: str, lens: Lens, chosen: str, size, pose, name: str = "") -> Camera:
    """Return the camera with a lens of a file, in which it is ``chosen`` by this name. Raises InputError."""
    settings: dict[str, Any] = {"calibration_file": file, "calibration_camera": chosen}
    if FILE not in models()[lens.model].SETTINGS:  # its picture is the frame
        settings = {key: value for key, value in lens.settings.items() if key not in FRAME_SIZE}
    return _of_model(lens.model, size, pose, name=name or lens.name or "Camera", **settings)


def size_of(file: str, lens: Lens) -> tuple[int, int]:
    """Return the size of the calibrated picture. Raises InputError if the file does not tell it."""
    size = lens.size
    if SIZE[0].name not in lens.settings and FILE in models()[lens.model].SETTINGS:  # the tables tell it
        size = _of_model(lens.model, (1, 1), **lens.settings).model.device_size or (0, 0)
    if not all(size):
        raise InputError(f"calibration file {file!r} does not tell the size of its pictures: give size=")
    return size


def checked_path(path: str | os.PathLike[str]) -> str:
    """Return the path of a file as text. Raises InputError for anything else."""
    try:
        return str(os.fspath(path))
    except TypeError as error:
        raise InputError(f"path is {shown(path)}: it must be the path of a calibration file") from error


def pair_of_pixels(size) -> tuple[int, int]:
    """Return width and height. Raises InputError for anything but two whole numbers above 0."""
    try:
        width, height = size
    except (TypeError, ValueError) as error:
        raise InputError(f"size is {shown(size)}: it must be (width, height) in pixels") from error
    return count(width, "width", LARGEST_SIDE), count(height, "height", LARGEST_SIDE)
