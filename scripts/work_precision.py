"""Error against run time: every method on each scene, held against the exact picture of 60 digits.

    python scripts/work_precision.py                        the chosen extreme cases, and the diagram
    python scripts/work_precision.py FILE.blend planet      a file's camera and shapes; the cases with this in the name

Needs the packages of the ``test`` extra. Writes work_precision.json, .svg and .png into --output; prints the tables.
"""

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT), str(ROOT / "scripts")]


def main() -> int:
    """Run, print and write; return the exit status."""
    from precision import arithmetic, diagram, effort
    from tests.core.extreme_cases import CASES

    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="a .blend, or a part of the names of extreme cases")
    parser.add_argument("--output", type=Path, default=Path("out"), metavar="FOLDER")
    options = parser.parse_args()
    points = []
    for scene in options.scenes:
        if scene.endswith(".blend"):
            points += arithmetic.measured(Path(scene).stem, *_read(scene))
            continue
        cases = [case for case in CASES if scene in case.name]
        if not cases:
            print(f"work_precision.py: no case has {scene!r} in its name: see the table of cases", file=sys.stderr)
            return 2
        points += [point for case in cases for point in arithmetic.measure(case)]
    if not options.scenes:
        points = [point for case in arithmetic.DEFAULT for point in arithmetic.measure(case)]
    points += effort.points()
    options.output.mkdir(parents=True, exist_ok=True)
    stem = options.output / "work_precision"
    record = json.dumps([asdict(point) for point in points], indent=1, default=float)
    stem.with_suffix(".json").write_text(record + "\n")
    diagram.draw(points, stem)
    print(diagram.table(points), diagram.rest(points), sep="\n\n")
    return 0


def _read(path):
    """Return the camera of a file, as Blender has it, and its shapes."""
    import bpy

    import camera_ray_caster
    from camera_ray_caster.blender.read import camera_record, evaluated, shapes_record

    camera_ray_caster.register()
    bpy.ops.wm.open_mainfile(filepath=path)
    with evaluated(bpy.context.scene) as depsgraph:
        scene = bpy.context.scene
        return camera_record(scene, scene.camera, depsgraph), shapes_record(depsgraph)


if __name__ == "__main__":
    sys.exit(main())
