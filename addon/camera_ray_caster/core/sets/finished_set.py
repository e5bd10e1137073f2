"""A finished data set: its views, each with camera, frame, passes, annotations and picture.

The report NAME.json of each picture names its files; from it the camera is made, with the same rays. Arrays of passes
have row 0 at the bottom, also those of NPZ files with the top row first; files of pictures begin at the top.
"""

import json
import os
import sys
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from operator import attrgetter
from pathlib import Path
from typing import Any

import numpy as np

from ..arguments import DAMAGED
from ..camera.camera import Camera
from ..casting.top_down import top_down
from ..conventions import TOP
from ..exports.camera_json import camera_from_json
from ..exports.format import Shot
from ..names import file_name
from ..records import InputError
from . import channels
from .shared_facts import ANNOTATIONS, COCO, DATASET, dataset_of, with_objects

NO_REPORTS = COCO, DATASET, ANNOTATIONS

Files = Iterator[tuple[str, str | bytes | Iterator[str]]]
"""Names and contents of the files of an export."""

TRAIN, VALIDATION = "train", "val"


@dataclass(frozen=True, eq=False)
class View:
    """A picture of a set."""

    folder: Path
    name: str
    """Name of its files without an ending."""
    of: str
    """Name of its report without the ending."""
    camera_name: str
    """Name of its camera, or of the eye, in names of files."""
    frame: float
    title: str
    """Name of its camera in Blender."""
    is_recorded: bool
    """Whether the report has the record of its camera."""
    eye: str = ""
    """Name of its view in a stereo scene; "" otherwise."""
    split: str = ""
    """TRAIN or VALIDATION; "" in a set that is not split."""

    @property
    def report(self) -> Mapping[str, Any]:
        """Return its report."""
        return _report(self)

    @property
    def _own(self) -> Mapping[str, Any]:
        """The entries of the report that are of this view."""
        return self.report["views"][self.eye] if self.eye else self.report

    @property
    def facts(self) -> Mapping[str, Any]:
        """Return the facts of its camera, as its report has them."""
        return self._own["camera"]

    @property
    def file(self) -> Path:
        """Return the path of its file of passes, NPZ or EXR."""
        exr = f"{self.name}.exr"
        return self.folder / (exr if exr in self.report["made"]["files"] else f"{self.name}.npz")

    @property
    def camera(self) -> Camera:
        """Return its camera, with the rays that were cast."""
        return _camera(self)

    @property
    def basis(self) -> np.ndarray:
        """Return the axes of its camera in the world, (3, 3), whose columns are x, y and z, even if the times of pixels
        are an image, which a report does not contain.
        """
        x, y, ahead = (np.array(self.facts[name], np.float64) for name in "uvw")
        return np.stack((x, y, -ahead), axis=1)

    @property
    def meters(self) -> float:
        """Return the length of a Blender unit in meters."""
        return float(self.report.get("host", {}).get("meters", 1.0))

    @property
    def frame_rate(self) -> float:
        """Return the frames per second; Blender's default if the set does not state them."""
        return float(self.report.get("host", {}).get("frame_rate", 24.0))

    @property
    def shot(self) -> Shot:
        """Return the camera at its frame, as it is exported; its picture has the name of the view."""
        suffix = self._own.get("suffix", "")
        name = self.camera_name.removesuffix(suffix)
        return Shot(name, self.frame, self.camera, self.meters, suffix=suffix, rate=self.frame_rate)

    def picture_as(self, name: str) -> Iterator[tuple[str, bytes]]:
        """Yield the PNG of the picture under a name; nothing if the combined pass was not cast."""
        path = self.folder / f"{self.name}.png"
        if path.is_file():
            yield name, path.read_bytes()

    @property
    def annotations(self) -> dict[str, Any]:
        """Return the annotations of the picture. Raises InputError if it has none."""
        return _annotations(self)

    def has(self, key: str) -> bool:
        """Whether a pass is in the file of passes."""
        return key in self._passes

    def pixels(self, key: str) -> np.ndarray:
        """Return a pass, row 0 at the bottom: (rows, columns[, channels]). Raises InputError if it was not cast, and
        for a damaged file.
        """
        if key not in self._passes:
            raise InputError(f"{self.file.name} has no pass {key}: cast the set with --passes {key},...")
        try:
            pixels = self._passes[key]
        except DAMAGED as error:
            raise InputError(f"{str(self.file)!r} is damaged: delete it, and run the same command again") from error
        return top_down({key: pixels})[key] if self._is_top_down else pixels

    @property
    def _is_top_down(self) -> bool:
        return self.report["made"].get("rows") == TOP

    @property
    def _passes(self) -> Mapping[str, np.ndarray]:
        return _opened(self)

    def framed(self, pixels: np.ndarray) -> np.ndarray:
        """Return pixels of the render window, (rows, columns[, channels]), as files of pictures have them: in the full
        frame, 0 outside of the window, unless they are cropped.
        """
        raster = self.camera.raster
        x0, x1, y0, y1 = raster.picture
        outside = (raster.y0 - y0, y1 - raster.y1), (raster.x0 - x0, x1 - raster.x1), (0, 0)
        return np.pad(pixels, outside[: pixels.ndim])

    def points(self) -> tuple[np.ndarray, np.ndarray]:
        """Return where each pixel's ray ends in the world, (rows, columns, 3) float64, and whether it hits something.

        By the pass position, or else by distance or depth along the camera's rays.
        """
        if self.has("position"):
            measure = self.pixels("distance" if self.has("distance") else "depth")
            return self.pixels("position").astype(np.float64), np.isfinite(measure) & (measure > 0)
        rays, key = self.camera.rays(), "distance" if self.has("distance") else "depth"
        along = self.pixels(key).astype(np.float64)
        hit = np.isfinite(along) & rays.valid
        if key == "depth" and self.camera.model.planar:
            along = along / -(rays.directions @ self.camera.pose.basis[:, 2])
        with np.errstate(invalid="ignore"):
            return rays.origins + np.where(hit, along, np.nan)[..., None] * rays.directions, hit

    def planar_depth(self) -> np.ndarray:
        """Return the depth along the viewing direction, as files of pictures have it, (rows, columns) float64; 0 where
        nothing is hit.
        """
        points, hit = self.points()
        depth = -(points - self.camera.pose.eye) @ self.camera.pose.basis[:, 2]
        return self.framed(np.where(hit, depth, 0.0))


