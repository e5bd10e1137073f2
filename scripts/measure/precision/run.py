"""Error against run time of the methods and scenes that the command line chooses: files and tables."""

import json
from dataclasses import asdict
from pathlib import Path

from arguments import Parser

from camera_ray_caster.blender.process.standard_output import keep_output
from camera_ray_caster.core.records import InputError

from . import arithmetic, diagram, effort, words


def main(description: str) -> int:
    """Measure, write the files and print the tables; return the exit status."""
    parser = Parser(prog="work_precision.py", description=description)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help=".blend file, or part of the name of extreme cases")
    parser.add_argument(
        "--only", choices=["arithmetic", *effort.FAMILIES], help="family of methods; default: all families"
    )
    parser.add_argument("--output", type=Path, default=Path("out"), metavar="FOLDER", help="default: %(default)s")
    options = parser.parse_args()
    files = [name for name in options.scenes if name.endswith(".blend")]
    named = [name for name in options.scenes if name not in files]
    cases = words.cases_named(parser, named) if named else [] if files else arithmetic.DEFAULT
    if files:
        keep_output()
    try:
        scenes = [(Path(path).stem, *_read(path)) for path in files]
        options.output.mkdir(parents=True, exist_ok=True)
    except InputError as refusal:
        parser.error(str(refusal))
    except OSError as error:
        parser.error(f"cannot write into {str(options.output)!r}: {error.strerror}; choose another folder")
    points = []
    if options.only in (None, "arithmetic"):
        points += [point for name, raw, shapes in scenes for point in arithmetic.measured(name, raw, shapes)]
        points += [point for case in cases for point in arithmetic.measure(case)]
    for family, measure in effort.FAMILIES.items():
        if options.only in (None, family):
            points += measure()
    stem = options.output / "work_precision"
    record = json.dumps([asdict(point) for point in points], indent=1, default=float)
    stem.with_suffix(".json").write_text(record + "\n")
    diagram.draw(points, stem)
    print("\n\n".join(filter(None, (diagram.table(points), diagram.other_families(points)))))
    return 0


def _read(path):
    """Return the camera record of a file, reduced to a small picture, and its shapes."""
    try:
        import bpy
    except ModuleNotFoundError as missing:
        raise InputError(f"{path!r} needs pip's bpy, which is not installed") from missing

    import camera_ray_caster
    from camera_ray_caster.blender.process.opening import open_file
    from camera_ray_caster.blender.read.camera_fields import camera_record
    from camera_ray_caster.blender.read.depsgraph_shapes import shapes_record
    from camera_ray_caster.blender.read.scene_reader import evaluated

    camera_ray_caster.register()
    try:
        open_file(Path(path))
        with evaluated(bpy.context.scene) as depsgraph:
            scene = bpy.context.scene
            return arithmetic.small(camera_record(scene.camera, depsgraph)), shapes_record(depsgraph)
    finally:
        camera_ray_caster.unregister()
