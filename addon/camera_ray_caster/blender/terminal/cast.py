"""The command that renders a Blender file into pictures, passes and reports, by one process or several."""

import argparse
import sys
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

import bpy

from ...core.file_set import clear_up
from ...core.report.pass_notes import sentences
from . import dataset, farm, frame_files
from .jobs import PictureJob, first_jobs
from .options import add_frame, add_json, command_parser, show, warn
from .picture_jobs import Pictures, add_words, parsed, suffixes_of, summary
from .progress import EVERY, follow
from .words import add_frames, add_progress, count, scheduler_address, share, unstamped


def run(arguments: Sequence[str], prog: str) -> int:
    """Render cameras and frames of a file into pictures, EXR or NPZ files and reports; return the exit status."""
    options = options_of(arguments, prog)
    if options.complete:
        line, passed = dataset.completed(options)
        print(line, flush=True)
        return int(not passed)
    pictures = Pictures(options)
    for line in pictures.warnings:
        warn(prog, line)
    if options.dataset:
        dataset.fill_in(options, pictures)
    if options.skip_existing:
        clear_up(options.output)
    jobs, stamp = pictures.jobs(), pictures.stamp()
    shared = bool(options.workers or options.scheduler)
    first: dict[str | None, PictureJob] = {}
    if options.dataset or shared:
        _make_absolute(options)
        for job in first_jobs(jobs if options.cameras is None else pictures.jobs(of_all=True)):
            first[job.camera] = job
            pictures.camera_at(job)  # refuse bad input before anything is made
            frame_files.check(pictures.scene)
    several = len(jobs) != 1 or options.dataset or shared
    passed, made, failed = True, 0, 0
    notes: dict[tuple[str, str], None] = {}
    exact: dict[tuple[str, float], None] = {}
    beginning = dataset.begun(pictures, first, stamp) if options.dataset else nullcontext({})
    with farm.cluster(options) as client, beginning as maps:
        if client is None:
            make = pictures.tried if options.dataset else pictures.make
            outcomes = (make(job, stamp, prog, maps.get(job.camera)) for job in jobs)
        else:
            outcomes = farm.outcomes(client, pictures, stamp, maps, jobs)
        for outcome in follow(outcomes, len(jobs), prog, options.log, 0.0 if options.progress else EVERY):
            passed &= outcome.passed or bool(outcome.failure)
            made += outcome.made
            failed += bool(outcome.failure)
            notes |= dict.fromkeys(outcome.notes)
            exact |= dict.fromkeys(outcome.exact)
            if outcome.report is not None and (options.json or not several):
                show(outcome.report, options.json, f"Wrote {', '.join(map(str, outcome.paths))}")
    if failed:
        if options.dataset and failed == len(jobs):
            dataset.give_up(options.output)
        if failed > 1:
            print(f"{prog}: {failed} of {len(jobs)} pictures failed: run the same command again", file=sys.stderr)
        return 2
    if not options.shard:
        dataset.end(options, jobs, suffixes_of(pictures.scene), several)
    if not options.json and (several or not made):
        print(summary(made, len(jobs), options.output), *sentences([*notes], [*exact]), sep="\n", flush=True)
    return int(not passed)


def options_of(arguments: Sequence[str], prog: str) -> argparse.Namespace:
    """Return the options of a command line. Raises InputError for options that cannot be combined."""
    parser = command_parser(
        prog,
        "Cast the rays of a Blender file's cameras into pictures, passes and a report.",
        f"{prog} blend_scenes/spheres_and_planes.blend --output out --passes combined,depth",
        "writes out/spheres_and_planes.png, the 32-bit multilayer out/spheres_and_planes.exr with one layer per "
        "pass, and out/report.json. With --frames, each file name ends in the frame number; with --cameras, it is "
        "CAMERA_FRAME.",
    )
    frames = parser.add_mutually_exclusive_group()
    add_frame(frames)
    add_frames(frames)
    unstamped(parser.add_argument("--shard", type=share, metavar="K/N", help=
        "make only every N-th of the frames, from the K-th on"))  # fmt: skip
    add_words(parser)
    unstamped(parser.add_argument("--skip-existing", action="store_true", help=
        "skip pictures that are already finished, from the same file and settings"))  # fmt: skip
    unstamped(parser.add_argument("--dataset", action="store_true", help=
        "make the folder a data set: CAMERA_FRAME files of the scene's frames, rays of cameras that stand still once, "
        "dataset.json, a reader and a preview; a second run makes the missing pictures"))  # fmt: skip
    unstamped(parser.add_argument("--complete", action="store_true", help=
        "FILE.blend is the folder of a data set whose pictures were made by shares (--shard): write what a run without "
        "shares would have written beside them, or say which pictures are missing"))  # fmt: skip
    unstamped(parser.add_argument("--folders", type=count, default=0, metavar="N", help=
        "put at most N files into a folder, for file systems that are slow with more; default: all in one folder"))
    unstamped(parser.add_argument("--retries", type=int, default=0, metavar="N", help=
        "with --dataset, how often a picture that fails is tried again; the others are made, and the exit status is 2; "
        "default: %(default)s"))  # fmt: skip
    unstamped(parser.add_argument("--log", type=Path, metavar="FILE", help=
        "also append progress to a file, every 30 s"))  # fmt: skip
    where = parser.add_mutually_exclusive_group()
    unstamped(where.add_argument("--workers", type=count, metavar="N", help=
        "number of Dask processes on this machine; default: no Dask, only this process"))  # fmt: skip
    unstamped(where.add_argument("--scheduler", type=scheduler_address, metavar="tcp://HOST:PORT", help=
        "address of the scheduler of a Dask cluster; its workers need this package, bpy, the file and the folder"))
    parser.add_argument("--file-output", action="store_true",
                        help="also write the files of the compositor's File Output nodes; default: the "
                             "nodes write nothing")  # fmt: skip
    add_progress(parser)
    add_json(parser)
    parser.set_defaults(pictures=True)
    return parsed(parser, arguments)


def _make_absolute(options: argparse.Namespace) -> None:
    """Make all paths absolute, so that they hold in every process."""
    options.file, options.output = Path(bpy.data.filepath).absolute(), options.output.absolute()
    options.calibration = options.calibration and options.calibration.absolute()
    options.rig = options.rig and [str(Path(path).absolute()) for path in options.rig]
