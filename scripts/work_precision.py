"""Measure error against run time: every method on each scene, compared with the exact picture of 60 digits.

    python scripts/work_precision.py                        the chosen extreme cases, and the diagram
    python scripts/work_precision.py FILE.blend planet      a file's camera and shapes, and the cases named "planet"
    python scripts/work_precision.py --only samples         one family of methods, on its own scenes

Needs the packages of the ``test`` extra. Writes work_precision.json, .svg and .png into --output, and prints tables.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import json
import sys
from dataclasses import asdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT), str(ROOT / "scripts")]


def main() -> int:
    """Measure, write the files and print the tables; return the exit status."""
    try:
        from arguments import Parser
        from measure.precision import arithmetic, diagram, effort, words
    except ModuleNotFoundError as missing:
        print(f"work_precision.py: {missing}: install the packages of the test extra", file=sys.stderr)
        return 2
    from camera_ray_caster.blender.process.standard_output import keep_output
    from camera_ray_caster.core.records import InputError

    parser = Parser(prog="work_precision.py", description=__doc__.splitlines()[0])
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
    print("\n\n".join(filter(None, (diagram.table(points), diagram.rest(points)))))
    return 0


def _read(path):
    """Return the camera record of a file, reduced to a small picture, and its shapes."""
    from camera_ray_caster.core.records import InputError

    try:
        import bpy
    except ModuleNotFoundError as missing:
        raise InputError(f"{path!r} needs pip's bpy, which is not installed") from missing
    from measure.precision.arithmetic import small

    import camera_ray_caster
    from camera_ray_caster.blender.process.opening import open_file
    from camera_ray_caster.blender.read.camera import camera_record
    from camera_ray_caster.blender.read.scene import evaluated
    from camera_ray_caster.blender.read.shapes import shapes_record

    camera_ray_caster.register()
    try:
        open_file(Path(path))
        with evaluated(bpy.context.scene) as depsgraph:
            scene = bpy.context.scene
            return small(camera_record(scene.camera, depsgraph)), shapes_record(depsgraph)
    finally:
        camera_ray_caster.unregister()


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
