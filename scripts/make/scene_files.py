"""The files of the example scenes, and the page that lists them."""

from __future__ import annotations

import os
import signal
import tempfile
from argparse import RawDescriptionHelpFormatter
from pathlib import Path

import bpy
from arguments import Parser
from ends import listen

import camera_ray_caster

from .scenes import BY_CYCLES, EXAMPLES, GALLERY, SCENES

FOLDER = Path(__file__).resolve().parents[2] / "blend_scenes"

README = """\
# Example scenes

This command casts the picture of a scene: `python scripts/cast.py blend_scenes/NAME.blend --output out`

## Gallery

These pictures are made by the add-on and show what each camera does. The scenes in the first group are places full of
meshes, in the colors of their materials. The other groups use the grid shading and mostly show the same room, so that
cameras can be compared. The room is six meters high, and its grid cells are half a meter wide. A picture is transparent
where the camera has no ray.
{gallery}
### By Cycles, through the same cameras

The add-on's picture on the left shows the nearest surface that each ray hits. The picture on the right is rendered by
Cycles along the same rays, with shadows and reflected light, by this command:
`python scripts/cast.py blend_scenes/NAME.blend --engine CYCLES --samples 12`. The grid room is closed, and its lamps
are outside: Cycles, which has shadows, needs a lamp in it.

| | |
|---|---|
{by_cycles}

## Small scenes

Each of these scenes is difficult for a ray caster in one way. The picture shows the first one.

<img src="pictures/spheres_and_planes.png" width="480" alt="spheres, ellipsoids, a ring of points and walls">

{examples}

All scenes and this page are made by `python scripts/make_scenes.py`, and the pictures by
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


def caption(make) -> str:
    """Return the docstring of a scene's function as one line."""
    return " ".join(make.__doc__.split())


def readme() -> str:
    """Return the page that lists the scenes, with the docstrings of their functions as descriptions."""
    examples = "\n".join(f"* `{name}.blend`: {caption(make)}" for name, make in EXAMPLES.items())
    gallery = "".join(
        GROUP.format(
            title=title, rows="\n".join(ROW.format(name=name, line=caption(make)) for name, make in group.items())
        )
        for title, group in GALLERY.items()
    )
    by_cycles = "\n".join(BOTH.format(name=name) for name in BY_CYCLES)
    return README.format(gallery=gallery, by_cycles=by_cycles, examples=examples)


def write_scene(name: str) -> None:
    """Write blend_scenes/NAME.blend, completely or not at all."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    # keep one workspace: the file browsers in the others would store the home folder
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


def main(description: str) -> None:
    """Make the named scenes, or all, and the README."""
    parser = Parser(prog="make_scenes.py", description=description, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("names", metavar="NAME", nargs="*", help=", ".join(SCENES))
    names = parser.parse_args().names or list(SCENES)
    if unknown := [name for name in names if name not in SCENES]:
        parser.error(f"no scene is called {', '.join(unknown)}: choose from {', '.join(SCENES)}")
    (FOLDER / "README.md").write_text(readme(), encoding="utf-8")

    listen(signal.default_int_handler)  # so that temporary folders are removed
    camera_ray_caster.register()
    for name in names:
        write_scene(name)
    camera_ray_caster.unregister()
