"""The cameras of files with their poses, without Blender."""

import os
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, fields, replace
from typing import cast

import numpy as np

from ..arguments import chosen, number, shown
from ..camera.camera import Camera
from ..camera.pixel_time import rolling_shutter
from ..camera.times import LinearTime
from ..maths.rotations import rigid
from ..motion.evaluations import Motion
from ..motion.interpolation import TimeInterval
from ..programs.parts.placed import Rolling
from ..programs.reading.mounted import Mounted, mounted
from ..records import InputError, no_shapes
from .cameras import checked_path, of_lens, pair_of_pixels, size_of
from .models import models


@dataclass(frozen=True, eq=False, repr=False)
class RigCamera(Camera):
    """A camera of a rig at its first frame. It is also the sequence of its cameras, one for each of its ``frames``."""

    others: tuple[Camera, ...] = ()
    """The cameras at its frames, in their order in the file."""

    @property
    def frames(self) -> tuple[float, ...]:
        """Return the frames at which the file has a pose; () of a camera that stands still."""
        return tuple(float(camera.record.settings["frame"]) for camera in self.others) if self.others else ()

    def __len__(self) -> int:
        return max(1, len(self.others))

    def __iter__(self) -> Iterator[Camera]:
        return iter(self.others or (self,))

    def __getitem__(self, index: int) -> Camera:
        return (self.others or (self,))[index]

    def at(self, frame: float) -> Camera:
        """Return the camera at one of its frames, or at a time of its rows at the first one. Raises InputError for a
        frame at which the file has no pose.
        """
        camera = next((other for other, time in zip(self.others, self.frames, strict=True) if time == frame), None)
        rows = self.pixel_time
        if camera is None and (not self.others or (rows is not None and rows.span[0] <= frame <= rows.span[1])):
            return super().at(frame)
        if camera is None:
            nearest = min(self.frames, key=lambda time: abs(time - frame))
            raise InputError(f"camera {self.name!r} has no pose at frame {frame:g}: the nearest is {nearest:g}")
        return camera


def load_rig(
    path: str | os.PathLike[str], size=None, *, model: str = "", frame_rate: float = 24.0
) -> dict[str, RigCamera]:
    """Return the cameras of a file or folder by name, each with its lens and its pose at its frames: of any program
    that the table of programs lists.

    A camera that moves is the camera at its first frame; ``camera.frames`` are all of them, ``camera.at(frame)`` is the
    camera at another one, and ``list(camera)`` has it at each. One with a rolling shutter moves from the pose of its
    first row to that of its last. Blender units are meters; the world is the file's, or the body of a rig.
    Rotations are the nearest ones to the file's.

    size: (width, height) of the pictures; default that which the file tells.
    model: key of the model of a file that does not name its own, such as "OPENCV_FISHEYE" for one of OpenCV.
    frame_rate: frames in a second, for files with times, the first of which is frame 1.

    Raises InputError, in one line, for a file that cannot be read, has no poses or no lenses, or does not state the
    size of its pictures. A ``UserWarning`` says which poses of the file are left out.
    """
    file, model = checked_path(path), model and chosen(model, "model", models())
    picture_size = None if size is None else pair_of_pixels(size)
    rate = number(frame_rate, "frame_rate", 1e6)
    if rate <= 0:
        raise InputError(f"frame_rate is {shown(frame_rate)}: it must be above 0")
    mounted_cameras = mounted(file, model, picture_size, rate)
    for note in filter(None, (mounted_camera.note for mounted_camera in mounted_cameras)):
        warnings.warn(note, stacklevel=2)
    if not all(mounted_camera.lenses for mounted_camera in mounted_cameras):
        raise InputError(f"file {file!r} is a trajectory, which has no lens: give a file with lenses and poses")
    return {mounted_camera.name: _of(mounted_camera, picture_size, rate) for mounted_camera in mounted_cameras}


def _of(mounted_camera: Mounted, picture_size: tuple[int, int] | None, rate: float) -> RigCamera:
    by_lens: dict[int, Camera] = {}
    cameras = []
    poses = zip(mounted_camera.poses, mounted_camera.rolling or [None] * len(mounted_camera.poses), strict=True)
    for lens, time, (pose, rolling) in zip(mounted_camera.lenses, mounted_camera.frames, poses, strict=True):
        if id(lens) not in by_lens:
            size, chosen = picture_size or size_of(mounted_camera.file, lens), "" if mounted_camera.alone else lens.name
            by_lens[id(lens)] = of_lens(mounted_camera.file, lens, chosen, size, None, mounted_camera.name)
        camera = by_lens[id(lens)].with_pose(rigid(pose))
        if time is not None:
            settings = {**camera.record.settings, "frame": float(time)}
            camera = replace(camera, record=replace(camera.record, settings=settings))
        cameras.append(camera if rolling is None else _rolling(camera, rolling, rate))
    first = {field.name: getattr(cameras[0], field.name) for field in fields(Camera)}
    return RigCamera(**first, others=() if mounted_camera.frames == [None] else tuple(cameras))


def _rolling(camera: Camera, rolling: Rolling, rate: float) -> Camera:
    """Return a camera with a rolling shutter, at whose last row it has another pose."""
    shutter, _ = rolling_shutter(rolling.readout, [offset * rate for offset in rolling.offsets], camera.raster.size)
    settings = {**camera.record.settings, **shutter}
    first = Camera.from_record(replace(camera.record, settings=settings))
    last, times = first.with_pose(rigid(rolling.pose)), cast("LinearTime", first.pixel_time)
    if np.array_equal(first.record.matrix_world, last.record.matrix_world):
        return first
    states = {times.first: (first, no_shapes()), times.last: (last, no_shapes())}
    motion = Motion((TimeInterval.of(states, (times.first, times.last)),), states, times.tolerance, 0.0, ())
    middle = motion.camera_at(min(max(settings["frame"], times.first), times.last))
    return replace(first.with_pose(middle.world_from_camera), motion=motion)
