"""The cameras of a file, with their lenses and poses: what "Add Cameras from File" makes of it."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path, PurePath

import numpy as np

from ...conventions import LAST_FRAME
from ...records import InputError
from .. import program_of
from ..parts.document import Document
from ..parts.lens import Lens
from ..parts.placed import FROM_BLENDER, Placed, Rolling
from .camera_poses import objects_and_frames, placed_in
from .folders import nearest, number_of, pair_of, pictures_in
from .lenses import lenses_of

UNNAMED = "", "camera"
"""Names of lenses in files that do not name them."""

MOST_POSES = 100_000
"""Poses that are read from a file."""


@dataclass
class Mounted:
    """A camera of a file. It stands still if it has one pose and no frame."""

    name: str
    file: str
    """The file of its lenses."""
    alone: bool
    """Whether its lens is the only one in the file, which needs no name there."""
    lenses: list[Lens] = field(default_factory=list)
    """The lens for each pose; none of a trajectory."""
    frames: list[float | None] = field(default_factory=list)
    poses: list[np.ndarray] = field(default_factory=list)
    """(4, 4) float64: from Blender's camera frame to the file's, for a trajectory from the moving frame."""
    note: str = ""
    """What to know of it, in one line."""
    rolling: list[Rolling | None] = field(default_factory=list)
    """The rolling shutter at each pose; none of a trajectory or a folder of pictures."""

    @property
    def lens(self) -> Lens | None:
        """Return the lens if all poses have the same; else None."""
        return self.lenses[0] if self.lenses and all(lens is self.lenses[0] for lens in self.lenses) else None

    @property
    def size(self) -> tuple[int, int] | None:
        """Return width and height of the pictures, if the file tells one size."""
        sizes = {tuple(int(lens.settings.get(f"calibration_{side}", 0)) for side in ("width", "height"))
                 for lens in self.lenses}  # fmt: skip
        width, height = sizes.pop() if len(sizes) == 1 else (0, 0)
        return (width, height) if width and height else None


def mounted(
    path: str, key: str, picture_size: tuple[int, int] | None, rate: float, meters: float = 1.0
) -> list[Mounted]:
    """Return the cameras of a file, or of the model in a folder, in the file's order; or one trajectory.

    key, picture_size: see ``lenses_of``. rate: frames per second, for files with times; the first time is frame 1.
    meters: length of the Blender unit in which poses are returned. Images without a frame in their names have the
    frames 1, 2, 3, ... Images with the same name that use different models, or the same frame, are split into cameras
    NAME-1, NAME-2, ... The files of a folder of pictures are its frames. Raises InputError, in one line.
    """
    pair = pair_of(path)
    if pair is None:
        return _of_folder(path, key, picture_size, rate, meters)
    lens_file, pose_file = pair
    document = Document(pose_file, picture_size, key)
    placed = placed_in(document, meters)
    if len(placed) > MOST_POSES:
        raise document.refusal(f"it has {len(placed):,} poses: {MOST_POSES:,} are read")
    if placed[0].moves or placed[0].time is not None:
        placed, note = _once_each(placed)
        frames, poses = _frames(document, placed, rate), [pose.pose for pose in placed]
        return [Mounted(Path(path).stem, lens_file, True, [], frames, poses, note and f"{path}: {note}")]
    lenses = {lens.name: lens for lens in lenses_of(lens_file, key, picture_size)}
    named_poses: list[tuple[Placed, str, float | None, Lens]] = []
    for pose, name, number in _named(placed, {name: lens.model for name, lens in lenses.items()}):
        lens = _lens(document, lenses, pose, number)
        if lens.refusal is not None:
            raise lens.refusal
        named_poses.append((pose, name, number, lens))
    cameras: dict[str, Mounted] = {}
    for pose, name, number, lens in _told_apart(named_poses):
        camera = cameras.setdefault(name, Mounted(name, lens_file, len(lenses) == 1))
        camera.lenses.append(lens)
        camera.frames.append(number)
        pose = pose.changed(lambda matrix: matrix @ FROM_BLENDER)
        camera.poses.append(pose.pose)
        camera.rolling.append(pose.rolling)
    program = program_of(document)
    note = program.note(document) if program is not None else ""
    for camera in cameras.values():
        camera.note = note and f"{path}: {note}"
        note = ""
        if len(set(camera.frames)) < len(camera.frames):
            raise document.refusal(f"camera {camera.name!r} has two poses of one frame: rename its pictures")
    return list(cameras.values())


def _once_each(placed: list[Placed]) -> tuple[list[Placed], str]:
    """Return the poses of a trajectory, of several at one time the last, and a note on those that are left out."""
    last = {pose.frame if pose.time is None else pose.time: pose for pose in placed}
    count = len(placed) - len(last)
    note = f"of poses at one time the last is read; {count} {'is' if count == 1 else 'are'} left out" if count else ""
    return list(last.values()), note


def _frames(document: Document, placed: list[Placed], rate: float) -> list[float | None]:
    """Return the frames of a trajectory, or of its times. Raises InputError beyond Blender's last frame."""
    if placed[0].moves:
        return [pose.frame for pose in placed]
    times = [pose.time or 0.0 for pose in placed]
    frames: list[float | None] = [1 + (time - times[0]) * rate for time in times]
    if max(abs(time - times[0]) for time in times) * rate >= LAST_FRAME:
        raise document.refusal(
            f"its times span {max(times) - min(times):g} s, more than the {LAST_FRAME:,} frames of Blender: are they "
            "seconds?"
        )
    return frames


