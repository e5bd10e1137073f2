"""What a user does with the zip, in a fresh profile: install, render, disable and enable again. Run by a Blender.

Arguments: the zip, the picture to write, the JSON file that receives what was seen.
"""

import json
import sys
from pathlib import Path

import bpy

MODULE = "bl_ext.user_default.camera_ray_caster"
ENGINE = "CAMERA_RAY_CASTER"


def traces():
    """Every place in Blender where an add-on can leave something: a plain mapping, equal when nothing changed."""
    types = {name: getattr(bpy.types, name) for name in dir(bpy.types)}
    handlers = {name: value for name, value in vars_of(bpy.app.handlers) if isinstance(value, list)}
    return {
        "types": sorted(types),
        "properties": {name: rna.properties.keys() for name, kind in types.items() if (rna := rna_of(kind))},
        "drawn by": {name: len(added) for name, kind in types.items() if (added := drawn_by(kind))},
        "panels of the engine": [name for name, kind in types.items() if ENGINE in getattr(kind, "COMPAT_ENGINES", ())],
        "handlers": {name: [function.__module__ for function in value] for name, value in handlers.items()},
    }


def vars_of(owner):
    """The public attributes of an object, by name."""
    return [(name, getattr(owner, name)) for name in dir(owner) if not name.startswith("_")]


def rna_of(kind):
    """The description of a Blender type, None for what is a plain Python base."""
    return getattr(kind, "bl_rna", None)


def drawn_by(kind):
    """The draw functions that were appended to a panel or menu."""
    return getattr(getattr(kind, "draw", None), "_draw_funcs", [])


def render(picture):
    """Render a sphere in the middle of the camera's view to a PNG with the engine."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1.0, location=(0.0, 0.0, 0.0))
    bpy.ops.object.camera_add(location=(0.0, 0.0, 5.0), rotation=(0.0, 0.0, 0.0))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.engine = ENGINE
    scene.render.resolution_x, scene.render.resolution_y = 64, 48
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)


def main(archive, picture, report):
    """Walk once from a Blender that never saw the extension to one that has forgotten it."""
    before = traces()
    bpy.ops.extensions.package_install_files(filepath=archive, repo="user_default", enable_on_install=True)
    enabled = traces()
    render(picture)
    for _ in range(10):
        bpy.ops.preferences.addon_disable(module=MODULE)
        bpy.ops.preferences.addon_enable(module=MODULE)
    again = traces()
    bpy.ops.preferences.addon_disable(module=MODULE)
    seen = {
        "before": before,
        "enabled": enabled,
        "enabled again": again,
        "disabled": traces(),
        "modules": [name for name in sys.modules if "camera_ray_caster" in name],
    }
    Path(report).write_text(json.dumps(seen))


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
