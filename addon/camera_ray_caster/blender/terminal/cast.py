"""The command that renders a Blender file into pictures, passes and reports."""

from collections.abc import Sequence

from ...core.file_set import clear_up
from ..output.annotations import collect
from .options import add_frame, add_json, command_parser, show, warn
from .pictures import Pictures, add_words, follow, parsed, summary
from .words import add_frames, share


def run(arguments: Sequence[str], prog: str) -> int:
    """Render cameras and frames of a file into pictures, EXR or NPZ files and reports; return the exit status."""
    parser = command_parser(
        prog,
        "Cast the rays of a Blender file's cameras at what they show.",
        f"{prog} blend_scenes/spheres_and_planes.blend --output out --passes combined,depth",
        "writes out/spheres_and_planes.png, the 32-bit multilayer out/spheres_and_planes.exr with one layer per "
        "pass, and out/report.json. With --frames, each file name ends in the frame number; with --cameras, it is "
        "CAMERA_FRAME.",
    )
    frames = parser.add_mutually_exclusive_group()
    add_frame(frames)
    add_frames(frames)
    parser.add_argument(
        "--shard", type=share, metavar="K/N", help="make only every N-th of the frames, from the K-th on"
    )
    add_words(parser)
    parser.add_argument("--skip-existing", action="store_true",
                        help="skip pictures that are already finished, from the same file and settings")  # fmt: skip
    parser.add_argument("--file-output", action="store_true",
                        help="also write the files of the compositor's File Output nodes; default: the "
                             "nodes write nothing")  # fmt: skip
    add_json(parser)
    parser.set_defaults(pictures=True)
    options = parsed(parser, arguments)
    pictures = Pictures(options)
    for line in pictures.warnings:
        warn(prog, line)
    if options.skip_existing:
        clear_up(options.output)
    jobs, stamp = pictures.jobs(), pictures.stamp()
    passed, made = True, 0
    for outcome in follow((pictures.make(job, stamp, prog) for job in jobs), len(jobs), prog):
        passed &= outcome.passed
        made += outcome.made
        if outcome.made and (len(jobs) == 1 or options.json):
            show(outcome.report, options.json, f"Wrote {', '.join(map(str, outcome.paths))}")
    if pictures.keypoints is not None and len(jobs) > 1 and not options.shard:
        collect(options.output, [job.name for job in jobs])
    if not options.json and (len(jobs) != 1 or not made):
        print(summary(made, len(jobs), options.output), flush=True)
    return int(not passed)
