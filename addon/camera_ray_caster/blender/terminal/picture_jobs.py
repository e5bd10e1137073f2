"""The pictures that a command line requests, one per camera and frame: made, or skipped if already finished."""

import math
from argparse import Namespace
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import bpy

from ...core.camera.camera import Camera
from ...core.cast import Images
from ...core.casting.pass_needs import check_passes
from ...core.casting.passes import PASSES
from ...core.casting.request import SHADINGS
from ...core.conventions import BOTTOM, TOP
from ...core.file_set import CannotWrite
from ...core.memory import limits_as_input
from ...core.names import file_names, frame_digits
from ...core.records import InputError
from ...core.report.report import Report
from ...core.sets.run import Run
from ...core.sets.shared_facts import dataset_of
from ..cycles.cycles_picture import picture_of
from ..cycles.device import device_notes, use_device
from ..cycles.renderer import EnginePicture
from ..cycles.shader import check_cycles
from ..faces.engine_picture import EEVEE, WORKBENCH
from ..faces.engine_picture import picture_of as faces_picture
from ..output.point_files import PointFiles, add_points
from ..output.stamps import file_hash, finished, stamp_of
from ..process import signals
from ..properties.declared import ENGINE
from ..properties.pass_properties import tick, ticked
from ..read.camera_fields import ALL, find_camera, find_cameras, views_of
from ..read.frames import frame_of
from ..read.scene_keypoints import check_key_points
from ..read.scene_reader import read_camera
from ..read.size import own_size, set_size, size_of
from ..read.unique import unique_name
from ..rig import files_of, shows
from . import frame_files, ray_maps
from .jobs import Jobs, Outcome, PictureJob, RayMap
from .options import go_to, open_scene, stem, use_camera
from .words import Parser, add_cameras, check_cameras, pass_names, sample_count, unstamped

CYCLES = "CYCLES"
ENGINES = ENGINE, CYCLES, EEVEE, WORKBENCH

DEFAULT_PASSES = ("combined", "depth", "normal", "position", "object_index")
"""Passes that are cast if a view layer has only the combined pass enabled."""


def add_words(parser) -> None:
    """Add the options for the content and the folder of pictures."""
    add_cameras(parser)
    parser.add_argument("--passes", type=pass_names, metavar="A,B,...", help=
        f"passes to write, out of {', '.join(PASSES)}; default: the passes enabled in the file, or "
        f"{', '.join(DEFAULT_PASSES)} if only combined is enabled")  # fmt: skip
    parser.add_argument(
        "--shading", type=str.upper, choices=SHADINGS, help="shading of the combined pass; default: the file's"
    )
    parser.add_argument("--engine", type=str.upper, choices=ENGINES, default=ENGINES[0],
                        help="engine that renders the combined pass; the add-on casts the other passes; "
                             "default: %(default)s")  # fmt: skip
    parser.add_argument(
        "--samples", type=sample_count, metavar="N", help="samples of Cycles or EEVEE per pixel; default: the file's"
    )
    parser.add_argument("--device", type=str.upper, metavar="KIND", help=
        "kind of device that Cycles renders on, such as CPU or OPTIX; default: the file's and the Preferences'")
    parser.add_argument("--format", type=str.upper, choices=frame_files.PASS_FORMATS,
                        help="file format of the passes: a multilayer EXR file, or NumPy arrays; "
                             "default: EXR, or NPZ with --dataset")  # fmt: skip
    parser.add_argument(
        "--half", action="store_true", help="write floating-point arrays, and the colors of EXR files, with 16 bits"
    )
    parser.add_argument("--rows", type=str.lower, choices=(BOTTOM, TOP), default=BOTTOM, help=
        "first row of the arrays in NPZ files; top: as in OpenCV, also with y of flow down; "
        "default: %(default)s")  # fmt: skip
    parser.add_argument("--annotations", action="store_true",
                        help="write the boxes and masks of objects next to each picture, in COCO format")  # fmt: skip
    parser.add_argument("--keypoints", nargs="+", metavar="NAME", help=
        f"also annotate these key points: empties, meshes with vertex groups, or {ALL}")  # fmt: skip
    add_points(parser)
    unstamped(parser.add_argument("--output", type=Path, default=Path("out"), metavar="FOLDER", help=
        "default: %(default)s"))  # fmt: skip


