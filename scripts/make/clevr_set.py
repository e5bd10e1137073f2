"""A data set in the style of CLEVR: pictures by Cycles and their ground truth, by the terminal commands."""

from __future__ import annotations

from argparse import ArgumentDefaultsHelpFormatter
from pathlib import Path
from shutil import copy
from tempfile import TemporaryDirectory

from arguments import Parser, count, size

ENGINES = "CYCLES", "CAMERA_RAY_CASTER"
PASSES = (
    "combined", "depth", "distance", "normal", "object_index", "material_index", "shape_index", "ray_origin",
    "ray_direction", "flow_forward", "flow_hidden",
)  # fmt: skip


def main(description: str) -> int:
    """Make the scene, cast its views and export its cameras; return the exit status."""
    parser = Parser(prog="clevr_set.py", description=description,
                    formatter_class=ArgumentDefaultsHelpFormatter)  # fmt: skip
    parser.add_argument("--views", type=count, default=6, metavar="N", help="number of views around the objects")
    parser.add_argument(
        "--objects",
        type=count,
        default=10,
        metavar="N",
        help="maximum number of objects; fewer if there is no free place",
    )
    parser.add_argument("--resolution", type=size, default=(320, 320), metavar="WxH", help="resolution of each view")
    parser.add_argument("--seed", type=count, default=1, metavar="N", help="seed of the random arrangement")
    parser.add_argument(
        "--engine", type=str.upper, choices=ENGINES, default=ENGINES[0], help="engine that renders the pictures"
    )
    parser.add_argument("--samples", type=count, default=32, metavar="N", help="samples per pixel of Cycles")
    parser.add_argument("--output", type=Path, default=Path("clevr"), metavar="FOLDER", help="folder for the files")
    asked = parser.parse_args()

    from camera_ray_caster.blender.process.standard_output import keep_output

    keep_output()
    import bpy

    import camera_ray_caster
    from camera_ray_caster.blender.terminal import commands
    from make.scenes.clevr import clevr

    camera_ray_caster.register()
    try:
        with TemporaryDirectory() as folder:
            file = Path(folder) / "clevr.blend"
            bpy.ops.wm.read_factory_settings(use_empty=True)
            clevr(bpy.context.scene, asked.views, asked.objects, asked.resolution, asked.seed)
            bpy.ops.wm.save_as_mainfile(filepath=str(file), compress=True)
            words = [str(file), "--frames", f"1:{asked.views}", "--output", str(asked.output)]
            samples = ["--samples", str(asked.samples)] if asked.engine == ENGINES[0] else []
            made = [
                "--passes",
                ",".join(PASSES),
                "--format",
                "NPZ",
                "--annotations",
                "--engine",
                asked.engine,
                *samples,
            ]
            status = commands.main("cast", [*words, *made], parser.prog)
            status = status or commands.main("export", [*words, "--format", "json"], parser.prog)
            if not status:
                copy(file, asked.output)
            return status
    finally:
        camera_ray_caster.unregister()
