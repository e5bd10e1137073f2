"""What a user does with the zip, in a fresh profile: install, render, disable and enable again. Run by a Blender.

Arguments: the zip, the picture to write, the JSON file that receives what was seen.
"""

import inspect
import json
import sys
from pathlib import Path

import bpy

MODULE = "bl_ext.user_default.camera_ray_caster"
ENGINE = "CAMERA_RAY_CASTER"


def traces():
    """Every place in Blender where an add-on can leave something: a plain mapping, equal when nothing changed."""
    kinds = {name: getattr(bpy.types, name) for name in dir(bpy.types)}
    handlers = inspect.getmembers(bpy.app.handlers, lambda member: isinstance(member, list))
    return {
        # engines and preferences are not in bpy.types: Python knows every subclass
        "classes": sorted(f"{kind.__module__}.{kind.__name__}" for kind in subclasses(bpy.types.bpy_struct)),
        "properties": {name: kind.bl_rna.properties.keys() for name, kind in kinds.items() if hasattr(kind, "bl_rna")},
        "drawn by others": {name: len(added) for name, kind in kinds.items() if (added := appended(kind))},
        "panels of the engine": [name for name, kind in kinds.items() if ENGINE in getattr(kind, "COMPAT_ENGINES", ())],
        "handlers": {name: [function.__qualname__ for function in added] for name, added in handlers},
    }


def subclasses(kind):
    """The registered classes below a Blender type."""
    for below in kind.__subclasses__():
        if getattr(below, "is_registered", False):
            yield below
        yield from subclasses(below)


def appended(kind):
    """The functions that draw in a panel or menu of Blender's; its own is the first."""
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