def _of_folder(path: str, key: str, picture_size: tuple[int, int] | None, rate: float, meters: float) -> list[Mounted]:
    """Return the cameras of a folder with a file for each picture; equal lenses are one."""
    pictures = pictures_in(Path(path))
    moves = [] if pictures.trajectory is None else placed_in(Document(str(pictures.trajectory), picture_size), meters)
    times = np.array([pose.time or 0.0 for pose in moves])
    cameras: dict[str, Mounted] = {}
    lenses: dict[str, Lens] = {}
    for order, file in enumerate(pictures.files, 1):
        move = nearest(times, number_of(file)) if moves else None
        if moves and move is None:
            continue
        for camera_of_file in mounted(str(file), key, picture_size, rate, meters):
            if camera_of_file.lens is None:
                raise InputError(f"file {str(file)!r} of a folder of pictures has no lens: take it out")
            name = camera_of_file.name
            camera = cameras.setdefault(name, Mounted(name, camera_of_file.file, camera_of_file.alone))
            camera.lenses.append(lenses.setdefault(repr(camera_of_file.lens), camera_of_file.lens))
            camera.frames.append(number_of(file) if pictures.of.numbered else float(order))
            camera.poses.append(camera_of_file.poses[0] if move is None else moves[move].pose @ camera_of_file.poses[0])
    if not cameras:
        raise InputError(f"folder {path!r} has no picture at a time of its trajectory: give both of one recording")
    return list(cameras.values())


def _told_apart(poses: list[tuple[Placed, str, float | None, Lens]]) -> list[tuple[Placed, str, float | None, Lens]]:
    """Return poses with names that are of one camera each; see ``mounted``."""
    numbers: dict[str, dict[str, int]] = {}
    models: dict[str, str] = {}
    frames, several = set(), set()
    for _, name, frame, lens in poses:
        lens_numbers = numbers.setdefault(name, {})
        lens_numbers.setdefault(lens.name, len(lens_numbers) + 1)
        if (name, frame) in frames or lens.model != models.setdefault(name, lens.model):
            several.add(name)
        frames.add((name, frame))
    several -= {name for name, lens_numbers in numbers.items() if len(lens_numbers) == 1}
    return [
        (pose, f"{name}-{numbers[name][lens.name]}" if name in several else name, frame, lens)
        for pose, name, frame, lens in poses
    ]


