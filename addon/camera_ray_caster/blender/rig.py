"""Cameras from files: objects with lens, pose, name and keyframes below one empty, which stands for the file's frame.

Blender stores places and quaternions as float32: a camera stands where the file says to 6e-8 of its coordinates and
1e-7 rad. Lenses of models that read calibration files stay linked to the file, with all their digits; a lens that
changes from frame to frame is keyed, in float32.
"""

from collections.abc import Callable, Iterable
from contextlib import ExitStack
from functools import lru_cache
from pathlib import Path

import bpy
import numpy as np
from mathutils import Quaternion

from ..core.camera.pixel_time import MODE, ROLLING_SHUTTER, SETTINGS, rolling_shutter
from ..core.cameras.parts.calibration import FILE, FILE_CAMERA
from ..core.maths.rotations import polar, quaternion
from ..core.programs.parts.lens import Lens
from ..core.programs.parts.placed import FROM_BLENDER
from ..core.programs.reading.folders import beside
from ..core.programs.reading.mounted import Mounted, mounted
from ..core.records import InputError
from .properties.calibration_choice import READING, set_lens, settings_in
from .properties.declared import GROUP, MODEL
from .properties.owners import owner_of
from .properties.setting_labels import label_of
from .read.changes import changed
from .read.frames import frame_rate
from .read.lengths import meters_of
from .read.size import SIZE, size_of

LISTED = 8
"""Number of cameras that a file dialog lists."""


def add_rig(
    scene, paths: Iterable[str], parent=None, model: str = "", say: Callable[[str], object] = lambda note: None
) -> list:
    """Add the cameras of files to a scene, below an empty; return their objects, in the order of the files.

    A trajectory moves the empty, and so all cameras of the other files; without any, it moves a camera like a new one.
    ``parent``: an object below which the empty is put; below a camera, the file's frame is the camera's with y down
    and z ahead, as in OpenCV. If each frame uses one camera, timeline markers switch between them. ``model`` is the
    key of the model for files that do not name theirs; ``say`` takes notes on what was left out. Nothing is added if a
    file cannot be read: InputError.
    """
    paths, rate = list(paths), frame_rate(scene)
    all_mounted = [camera for path in paths for camera in mounted(path, model, size_of(scene), rate, meters_of(scene))]
    trajectories = [camera for camera in all_mounted if not camera.lenses]
    cameras = [camera for camera in all_mounted if camera.lenses]
    if len(trajectories) > 1 or (trajectories and any(len(camera.poses) > 1 for camera in cameras)):
        raise InputError("the files have two movements: give one trajectory, or one file of images, and rigs")
    for note in filter(None, (camera.note for camera in all_mounted)):
        say(note)
    empty = bpy.data.objects.new(Path(paths[0]).stem, None)
    scene.collection.objects.link(empty)
    empty.parent = parent
    if parent is not None and parent.type == "CAMERA":
        empty.matrix_parent_inverse = FROM_BLENDER
    with ExitStack() as stack:  # between two poses cameras move straight
        changed(stack, bpy.context.preferences.edit, keyframe_new_interpolation_type="LINEAR")
        if trajectories and cameras:
            _place(empty, zip(trajectories[0].frames, trajectories[0].poses, strict=True))
            empty[KEYED] = trajectories[0].frames
        objects = [_camera(scene, camera, empty, say) for camera in cameras or trajectories]
    if scene.camera is None and objects:
        scene.camera = objects[0]
    _mark(scene, cameras or trajectories, objects)
    return objects


def contents(scene, path: str) -> list[str]:
    """Return what ``add_rig`` finds in a file, a line for each camera up to LISTED. Raises InputError."""
    cameras = _mounted(path, size_of(scene), frame_rate(scene), meters_of(scene), Path(path).stat().st_mtime_ns)
    lines = [f"{camera.name}: {_in_words(camera)}" for camera in cameras[:LISTED]]
    return [f"{len(cameras)} {'camera' if len(cameras) == 1 else 'cameras'}", *lines, *["…"] * (len(cameras) > LISTED)]


@lru_cache(maxsize=1)
def _mounted(path: str, size, rate: float, meters: float, changed: int) -> list[Mounted]:
    """The cameras of a file, which a file dialog draws again and again."""
    return mounted(path, "", size, rate, meters)


def _in_words(camera: Mounted) -> str:
    model = label_of(camera.lens.model) if camera.lens else "changing lenses" if camera.lenses else "no lens"
    return f"{model}, {len(camera.poses)} {'pose' if len(camera.poses) == 1 else 'poses'}"


