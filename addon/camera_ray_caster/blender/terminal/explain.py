"""The command that explains a pixel step by step."""

from argparse import ArgumentTypeError
from collections.abc import Sequence

import numpy as np

from ...core.cast import moment
from ...core.report.lesson import lesson
from ..engine.reading import read_as_rendered
from . import signals
from .options import add_frame, command_parser, go_to, open_scene, warn


def run(arguments: Sequence[str], prog: str) -> int:
    """Print the steps from a pixel to its color; return the exit status."""
    parser = command_parser(
        prog,
        "Explain a pixel of a Blender file: raster, view coordinates, the model's formula, ray, shapes, hit, color.",
        f"{prog} blend_scenes/spheres_and_planes.blend --pixel 960,540",
        "prints every step of that pixel with its numbers.",
        "exit status: 0 done; 2 bad input.",
    )
    add_frame(parser)
    parser.add_argument(
        "--pixel",
        type=pixel,
        required=True,
        metavar="X,Y",
        help="column and row of the pixel, counted from the bottom left",
    )
    options = parser.parse_args(arguments)
    scene = open_scene(options)
    go_to(scene, options.frame)
    job = read_as_rendered(scene)
    camera, shapes, (column, row) = job.camera, job.shapes, options.pixel
    if scene.render.use_multiview:
        warn(prog, "the scene has several views with pictures of their own: the steps are those of the camera itself")
    if job.several:
        print(f"View layer {job.layer!r}\n")
    if camera.pixel_time is not None:
        frame = float(np.asarray(camera.pixel_time.frame_at(column + 0.5, row + 0.5)))
        camera, shapes = moment(camera, shapes, frame)
        print(f"At frame {frame:g}, the time of this pixel\n")
    steps = lesson(
        camera, shapes, column, row, shading=job.shading, samples=job.samples,
        progress=lambda _: not signals.is_stopping(),
    )  # fmt: skip
    print(steps, flush=True)
    return 0


def pixel(text: str) -> tuple[int, int]:
    """Return the column and the row of "X,Y"."""
    column, _, row = text.partition(",")
    if not (column.strip().isdecimal() and row.strip().isdecimal()):
        raise ArgumentTypeError(f"{text!r} is not a pixel: give column and row from the bottom left, such as 120,80")
    return int(column), int(row)