def parsed(parser: Parser, arguments: Sequence[str]) -> Namespace:
    """Return the options of a command line. Raises InputError for options that cannot be combined."""
    options = parser.parse_args(arguments)
    check_cameras(options)
    if options.samples and options.engine not in (CYCLES, EEVEE):
        raise InputError(
            f"--samples applies to --engine {CYCLES} and {EEVEE} only: the samples of the others are set in the file"
        )
    if options.device and options.engine != CYCLES:
        raise InputError(f"--device applies to --engine {CYCLES} only: the add-on casts on the processor")
    if options.shard and options.frames is None:
        raise InputError("--shard selects a share of the frames of --frames: add --frames")
    if options.complete and not (options.dataset and options.file is not None and options.file.is_dir()):
        raise InputError("--complete needs the folder of a data set: dataset.py FOLDER --complete")
    for name in "folders", "retries", "log":
        if getattr(options, name) and not options.dataset:
            raise InputError(f"--{name} applies to data sets only: add --dataset")
    if options.retries < 0:
        raise InputError("--retries is negative: give 0 or more")
    options.format = options.format or (frame_files.NPZ if options.dataset else frame_files.EXR)
    if options.rows == TOP and options.format != frame_files.NPZ:
        raise InputError("--rows applies to NPZ files only, pictures have the top row first: add --format NPZ")
    options.skip_existing |= options.dataset
    return options