def files_of(path: str) -> list[Path]:
    """Return the files at the path of a rig."""
    return list(map(Path, dict.fromkeys(beside(path))))


def frames_of(objects: Iterable) -> list[float]:
    """Return the frames that have keyframes of a place, of objects or their parents, in order."""
    moved = {mover for item in objects for mover in (item, item.parent) if mover is not None}
    frames: set[float] = set()
    for item in moved:
        frames.update(item.get(KEYED, ()))
    return sorted(frames)


def shows(item, frame: float) -> bool:
    """Whether a camera of a rig has a pose in a frame; one that stands still has it in all."""
    frames = frames_of([item])
    return not frames or frame in frames


KEYED = "frames_of_poses"
"""Name of a custom property with the frames of an object's poses in its file."""


def _camera(scene, camera: Mounted, parent, say):
    data = bpy.data.cameras.new(camera.name)
    item = bpy.data.objects.new(camera.name, data)
    scene.collection.objects.link(item)
    item.parent = parent
    if camera.lens is not None:
        _link(data, camera.lens, camera)
    elif camera.lenses:
        _key_lens(data, camera)
    if camera.size is not None:
        item[SIZE] = camera.size
    poses = list(zip(camera.frames, camera.poses, strict=True))
    if any(camera.rolling):
        poses = _rolled(scene, data, camera, say)
    _place(item, poses)
    if None not in camera.frames:
        item[KEYED] = camera.frames
    return item


def _rolled(scene, data, camera: Mounted, say) -> list[tuple[float, np.ndarray]]:
    """Set the rolling shutter of a camera and of its scene; return the times of its first and last rows with the poses
    there.
    """
    poses, shutters = [], {}
    for frame, pose, rolling in zip(camera.frames, camera.poses, camera.rolling, strict=True):
        if rolling is None:
            poses.append((frame, pose))
            continue
        frames = [offset * frame_rate(scene) for offset in rolling.offsets]
        settings, times = rolling_shutter(rolling.readout, frames, camera.size or size_of(scene))
        shutters[tuple(np.round(frames, 6)), rolling.readout] = settings
        poses += [(frame + times[0], pose), (frame + times[1], rolling.pose)]
    for setting in (MODE, *SETTINGS[ROLLING_SHUTTER]):
        owner = owner_of(setting, data, scene)
        if owner is not None:
            setattr(owner, setting.name, settings[setting.name])
    moved = float(np.abs(times - frames).max())
    if len(shutters) > 1 or moved > 1e-6:
        change = "varies: that of its last frame is set" if len(shutters) > 1 else f"is moved by {moved:.3g} frames"
        say(f"the rolling shutter of {camera.name!r} {change}; its rows keep their poses")
    return poses


def _link(data, lens: Lens, camera: Mounted) -> None:
    """Link a camera's data to the file of its lens, if its model reads files; else set the settings."""
    if lens.model not in READING:
        set_lens(data, lens)
        return
    group = getattr(data, GROUP)
    for setting, value in ((MODEL, lens.model), (FILE, camera.file), (FILE_CAMERA, "" if camera.alone else lens.name)):
        setattr(group, setting.name, value)


def _key_lens(data, camera: Mounted) -> None:
    """Key the settings of a lens that changes from frame to frame."""
    for lens, frame in zip(camera.lenses, camera.frames, strict=True):
        set_lens(data, lens)
        for owner, name in settings_in(data, lens):
            owner.keyframe_insert(name, frame=frame)


def _place(item, poses: Iterable[tuple[float | None, np.ndarray]]) -> None:
    """Set or key the place of an object; turns between keyframes take the shorter way."""
    item.rotation_mode = "QUATERNION"
    before = None
    for frame, pose in poses:
        turn = quaternion(polar(pose[None, :3, :3])[0][0])
        turn = -turn if before is not None and np.dot(turn, before) < 0 else turn
        before = turn
        item.location, item.rotation_quaternion = pose[:3, 3], Quaternion(turn)
        if frame is not None:
            item.keyframe_insert("location", frame=frame)
            item.keyframe_insert("rotation_quaternion", frame=frame)


def _mark(scene, cameras: list[Mounted], objects: list) -> None:
    """Bind cameras to the frames by markers of the timeline, if there are several and each frame is that of one."""
    shown = [(frame, item) for camera, item in zip(cameras, objects, strict=True) for frame in camera.frames]
    frames = {frame for frame, _ in shown}
    if len(cameras) < 2 or len(frames) < len(shown) or not all(frame == int(frame or 0) for frame in frames):
        return
    for frame, item in shown:
        scene.timeline_markers.new(item.name, frame=int(frame)).camera = item
