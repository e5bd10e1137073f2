"""Records that processes exchange about pictures. No bpy here: some threads that handle them may not import it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ...core.report.report import Report


@dataclass(frozen=True)
class PictureJob:
    """One picture. ``camera`` None is the scene's camera, ``frame`` None the file's frame; the rest are file names."""

    camera: str | None
    frame: float | None
    name: str
    report: str


@dataclass(frozen=True)
class Outcome:
    """Result of a job. ``passed``: no independent reference disagrees. ``made``: the picture was made now, not in an
    earlier run; then the report and the paths of the files are set, but by a worker, and the report's notes.
    """

    passed: bool
    made: bool = False
    warnings: tuple[str, ...] = ()
    notes: tuple[tuple[str, str], ...] = ()
    exact: tuple[tuple[str, float], ...] = ()
    report: Report | None = None
    paths: Sequence[Path] = ()


@dataclass(frozen=True)
class RayMap:
    """A file of rays, and the digest of the rays."""

    file: str
    digest: str
