"""Data sets: pictures of cameras and frames in one folder, ``cast --dataset``, and the other files of every set.

Each camera and frame has the passes CAMERA_FRAME.npz (or .exr), the report CAMERA_FRAME.json, from which
``camera_from_json`` makes the camera, and CAMERA_FRAME.png if the combined pass is requested. The ray passes of a
camera that stands still are written once, to CAMERA_rays.npz; reports list it among a frame's files. dataset.json
records the inputs and settings; reader.py reads the set, and preview.png shows the first picture of each camera. A
second run makes only the missing pictures.
"""

import json
from argparse import Namespace
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import Any

import bpy

from ...core.annotations.object_poses import object_poses
from ...core.clouds.formats import SEQUENCED
from ...core.exports.file_writer import write
from ...core.file_set import Taken, atomic_folder, clear_up
from ...core.records import InputError
from ...core.report.indices import indices_of
from ...core.report.report import Report, as_data, uncolored
from ...core.sets import companions, shares
from ...core.sets.run import Run
from ...core.sets.shared_facts import DATASET
from ...core.text_forms.json_text import as_text
from ..engine.job import host_of
from ..output.annotations import category_of, merged_files
from ..output.point_files import collect_sequences
from ..output.stamps import differing, finished
from ..read.camera_fields import check_camera, check_markers
from ..read.scene_reader import read_shapes
from ..read.unique import unique_name
from ..verification.check import verify_camera
from .jobs import Jobs, PictureJob, RayMap, first_jobs
from .picture_jobs import Pictures, of_job
from .ray_maps import made_map

ABOUT = "run", "common", "objects"
"""What dataset.json has beside the stamp: see ``core.sets.run`` and ``core.sets.shared_facts``."""
ENTRIES = "version", "conventions", "layers", "passes", "findings", "left_out", "notes", "exact", "host", "indices"
"""Entries of reports that are the same for all pictures of a scene that stands still. The camera and its record, which
``camera_from_json`` takes, are in every report.
"""
MOST_NAMES = 10
"""Number of missing pictures that are named."""


def fill_in(options: Namespace, pictures: Pictures) -> None:
    """Fill in missing options from the file: the active camera, all frames, and whether there are pictures to show."""
    scene = pictures.scene
    if options.cameras is None and options.camera is None:
        check_camera(scene, scene.camera)
        check_markers(scene)
    options.cameras = options.cameras or [options.camera or unique_name(scene.camera, bpy.data.objects)]
    if options.frames is None and options.frame is None:
        options.frames = range(scene.frame_start, scene.frame_end + 1, scene.frame_step)
    options.pictures = any("combined" in keys for keys in pictures.passes.values())


def common_of(pictures: Pictures, first: PictureJob) -> dict[str, Any]:
    """Return ``common`` and ``objects`` of dataset.json. A picture that differs in an entry has its own."""
    camera, scene = pictures.camera_at(first), pictures.scene
    shapes = read_shapes(scene)
    layers = [layer.name for layer in scene.view_layers if layer.use]
    passes = pictures.passes[layers[0]]
    report = Report(
        camera={}, frame=0.0, layers=tuple(layers), passes=tuple(passes), findings=tuple(verify_camera(scene)),
        left_out=(*shapes.left_out, *uncolored(shapes, passes)), notes=shapes.notes,
        exact=tuple(dict.fromkeys(shapes.exact)), indices={layers[0]: indices_of(shapes)},
        host=host_of(scene),
    )  # fmt: skip
    data = as_data(report)
    common: dict[str, Any] = {"common": {key: data[key] for key in ENTRIES}}
    if pictures.keypoints is not None and camera.pixel_time is None:
        common["objects"] = [{"image_id": 1, **pose} for pose in object_poses(shapes, category_of)]
    return common


@contextmanager
def begun(
    pictures: Pictures, first: Mapping[str | None, PictureJob], stamp: dict[str, Any]
) -> Iterator[dict[str | None, RayMap | None]]:
    """Claim the folder and write the ray maps, which are yielded by camera; ``first`` has each camera's first job.
    Inside the context a share counts as running.
    """
    folder, shard, run = pictures.options.output, pictures.options.shard, pictures.run()
    about = {"run": run.as_data()}
    if not (folder / DATASET).is_file():
        about |= common_of(pictures, next(iter(first.values())))
    _claim(folder, stamp, about)
    with shares.running(folder, shard):
        if shard:
            _claim(folder, stamp, about)  # another run may have begun meanwhile
        yield {camera: made_map(pictures, job, stamp) for camera, job in first.items()}