class Pictures:
    """A file, opened and set up for the options of a command line, and its pictures."""

    def __init__(self, options):
        """Open the file and set up its scene. Raises InputError for bad input."""
        by_cycles = options.engine == CYCLES
        if by_cycles:
            check_cycles()
        self.options = options
        self.warnings: list[str] = []
        self.spare: dict[tuple[str, str], Images] = {}
        self.scene = scene = open_scene(options, self.warnings.append)
        if PointFiles.of(options) is not None and scene.render.use_multiview:  # points belong to one picture
            raise InputError("--points supports a single view only: disable Stereoscopy (Output properties)")
        if self.keypoints is not None:
            check_key_points(scene, self.keypoints)
        if by_cycles:
            scene.cycles.samples = options.samples or scene.cycles.samples
            if options.device:
                use_device(scene, options.device)
            self.warnings += device_notes(scene)
        self.size = size_of(scene)
        # Blender keeps evaluated data for the next picture: 0.3 s less of 1.2 s for six subdivided monkeys
        scene.render.use_persistent_data = True
        self.passes = {layer.name: [entry.key for entry in ticked(scene, layer)] for layer in scene.view_layers}
        self.drawn = {layer.name for layer in scene.view_layers if layer.use_freestyle}
        """The view layers with Freestyle."""
        for layer, keys in self.passes.items():
            if options.passes or keys == ["combined"]:
                self.passes[layer] = list(options.passes or DEFAULT_PASSES)
        if options.shading:
            scene.camera_ray_caster.shading = options.shading

    @property
    def keypoints(self) -> list[str] | None:
        """Names of the key points to annotate; None without annotations."""
        return self.options.keypoints or ([] if self.options.annotations else None)

    def stamp(self) -> dict[str, Any]:
        """Return the stamp that all pictures share; see ``stamps``."""
        settings = {name: getattr(self.options, name) for name in self.options.stamped}
        calibration = self.options.calibration
        rig = [file_hash(path) for name in self.options.rig or () for path in files_of(name)]
        return stamp_of(settings | {"calibration": calibration and file_hash(calibration), "rig": rig or None})

    def run(self) -> Run:
        """Return the cameras and frames of --cameras, whose files are named after the cameras."""
        asked = self.options
        cameras = find_cameras(self.scene, asked.cameras)
        names = file_names(unique_name(camera, bpy.data.objects) for camera in cameras)
        frames = asked.frames
        if frames is None:
            frames = [frame_of(self.scene) if asked.frame is None else asked.frame]
        frames_of = {}
        for name in names if asked.own_frames else ():
            camera = find_camera(self.scene, name)
            frames_of[name] = [frame for frame in frames if shows(camera, frame)]
        return Run(names, frames, frames_of, asked.folders, suffixes_of(self.scene))

    def jobs(self, of_all: bool = False) -> Jobs:
        """Return a job for each requested camera and frame, or those of a share, unless ``of_all`` shares."""
        asked, shard = self.options, None if of_all else self.options.shard
        if asked.cameras is not None:
            run = self.run()
            return Jobs(lambda: (PictureJob(*picture, picture.name) for picture in run.pictures(shard)))
        frames = asked.frames if asked.frames is None or shard is None else asked.frames[shard[0] - 1 :: shard[1]]
        numbers = {asked.frame: ""} if frames is None else {frame: f"_{frame_digits(frame)}" for frame in frames}
        jobs = [PictureJob(asked.camera, frame, stem() + end, f"report{end}") for frame, end in numbers.items()]
        return Jobs(lambda: iter(jobs))

    def tried(self, job: PictureJob, *arguments) -> Outcome:
        """Make a picture as ``make`` does; if that fails, and again for each of --retries, return why. Raises
        CannotWrite, after which others would fail as well.
        """
        failure = ""
        for _ in range(1 + self.options.retries):
            try:
                with limits_as_input():
                    return self.make(job, *arguments)
            except CannotWrite:
                raise
            except InputError as error:
                failure = str(error)
        return Outcome(False, failure=f"{job.name}: {failure}")

    def make(self, job: PictureJob, stamp: dict[str, Any], prog: str, ray_map: RayMap | None = None) -> Outcome:
        """Make a picture, or skip it if it is finished and --skip-existing is given. If the camera's rays are those of
        ``ray_map``, leave out the ray passes.
        """
        taken = self.taken(job, stamp, ray_map)
        if taken is not None:
            return taken
        camera = self.camera_at(job)  # refuses bad input before anything is made
        left_out, beside = (), []
        if ray_map is not None and ray_maps.digest_of(camera) == ray_map.digest:
            left_out, beside = ray_maps.PASSES, [self.options.output / ray_map.file]
        self.tick(lambda key: key not in left_out)
        picture = self._by_engine(prog) if self.options.engine != ENGINE else None
        of = of_job(stamp, job, ray_map)
        report, paths = self.render(
            job, of, shown=self.options.pictures, picture=picture, beside=beside, keypoints=self.keypoints,
            points=PointFiles.of(self.options),
        )  # fmt: skip
        return Outcome(report.passed, True, report.warnings, report.notes, report.exact, report, paths)

    def render(self, job: PictureJob, of: dict[str, Any], **options) -> tuple[Report, list[Path]]:
        """Write the files of a job from the current state of the scene; ``of`` is their stamp; see ``files.render``.
        """
        asked = self.options
        path = asked.output / job.name
        return frame_files.render(
            self.scene, path.parent, path.name, Path(job.report).name,
            layers=asked.format, half=asked.half, rows=asked.rows, file_output=asked.file_output, stamp=of,
            spare=self.spare, dataset=dataset_of(asked.output) if asked.dataset else None, **options,
        )  # fmt: skip

    def taken(self, job: PictureJob, stamp: dict[str, Any], ray_map: RayMap | None = None) -> Outcome | None:
        """Return the outcome of a job that is finished and skipped; None if it has to be done."""
        report = self.options.output / f"{job.report}.json"
        content = finished(report, of_job(stamp, job, ray_map)) if self.options.skip_existing else None
        return None if content is None else Outcome(content["passed"])

    def camera_at(self, job: PictureJob) -> Camera:
        """Set the scene to a job's camera and frame, and return the camera. Raises InputError if it cannot be cast, or
        has not all passes.
        """
        if job.camera is not None:
            camera = find_camera(self.scene, job.camera)
            use_camera(self.scene, camera)
            set_size(self.scene, self.options.resolution or own_size(camera) or self.size)
        go_to(self.scene, job.frame, max(self.options.frames or [-math.inf]))
        camera = read_camera(self.scene)
        check_passes(camera, sorted(set().union(*self.passes.values())))
        return camera

    def tick(self, wanted: Callable[[str], bool]) -> None:
        """Enable those requested passes for which ``wanted`` is true, in every view layer; Freestyle, which draws lines
        on the combined pass, only with that pass.
        """
        for name, keys in self.passes.items():
            layer, wanted_keys = self.scene.view_layers[name], [key for key in keys if wanted(key)]
            tick(self.scene, layer, wanted_keys)
            layer.use_freestyle = name in self.drawn and "combined" in wanted_keys

    def _by_engine(self, prog: str) -> EnginePicture:
        """Render the current frame with another engine, which a Python signal handler cannot interrupt."""
        frame_files.check(self.scene)
        with signals.leaving(f"{prog}: {signals.STOPPED}"):
            if self.options.engine == CYCLES:
                return picture_of(self.scene)
            return faces_picture(self.scene, self.options.engine, self.options.samples or 0)


def of_job(stamp: Mapping[str, Any], job: PictureJob, ray_map: RayMap | None) -> dict[str, Any]:
    """Return the stamp of a job's files."""
    return {**stamp, "camera": job.camera, "frame": job.frame, "rays": ray_map and ray_map.digest}


def suffixes_of(scene) -> list[str]:
    """Return the suffixes of the files of each picture, one for each view of a stereo scene."""
    return [view.file_suffix for view in views_of(scene)] or [""]


def summary(made: int, count: int, folder: Path) -> str:
    """Return a sentence about how many of ``count`` pictures were made."""
    if made == count:
        return f"Wrote {made} pictures into {folder}"
    return f"Wrote {made} of {count} pictures into {folder}; the other pictures were already finished"
