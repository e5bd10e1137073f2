"""The pictures that a command line asks for: of each camera and frame one, made, or taken where it is finished."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

from ...core.camera.camera import Camera
from ...core.casting.passes import PASSES
from ...core.casting.request import PRECISIONS, SHADINGS
from ...core.names import file_names, frame_digits
from ...core.records import InputError
from ...core.report.report import Report
from ..cycles.device import said_of_device
from ..cycles.picture import Picture, picture_of
from ..cycles.shader import check_cycles
from ..engine.engine import CameraRayCaster
from ..engine.passes import tick, ticked
from ..output import files
from ..output.annotations import check_annotations
from ..output.stamps import file_hash, finished, stamp_of
from ..read.camera import ALL, find_camera, find_cameras
from ..read.keypoints import check_key_points
from ..read.scene import read_camera
from . import ray_maps, signals
from .jobs import Job, Outcome, RayMap
from .options import go_to, open_scene, stem, use_camera, warn
from .progress import Progress
from .words import Parser, add_cameras, joined, pass_names, picture_size, sample_count

CYCLES = "CYCLES"
ENGINES = CameraRayCaster.bl_idname, CYCLES

DEFAULT_PASSES = ("combined", "depth", "normal", "position", "object_index")
"""What is cast of a view layer that ticks nothing beside combined."""

SETTINGS = (
    "passes", "shading", "precision", "engine", "samples", "resolution", "format", "half", "calibration_camera",
    "enable_autoexec", "annotations", "keypoints",
)  # fmt: skip
"""The options that pictures depend on, beside the file, camera and frame."""


def add_words(parser) -> None:
    """Add the options that say what pictures are made of, and where they go."""
    add_cameras(parser)
    parser.add_argument("--resolution", type=picture_size, metavar="WxH", help="default: the file's")
    parser.add_argument("--passes", type=pass_names, metavar="A,B,...", help=f"of {', '.join(PASSES)}; default: what "
                        f"the file ticks, or {', '.join(DEFAULT_PASSES)} where it ticks only combined")  # fmt: skip
    parser.add_argument("--shading", type=str.upper, choices=SHADINGS, help="of the combined pass; default: the file's")
    parser.add_argument("--precision", type=str.upper, choices=PRECISIONS,
                        help="what hits are searched with; default: the file's")  # fmt: skip
    parser.add_argument("--engine", type=str.upper, choices=ENGINES, default=ENGINES[0],
                        help="of the combined pass; our passes stand beside it; default: %(default)s")  # fmt: skip
    parser.add_argument("--samples", type=sample_count, metavar="N", help="of Cycles, a pixel; default: the file's")
    parser.add_argument("--format", type=str.upper, choices=files.FORMATS, default=files.EXR,
                        help="of the passes: a multilayer EXR, or NumPy's arrays; default: %(default)s")  # fmt: skip
    parser.add_argument("--half", action="store_true", help="16 bits: real numbers of arrays, colors of EXR files")
    parser.add_argument("--annotations", action="store_true",
                        help="write boxes and masks of objects beside each picture, in COCO's form")  # fmt: skip
    parser.add_argument("--keypoints", nargs="+", metavar="NAME", help="annotate these, too: empties, meshes with "
                        f"vertex groups, or {ALL}")  # fmt: skip
    parser.add_argument("--output", type=Path, default=Path("out"), metavar="FOLDER", help="default: %(default)s")


def parsed(parser: Parser, arguments: Sequence[str]) -> Namespace:
    """Return the options of a command line. Raises InputError for those that do not go together."""
    options = parser.parse_args(joined(arguments, "--frames"))
    if options.cameras and options.camera:
        raise InputError("--cameras names several in place of one: leave out --camera")
    if options.cameras and options.calibration:
        raise InputError("--calibration is of one camera: name it with --camera, in place of --cameras")
    if options.samples and options.engine != CYCLES:
        raise InputError(f"--samples is for --engine {CYCLES}: the file has our own samples")
    if options.shard and options.frames is None:
        raise InputError("--shard is a share of the frames of --frames: give that, too")
    return options


class Pictures:
    """Opens a file and sets it up as a command line asks; then makes its pictures."""

    def __init__(self, options):
        """Raise InputError for what cannot be cast."""
        by_cycles = options.engine == CYCLES
        if by_cycles:
            check_cycles()
        self.options = options
        self.scene = scene = open_scene(options)
        self.warnings: list[str] = []
        if self.keypoints is not None:
            check_annotations(scene)
            check_key_points(scene, self.keypoints)
        if by_cycles:
            scene.cycles.samples = options.samples or scene.cycles.samples
            self.warnings += said_of_device(scene)
        # Blender keeps what it has evaluated for the next picture: 0.3 s less of 1.2 for six subdivided monkeys
        scene.render.use_persistent_data = True
        if options.resolution:
            scene.render.resolution_x, scene.render.resolution_y = options.resolution
            scene.render.resolution_percentage = 100
        self.passes = {layer.name: [entry.key for entry in ticked(scene, layer)] for layer in scene.view_layers}
        for layer, own in self.passes.items():
            if options.passes or own == ["combined"]:
                self.passes[layer] = list(options.passes or DEFAULT_PASSES)
        for setting in ("shading", "precision"):
            if getattr(options, setting):
                setattr(scene.camera_ray_caster, setting, getattr(options, setting))

    @property
    def keypoints(self) -> list[str] | None:
        """The names of the key points to be annotated; None for no annotations."""
        return self.options.keypoints or ([] if self.options.annotations else None)

    def stamp(self) -> dict[str, Any]:
        """Return what every picture is made of; see ``stamps``."""
        settings = {name: getattr(self.options, name) for name in SETTINGS}
        calibration = self.options.calibration
        return stamp_of(settings | {"calibration": calibration and file_hash(calibration)})

    def jobs(self) -> list[Job]:
        """Return a job for each camera and frame that is asked for; cameras of --cameras give files their names."""
        asked, shard, scene = self.options, self.options.shard, self.scene
        frames = asked.frames if shard is None else asked.frames[shard[0] - 1 :: shard[1]]
        if asked.cameras is None:
            numbers = {asked.frame: ""} if frames is None else {frame: f"_{frame_digits(frame)}" for frame in frames}
            return [Job(asked.camera, frame, stem() + end, f"report{end}") for frame, end in numbers.items()]
        names = file_names(camera.name for camera in find_cameras(scene, asked.cameras))
        own = scene.frame_current_final if asked.frame is None else asked.frame
        return [
            Job(camera, frame, *2 * (f"{name}_{frame_digits(frame)}",))
            for frame in ([own] if frames is None else frames)
            for camera, name in names.items()
        ]

    def make(self, job: Job, stamp: dict[str, Any], prog: str, ray_map: RayMap | None = None) -> Outcome:
        """Make a picture, or take it where --skip-existing lets it and it is finished; with ``ray_map`` without the
        passes of a camera's rays where they are those of the map.
        """
        taken = self.finished(job, stamp, ray_map) if self.options.skip_existing else None
        if taken is not None:
            return taken
        camera = self.camera_at(job)  # which is refused before anything is made, if it cannot be cast
        left_out, beside = (), []
        if ray_map is not None and ray_maps.digest_of(camera) == ray_map.digest:
            left_out, beside = ray_maps.PASSES, [self.options.output / ray_map.file]
        self.tick(lambda key: key not in left_out)
        picture = self._by_cycles(prog) if self.options.engine == CYCLES else None
        of = _of(stamp, job, ray_map)
        report, paths = self.render(
            job, of, shown=self.options.pictures, picture=picture, beside=beside, keypoints=self.keypoints
        )
        return Outcome(report.passed, True, report.warnings, report, paths)

    def render(self, job: Job, of: dict[str, Any], **more) -> tuple[Report, list[Path]]:
        """Write the files of a job as the scene is set to it; ``of`` is their stamp, for the rest see ``files``."""
        asked = self.options
        return files.render(
            self.scene, asked.output, job.name, job.report,
            layers=asked.format, half=asked.half, file_output=asked.file_output, stamp=of, **more,
        )  # fmt: skip

    def finished(self, job: Job, stamp: dict[str, Any], ray_map: RayMap | None = None) -> Outcome | None:
        """Return what came of a job that is finished; None of one that is not."""
        found = finished(self.options.output / f"{job.report}.json", _of(stamp, job, ray_map))
        return None if found is None else Outcome(found["passed"])

    def camera_at(self, job: Job) -> Camera:
        """Set the scene to a job's camera and frame, and return the camera. Raises InputError for what none is."""
        if job.camera is not None:
            use_camera(self.scene, find_camera(self.scene, job.camera))
        go_to(self.scene, job.frame)
        return read_camera(self.scene)

    def tick(self, wanted: Callable[[str], bool]) -> None:
        """Tick the wanted ones of the passes that are asked for, in every view layer."""
        for layer, keys in self.passes.items():
            tick(self.scene, self.scene.view_layers[layer], [key for key in keys if wanted(key)])

    def _by_cycles(self, prog: str) -> Picture:
        """Render the current frame with Cycles, whose work no signal's handler can end."""
        files.check(self.scene)
        with signals.leaving(f"{prog}: {signals.STOPPED}"):
            return picture_of(self.scene)


def _of(stamp: dict[str, Any], job: Job, ray_map: RayMap | None) -> dict[str, Any]:
    """Return what a job's files are made of."""
    return {**stamp, "camera": job.camera, "frame": job.frame, "rays": ray_map and ray_map.digest}


def follow(outcomes: Iterable[Outcome], count: int, prog: str) -> Iterator[Outcome]:
    """Yield outcomes as they come, show how far they are where there are several, and warn once of each warning."""
    progress, warned = Progress(count, prog), set()
    for outcome in outcomes:
        for line in outcome.warnings:
            if line not in warned:
                warn(prog, line)
                warned.add(line)
        if count > 1:
            progress.add(outcome.made)
        yield outcome


def summary(made: int, count: int, folder: Path) -> str:
    """Return in words what was made of so many pictures."""
    if made == count:
        return f"Wrote {made} pictures into {folder}"
    return f"Wrote {made} of {count} pictures into {folder}; the others were finished"
