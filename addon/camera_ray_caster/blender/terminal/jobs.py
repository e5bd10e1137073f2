"""What is said of pictures between processes. No bpy here: records come and go in threads that may not import it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...core.report.report import Report


@dataclass(frozen=True)
class Job:
    """One picture: a camera, None for the scene's own; a frame, None for the file's; the names of its files."""

    camera: str | None
    frame: float | None
    name: str
    report: str


@dataclass(frozen=True)
class Outcome:
    """What came of a job: whether no witness disagrees, and whether it was made, not finished before. Then it has the
    report, and the paths of the files.
    """

    passed: bool
    made: bool = False
    warnings: tuple[str, ...] = ()
    report: Report | None = None
    paths: Sequence[Path] = ()


@dataclass(frozen=True)
class RayMap:
    """A file, and the digest of the rays in it."""

    file: str
    digest: str
