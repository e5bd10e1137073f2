"""What a user does with the zip, in a fresh profile: install, render, disable and enable again. Run by a Blender.

Arguments: the zip, the picture to write, the JSON file that receives what was seen.
"""

import inspect
import json
import sys
from collections import Counter
from contextlib import ExitStack
from pathlib import Path
from unittest.mock import patch

import bpy

MODULE = "bl_ext.user_default.camera_ray_caster"
ENGINE = "CAMERA_RAY_CASTER"


NAMES = set()
"""Of the C functions that this process has asked ctypes for."""

LEDGER = Counter()
"""What the extension has added less what it has taken back, of what Blender does not list."""


def watched(owner, name, count, key):
    """Have every call that the extension makes of a function counted under a key, as long as the patch holds."""
    function = getattr(owner, name)

    def counted(*arguments, **keywords):
        LEDGER[key] += count if any(MODULE in name for name in callers(sys._getframe(1))) else 0
        return function(*arguments, **keywords)

    return patch.object(owner, name, staticmethod(counted) if inspect.isclass(owner) else counted)


def callers(frame):
    """The names of the modules of a frame and of those that called it."""
    while frame is not None:
        yield frame.f_globals["__name__"]
        frame = frame.f_back


def what_is_not_listed():
    """Yield the patches that count draw callbacks, commands, timers and subscriptions."""
    for name in dir(bpy.types):
        getattr(bpy.types, name)  # a class that nobody has asked for is not among the subclasses
    for kind in bpy.types.Space.__subclasses__():
        yield watched(kind, "draw_handler_add", 1, "draw callbacks")
        yield watched(kind, "draw_handler_remove", -1, "draw callbacks")
    yield watched(bpy.utils, "register_cli_command", 1, "commands")
    yield watched(bpy.utils, "unregister_cli_command", -1, "commands")
    yield watched(bpy.app.timers, "register", 1, "timers")
    yield watched(bpy.app.timers, "unregister", -1, "timers")
    yield watched(bpy.msgbus, "subscribe_rna", 1, "subscriptions")
    yield watched(bpy.msgbus, "clear_by_owner", -1, "subscriptions")


def keys():
    """The keys that add-ons have bound, by keymap."""
    keymaps = bpy.context.window_manager.keyconfigs.addon.keymaps
    return {keymap.name: len(keymap.keymap_items) for keymap in keymaps if len(keymap.keymap_items)}


def traces():
    """Every place in Blender where an add-on can leave something: a plain mapping, equal when nothing changed."""
    kinds = {name: getattr(bpy.types, name) for name in dir(bpy.types)}
    handlers = inspect.getmembers(bpy.app.handlers, lambda member: isinstance(member, list))
    return {
        # engines and preferences are not in bpy.types: Python knows every subclass
        "classes": sorted(f"{kind.__module__}.{kind.__name__}" for kind in subclasses(bpy.types.bpy_struct)),
        "properties": {name: kind.bl_rna.properties.keys() for name, kind in kinds.items() if hasattr(kind, "bl_rna")},
        "drawn by others": {
            name: len(added) for name, kind in kinds.items() if len(added := appended(kind)) > 1
        },  # the first is Blender's own
        "panels of the engine": [name for name, kind in kinds.items() if ENGINE in getattr(kind, "COMPAT_ENGINES", ())],
        "counted": {key: count for key, count in LEDGER.items() if count},
        "keys": keys(),
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
        "C functions": sorted(NAMES),
        "modules": [name for name in sys.modules if "camera_ray_caster" in name],
    }
    Path(report).write_text(json.dumps(seen))


if __name__ == "__main__":
    sys.addaudithook(lambda event, arguments: NAMES.add(str(arguments[1])) if event == "ctypes.dlsym" else None)
    with ExitStack() as stack:
        for context in what_is_not_listed():
            stack.enter_context(context)
        main(*sys.argv[sys.argv.index("--") + 1 :])