def end(options: Namespace, jobs: Iterable[PictureJob], suffixes: Sequence[str], several: bool = True) -> None:
    """Write what lies beside the pictures of a run: annotations.json, sequences of points, reader and preview. A folder
    that is no data set's has those for which there are options.
    """
    annotated = several and (options.annotations or options.keypoints is not None)
    if options.points == SEQUENCED:
        collect_sequences(options.output, jobs)
    if annotated or options.dataset:
        whole = merged_files(options.output, jobs, suffixes) if annotated else ()
        firsts = [job.report for job in first_jobs(jobs)]
        write(chain(whole, companions(options.output, firsts)), options.output)
    if options.dataset:
        shares.forget(options.output)


def give_up(folder: Path) -> None:
    """Remove what ``begun`` has written if the folder has nothing else: no picture could be made."""
    if [path.name for path in folder.iterdir()] == [DATASET]:
        (folder / DATASET).unlink()
        folder.rmdir()


def completed(options: Namespace) -> tuple[str, bool]:
    """Make the pictures of shares a data set, as one run would have made it; return a line about it, and whether no
    reference disagrees.

    Raises InputError if pictures are missing; the message has their names, and says which shares still run.
    """
    folder = options.file
    try:
        content = json.loads((folder / DATASET).read_text(encoding="utf-8"))
        stamp, run = {key: value for key, value in content.items() if key not in ABOUT}, Run.of_data(content["run"])
        settings = stamp["settings"]
        asked = Namespace(output=folder, dataset=True, annotations=settings["annotations"],
                          keypoints=settings["keypoints"], points=settings["points"])  # fmt: skip
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"{str(folder)!r} has no {DATASET} of this version: give the folder of a data set") from error
    clear_up(folder)
    jobs = Jobs(lambda: (PictureJob(*picture, picture.name) for picture in run.pictures()))
    maps = {camera: _map_of(folder, name) for camera, name in run.cameras.items()}
    missing, count, passed = list[str](), 0, True
    for job in jobs:
        report = finished(folder / f"{job.report}.json", of_job(stamp, job, maps[job.camera]))
        if report is None:
            count += 1
            missing += [job.name] if count <= MOST_NAMES else []
        else:
            passed &= report["passed"]
    if count:
        busy, and_more = shares.still_running(folder), f" and {count - MOST_NAMES} more" if count > MOST_NAMES else ""
        remedy = f"share {', '.join(busy)} still runs" if busy else "run their shares again"
        raise InputError(f"{count} of {len(jobs)} pictures are missing: {', '.join(missing)}{and_more}; {remedy}")
    end(asked, jobs, run.suffixes)
    return f"The {len(jobs)} pictures in {folder} are a data set", passed


def _map_of(folder: Path, name: str) -> RayMap | None:
    """Return the ray map of the camera whose files have a name."""
    try:
        content = json.loads((folder / f"{name}_rays.json").read_text(encoding="utf-8"))
        return RayMap("", content["made"]["of"]["rays"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _claim(folder: Path, stamp: dict[str, Any], about: Mapping[str, Any] = MappingProxyType({})) -> None:
    """Mark a folder as that of a data set, with entries of ABOUT on its pictures. Raises InputError if it belongs to
    another data set, and if there are shares of another run, which are not complete.
    """
    text = as_text({**stamp, **about})
    with suppress(Taken), atomic_folder(folder, replacing=False) as new:
        (new / DATASET).write_text(text, encoding="utf-8")
    path = folder / DATASET
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        others = differing(stamp, content)
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"{str(path)!r} is not the file of a data set made by this version: choose another folder"
        ) from error
    if others:
        raise InputError(f"{str(folder)!r} has a data set that differs in {', '.join(others)}: choose another folder")
    if content.get("run") == about.get("run"):
        return
    if shares.existing(folder):
        raise InputError(
            f"{str(folder)!r} has shares of a run of other cameras or frames: complete these first (--complete), or "
            "choose another folder"
        )
    text = as_text({**content, "run": about["run"]})  # reports of before lack what is common
    with atomic_folder(folder) as new:
        (new / DATASET).write_text(text, encoding="utf-8")