HELD = 8
"""Number of views whose reports and cameras are held: those of one frame are compared in pairs. What a view has is read
when it is asked for, so that a set of any size takes the memory of a few pictures.
"""


@lru_cache(maxsize=HELD)
def _report(view: View) -> Mapping[str, Any]:
    report = json.loads((view.folder / f"{view.of}.json").read_text(encoding="utf-8"))
    return {**dataset_of(view.folder).get("common", {}), **report}


@lru_cache(maxsize=HELD)
def _camera(view: View) -> Camera:
    return camera_from_json(json.dumps(view.report), camera=view.eye or None)


@lru_cache(maxsize=1)
def _annotations(view: View) -> dict[str, Any]:
    path = view.folder / f"{view.name}{COCO}"
    try:
        annotations = json.loads(path.read_text(encoding="utf-8"))
        return with_objects(annotations, dataset_of(view.folder).get("objects", []))
    except (OSError, ValueError) as error:
        raise InputError(f"{str(path)!r} cannot be read: make the set with --annotations") from error


@lru_cache(maxsize=2)
def _opened(view: View) -> Mapping[str, np.ndarray]:
    """Return the passes of a view. Two are held, for pairs: an EXR is read whole, and an NPZ stays open."""
    path = view.file
    try:
        return channels.passes_of(path, view.facts) if path.suffix == ".exr" else np.load(path)
    except InputError:
        raise
    except DAMAGED as error:
        raise InputError(f"{str(path)!r} cannot be read: make the set with --format NPZ or EXR") from error