def _lens(document: Document, lenses: dict[str, Lens], pose: Placed, number: float | None) -> Lens:
    """Return the lens of a pose: that of its camera, or of its camera in this frame, or the only one, if it or the
    camera has no name of its own.
    """
    only = next(iter(lenses), "")
    if len(lenses) == 1 and (only in UNNAMED or pose.camera in UNNAMED):
        return lenses[only]
    for name in (pose.camera, f"{pose.camera} {number:g}" if number is not None else pose.camera):
        if name in lenses:
            return lenses[name]
    raise document.refusal(f"it has a pose of camera {pose.camera!r}, and no lens of it: give a file with both")


def _named(placed: list[Placed], models: dict[str, str]) -> list[tuple[Placed, str, float | None]]:
    """Return each pose with its camera's name and its frame: by the names of pictures if all tell a frame, or if each
    has a lens of its own, of several models; one camera if these are of one model; else one for each lens. Pictures of
    one name in several folders are of several cameras, named after these. Frames that are not told are in the order of
    the file. ``models``: key of each lens's model.
    """
    known = objects_and_frames([pose.image for pose in placed])
    by_names = [(pose, *name) for pose, name in zip(placed, known, strict=True)]
    if any(pose.frame is not None for pose in placed):
        return [(pose, pose.image or "Camera", pose.frame) for pose in placed]
    if not any(pose.image for pose in placed):
        return [(pose, pose.camera or "Camera", None) for pose in placed]
    in_folders = _in_folders(by_names)
    if in_folders:
        return in_folders
    if all(number is not None for _, _, number in by_names):
        return [(pose, name or _camera_name(pose, models), number) for pose, name, number in by_names]
    names = {name for _, name, _ in by_names}
    if len({pose.camera for pose in placed}) == len(names) == len(placed) > 1:
        several = len({models.get(pose.camera) for pose in placed}) > 1
        return [
            (pose, name if several else "Camera", float(frame)) for frame, (pose, name, _) in enumerate(by_names, 1)
        ]
    counts: dict[str, int] = {}
    in_order: list[tuple[Placed, str, float | None]] = []
    for pose in placed:
        counts[pose.camera] = counts.get(pose.camera, 0) + 1
        in_order.append((pose, _camera_name(pose, models), float(counts[pose.camera])))
    if len(counts) > 1 and len({name for _, name, _ in in_order}) < len(counts):  # lenses named by their first pictures
        numbers = {camera: i for i, camera in enumerate(counts, 1)}
        return [(pose, f"Camera {numbers[pose.camera]}", number) for pose, _, number in in_order]
    return in_order


def _camera_name(pose: Placed, models: dict[str, str]) -> str:
    """Return the name of a camera whose pictures have none, by the number of its lens."""
    return f"Camera {pose.camera}" if pose.camera.isdecimal() and pose.camera in models else "Camera"


def _in_folders(by_names: list[tuple[Placed, str, float | None]]) -> list[tuple[Placed, str, float | None]]:
    """Return poses with the names of the pictures' folders, the innermost that tell them apart, if several have
    pictures of one name; else []. Frames that are not told are in the order of the file.
    """
    if len({(name, number) for _, name, number in by_names}) == len(by_names):
        return []
    folders = [PurePath(pose.image.replace("\\", "/")).parts[-2::-1] for pose, _, _ in by_names]
    for names in zip(*folders, strict=False):
        pictures = {(folder, name if number is None else number)
                    for folder, (_, name, number) in zip(names, by_names, strict=True)}  # fmt: skip
        if len(pictures) == len(by_names):
            counts = Counter[str]()
            named: list[tuple[Placed, str, float | None]] = []
            for folder, (pose, _, number) in zip(names, by_names, strict=True):
                counts[folder] += 1
                named.append((pose, folder, float(counts[folder]) if number is None else number))
            return named
    return []
