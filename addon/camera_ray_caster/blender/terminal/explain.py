"""The command that explains a pixel step by step."""

import json
from argparse import ArgumentTypeError
from collections.abc import Sequence

import numpy as np

from ...core.lesson.lesson import lesson, pixel_at
from ..engine.render_evaluation import read_as_rendered
from ..process import signals
from .options import add_frame, add_json, command_parser, go_to, open_scene, warn


def run(arguments: Sequence[str], prog: str) -> int:
    """Print the steps from a pixel to its color; return the exit status."""
    parser = command_parser(
        prog,
        "Explain how a pixel of a Blender file gets its color: view coordinates, formula, ray, shapes, hit, light.",
        f"{prog} blend_scenes/spheres_and_planes.blend --pixel 960,540",
        "prints every step of that pixel with its numbers.",
        "exit status: 0 done; 2 bad input.",
    )
    add_frame(parser)
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument(
        "--pixel", type=pixel, metavar="X,Y", help="column and row of the pixel, counted from the bottom left"
    )
    where.add_argument(
        "--point", type=point, metavar="X,Y", help="view coordinates of a point in the pixel, from -1,-1 (bottom left) "
        "to 1,1 (top right); write --point=-0.5,0 if the first one is negative"
    )  # fmt: skip
    add_json(parser)
    options = parser.parse_args(arguments)
    scene = open_scene(options)
    go_to(scene, options.frame)
    job = read_as_rendered(scene)
    camera, shapes = job.camera, job.shapes
    column, row = options.pixel or pixel_at(camera, *options.point)
    about: dict[str, object] = {}
    if scene.render.use_multiview:
        warn(prog, "the scene has several views with pictures of their own: the steps are those of the camera itself")
    if job.several:
        about["layer"] = job.layer
    if camera.pixel_time is not None:
        frame = float(np.asarray(camera.pixel_time.frame_at(column + 0.5, row + 0.5)))
        camera, shapes = camera.at(frame), shapes.at(frame)
        about["frame"] = frame
    steps = lesson(
        camera, shapes, column, row, shading=job.shading, samples=job.samples,
        progress=lambda _: not signals.is_stopping(),
    )  # fmt: skip
    if options.json:
        print(json.dumps(about | steps.as_data(), indent=2, allow_nan=False), flush=True)
        return 0
    if "layer" in about:
        print(f"View layer {about['layer']!r}\n")
    if "frame" in about:
        print(f"At frame {about['frame']:g}, the time of this pixel\n")
    print(steps, flush=True)
    return 0


def pixel(text: str) -> tuple[int, int]:
    """Return the column and the row of "X,Y"."""
    column, _, row = text.partition(",")
    if not (column.strip().isdecimal() and row.strip().isdecimal()):
        raise ArgumentTypeError(f"{text!r} is not a pixel: give column and row from the bottom left, such as 120,80")
    return int(column), int(row)


def point(text: str) -> tuple[float, float]:
    """Return the two numbers of "X,Y"."""
    try:
        x, y = map(float, text.split(","))
    except ValueError:
        raise ArgumentTypeError(f"{text!r} is not a point: give two numbers from -1 to 1, such as 0.5,-0.25") from None
    return x, y
