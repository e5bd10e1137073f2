"""Make the example scenes from code: every .blend in blend_scenes/ and the README that lists them.

    python scripts/make_scenes.py            all of them
    python scripts/make_scenes.py NAME ...   only these, for example spheres_and_planes

Needs pip's bpy. Run it with bpy 4.5, the oldest that is supported: newer ones open what it writes.
"""

from __future__ import annotations

if __name__ == "__main__":
    import ends  # it lies beside this file

    ends.begin(__file__)

import os
import signal
import sys
import tempfile
from argparse import RawDescriptionHelpFormatter
from pathlib import Path

import bpy
from arguments import Parser
from ends import listen
from scenes import BY_CYCLES, EXAMPLES, GALLERY, SCENES

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "blend_scenes"
sys.path.insert(0, str(ROOT / "addon"))

import camera_ray_caster  # noqa: E402  (found by the line above)

README = """\
# Example scenes

To look at one: `python scripts/cast.py blend_scenes/NAME.blend --output out`

## Gallery

What each camera does, in the program's own pictures: places full of meshes in the colors of their materials, then, with
the grid shading, mostly one room, six meters high with cells of half a meter, so that cameras can be compared. Where a
camera has no ray, a picture is transparent.
{gallery}
### By Cycles, through the same cameras

Ours on the left, one ray to the nearest surface; on the right Cycles' picture of the same rays, with shadows and
reflected light: `python scripts/cast.py blend_scenes/NAME.blend --engine CYCLES --samples 12`

| | |
|---|---|
{by_cycles}

## Small scenes, each hard for a ray caster in one way

<img src="pictures/spheres_and_planes.png" width="480" alt="spheres, ellipsoids, a ring of points and walls">

{examples}

All of them are made by `python scripts/make_scenes.py`, and this page with them; the pictures by
`python scripts/make_pictures.py`.
"""

GROUP = """
### {title}

| | |
|---|---|
{rows}
"""

ROW = '| <img src="pictures/{name}.png" width="360" alt="{name}"> | `{name}.blend`: {line} |'


BOTH = (
    '| <img src="pictures/{name}.png" width="360" alt="{name}"> '
    '| <img src="pictures/{name}_by_cycles.png" width="360" alt="{name} by Cycles"> |'
)


def readme() -> str:
    """Return the page that lists the scenes, each by its docstring."""
    examples = "\n".join(f"* `{name}.blend`: {make.__doc__}" for name, make in EXAMPLES.items())
    gallery = "".join(
        GROUP.format(
            title=title, rows="\n".join(ROW.format(name=name, line=make.__doc__) for name, make in group.items())
        )
        for title, group in GALLERY.items()
    )
    by_cycles = "\n".join(BOTH.format(name=name) for name in BY_CYCLES)
    return README.format(gallery=gallery, by_cycles=by_cycles, examples=examples)


def write_scene(name: str) -> None:
    """Write blend_scenes/NAME.blend: whole or not at all."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # one workspace is enough, and Blender's file browsers would store the home folder
    bpy.data.batch_remove([other for other in bpy.data.workspaces if other != bpy.context.window.workspace])
    for area in bpy.context.window.screen.areas:
        if area.type == "VIEW_3D":
            area.spaces.active.region_3d.view_perspective = "CAMERA"
    scene = bpy.context.scene
    scene.name = name
    scene.render.filepath = f"//../out/{name}_"
    SCENES[name](scene)
    with tempfile.TemporaryDirectory(dir=FOLDER) as folder:
        new = os.path.join(folder, "new.blend")
        bpy.ops.wm.save_as_mainfile(filepath=new, compress=True, relative_remap=False)
        os.replace(new, FOLDER / f"{name}.blend")


def main(arguments: list[str] | None = None) -> None:
    """Make the scenes that are named, or all."""
    parser = Parser(prog="make_scenes.py", description=__doc__, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("names", metavar="NAME", nargs="*", help=", ".join(SCENES))
    names = parser.parse_args(arguments).names or list(SCENES)
    if unknown := [name for name in names if name not in SCENES]:
        parser.error(f"no scene is called {', '.join(unknown)}: choose from {', '.join(SCENES)}")
    (FOLDER / "README.md").write_text(readme(), encoding="utf-8")

    listen(signal.default_int_handler)  # there will be folders to clear up
    camera_ray_caster.register()
    for name in names:
        write_scene(name)
    camera_ray_caster.unregister()


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
