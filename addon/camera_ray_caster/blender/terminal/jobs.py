"""Records that processes exchange about pictures. No bpy here: some threads that handle them may not import it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ...core.report.report import Report


@dataclass(frozen=True)
class PictureJob:
    """One picture. ``camera`` None is the scene's camera, ``frame`` None the file's frame; the rest are file names,
    with the folder if there are folders.
    """

    camera: str | None
    frame: float | None
    name: str
    report: str


@dataclass(frozen=True)
class Jobs:
    """Pictures in their order, made anew at each iteration: there may be millions."""

    each: Callable[[], Iterator[PictureJob]]

    def __iter__(self) -> Iterator[PictureJob]:
        return self.each()

    @cached_property
    def _count(self) -> int:
        return sum(1 for _ in self)

    def __len__(self) -> int:
        return self._count


@dataclass(frozen=True)
class Outcome:
    """Result of a job. ``passed``: no independent reference disagrees. ``made``: the picture was made now, not in an
    earlier run; then the report and the paths of the files are set, but by a worker, and the report's notes.
    ``failure``: why it could not be made, in one line.
    """

    passed: bool
    made: bool = False
    warnings: tuple[str, ...] = ()
    notes: tuple[tuple[str, str], ...] = ()
    exact: tuple[tuple[str, float], ...] = ()
    report: Report | None = None
    paths: Sequence[Path] = ()
    failure: str = ""


@dataclass(frozen=True)
class RayMap:
    """A file of rays, and the digest of the rays."""

    file: str
    digest: str


def first_jobs(jobs: Jobs) -> list[PictureJob]:
    """Return the first job of each camera."""
    first: dict[str | None, PictureJob] = {}
    for job in jobs:
        first.setdefault(job.camera, job)
    return [*first.values()]