def views_of(path: Path, folder: Path | None = None) -> list[View]:
    """Return the views of a report, two of a stereo scene; none if it is no report, that of a ray map, or lists no file
    of passes. Their cameras may be unrecorded.
    """
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        of = report["made"].get("of", {})
        is_map = of.get("rays") is not None and of.get("frame") is None
        names = list(report["made"]["files"]) if "record" in report and not is_map else []
        eyes = {eye: eye_report for eye, eye_report in report.get("views", {}).items()} or {"": report}
        suffixes = {eye: str(eye_report.get("suffix", "")) for eye, eye_report in eyes.items()}
        title, frame = sys.intern(str(report["camera"]["name"])), float(report["frame"])
        camera = file_name(title)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return []
    stems = [file.rsplit(".", 1)[0] for file in names if file.endswith((".npz", ".exr"))]
    named_alike = [file for file in (*stems, *names) if file.startswith(path.stem)]
    name_of = {
        eye: next((name for name in named_alike or stems if name.endswith(end)), None) for eye, end in suffixes.items()
    }
    if named_alike and not report.get("views"):
        name_of = {"": path.stem}
    return [
        View(folder or path.parent, name, path.stem, camera + suffixes[eye], frame, title,
             eyes[eye].get("record") is not None, eye)
        for eye, name in name_of.items() if name is not None
    ]  # fmt: skip


def read_set(folder: Path) -> list[View]:
    """Return the views of a set, by camera and frame. Raises InputError, in one line, for a folder without any."""
    views = []
    for candidate in (folder, *_folders(folder)):
        names = sorted(os.listdir(candidate)) if candidate.is_dir() else []
        reports = (name for name in names if name.endswith(".json") and not name.endswith(NO_REPORTS))
        views += [view for name in reports for view in views_of(candidate / name, candidate) if view.is_recorded]
    if not views:
        raise InputError(f"{str(folder)!r} has no pictures with reports: make a set with cast.py or dataset.py")
    return sorted(views, key=lambda view: (view.camera_name, view.frame))


def _folders(folder: Path) -> list[Path]:
    """Return the folders that hold the pictures of a set, if it was made with any."""
    several = dataset_of(folder).get("run", {}).get("folders")
    return sorted(path for path in folder.iterdir() if path.is_dir() and path.name[0] != ".") if several else []


def chosen(views: Sequence[View], cameras: Sequence[str] = (), frames: Collection[float] = ()) -> list[View]:
    """Return the views of some cameras, by their names or those of their eyes, and of some frames; by default of all.
    Raises InputError for a camera or frames that the set does not have.
    """
    names = {view: (view.title, view.camera_name) for view in views}
    for name in cameras:
        if not any(name in names_of for names_of in names.values()):
            known = ", ".join(dict.fromkeys(camera_name for _, camera_name in names.values()))
            raise InputError(f"the set has no camera {name!r}, only {known}")
    selected = [view for view in views if not cameras or set(cameras) & set(names[view])]
    selected = [view for view in selected if not frames or view.frame in frames]
    if not selected:
        raise InputError(
            f"the set has none of these frames, only {min(view.frame for view in views):g} to "
            f"{max(view.frame for view in views):g}"
        )
    return selected


def with_splits(views: Sequence[View], share: float) -> list[View]:
    """Return the views with their splits: a part of the frames, evenly spaced and at least one, is for validation, with
    all cameras; of a set of one frame a part of the cameras. Raises InputError for a single view.
    """
    by = attrgetter("frame" if len({view.frame for view in views}) > 1 else "camera_name")
    steps = sorted({by(view) for view in views})
    if len(steps) < 2:
        raise InputError("the set has one picture: it has no part for validation")
    count = min(max(round(share * len(steps)), 1), len(steps) - 1)
    held = {steps[int((k + 0.5) * len(steps) / count)] for k in range(count)}
    return [replace(view, split=VALIDATION if by(view) in held else TRAIN) for view in views]
