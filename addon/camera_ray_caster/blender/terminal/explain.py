"""The command that explains a pixel step by step."""

from argparse import ArgumentTypeError
from collections.abc import Sequence

import numpy as np

from ...core.report.lesson import lesson
from ..read.scene import read_camera, read_shapes
from . import signals
from .options import add_frame, command_parser, go_to, open_scene


def run(arguments: Sequence[str], prog: str) -> int:
    """Print the steps from a pixel to its color; return the exit status."""
    parser = command_parser(
        prog,
        "Explain a pixel of a Blender file: raster, view coordinates, the model's formula, ray, shapes, hit.",
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
    column, row = options.pixel
    camera = read_camera(scene)
    frame = scene.frame_current_final
    if camera.pixel_time is not None:
        frame = float(np.asarray(camera.pixel_time.frame_at(column + 0.5, row + 0.5)))
        camera = camera.at(frame)
        print(f"At frame {frame:g}, the time of this pixel\n")
    signals.raise_if_stopping()
    settings = scene.camera_ray_caster
    look = {name: getattr(settings, name) for name in ("shading", "samples", "precision")}
    steps = lesson(camera, read_shapes(scene, frame), column, row, **look, progress=lambda _: not signals.is_stopping())
    print("\n".join(steps.lines()), flush=True)
    return 0


def pixel(text: str) -> tuple[int, int]:
    """Return the column and the row of "X,Y"."""
    column, _, row = text.partition(",")
    if not (column.strip().isdecimal() and row.strip().isdecimal()):
        raise ArgumentTypeError(f"{text!r} is not a pixel: give column and row from the bottom left, such as 120,80")
    return int(column), int(row)
