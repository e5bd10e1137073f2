"""The pictures that a run makes of a data set: cameras and frames, shares of them, and folders for their files.

dataset.json holds the run, so that ``--complete`` knows the pictures without the Blender file.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, Self

from ..names import frame_digits

FILES = 5
"""Maximum number of files of a picture: PNG, passes, report, annotations, points."""


class RunPicture(NamedTuple):
    """A picture of a run."""

    camera: str
    frame: float
    name: str
    """Of its files, without an ending; with the folder, if there are folders."""


@dataclass(frozen=True)
class Run:
    """The cameras and frames of a run. Frames come first: all cameras at the first frame, then at the second."""

    cameras: Mapping[str, str]
    """The name that the files of each camera have."""
    frames: Sequence[float]
    of_camera: Mapping[str, Sequence[float]]
    """The frames of cameras that have poses in some frames only."""
    folders: int = 0
    """Maximum number of files in a folder; 0 for one folder."""
    suffixes: Sequence[str] = ("",)
    """Suffixes of the files of each picture: one for each view."""

    def pictures(self, shard: tuple[int, int] | None = None) -> Iterator[RunPicture]:
        """Yield the pictures in their order, or those of share K of N: every N-th frame, from the K-th on."""
        frames_of = {camera: frozenset(frames) for camera, frames in self.of_camera.items()}
        for frame in self.frames if shard is None else self.frames[shard[0] - 1 :: shard[1]]:
            for camera, file in self.cameras.items():
                if camera not in frames_of or frame in frames_of[camera]:
                    yield RunPicture(camera, frame, self._folder(file, frame) + f"{file}_{frame_digits(frame)}")

    def _folder(self, file: str, frame: float) -> str:
        """Return the folder of a picture: it has some frames of one camera, and the name of the first."""
        if not self.folders:
            return ""
        step = abs(self.frames.step) if isinstance(self.frames, range) else 1
        size = max(1, self.folders // FILES) * step
        return f"{file}_{frame_digits(frame // size * size)}/"

    def as_data(self) -> dict[str, Any]:
        """Return the run as JSON can hold it."""
        frames = self.frames
        ends = [frames[0], frames[-1], frames.step] if isinstance(frames, range) and frames else list(frames)
        name = "range" if isinstance(frames, range) and frames else "frames"
        frames_of = {camera: list(numbers) for camera, numbers in self.of_camera.items()}
        return {"cameras": dict(self.cameras), name: ends, "of_camera": frames_of, "folders": self.folders,
                "suffixes": list(self.suffixes)}  # fmt: skip

    @classmethod
    def of_data(cls, data: Mapping[str, Any]) -> Self:
        """Undo ``as_data``. Raises KeyError, TypeError or ValueError for anything else."""
        if "range" in data:
            first, last, step = data["range"]
            frames: Sequence[float] = range(first, last + 1, step)
        else:
            frames = data["frames"]
        return cls(dict(data["cameras"]), frames, dict(data["of_camera"]), int(data["folders"]), data["suffixes"])
