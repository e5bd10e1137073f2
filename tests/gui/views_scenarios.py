"""What a user sees in several views and windows, and in files that Blender saves by itself: see scenarios.py."""

import bpy
from parts import BUTTON, addon, load


def overlays(space):
    """What of Blender's own is shown in a 3D View."""
    return {name: getattr(space.overlay, name) for name in addon("ui.hide_overlays").MISLEADING}


def autosaved(user, scenes):
    """A file that Blender saved by itself while See Through hid outlines and grid shows them when it is opened."""
    yield from load(user, scenes, "living_room_omnimax")
    paths = bpy.context.preferences.filepaths
    before = overlays(user.area().spaces.active)
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.until(lambda: not any(overlays(user.area().spaces.active).values()), "they are hidden")
    bpy.context.scene.camera.location.x += 0.01
    bpy.ops.ed.undo_push(message="moved")
    paths.temporary_directory, paths.use_auto_save_temporary_files = str(user.folder), True
    paths.auto_save_time = 1
    yield from user.until(lambda: list(user.folder.glob("*autosave.blend")), "Blender has saved by itself", 100)
    paths.use_auto_save_temporary_files = False
    assert not any(overlays(user.area().spaces.active).values()), "it told nobody"
    (path,) = user.folder.glob("*autosave.blend")
    bpy.ops.wm.open_mainfile(filepath=str(path))
    assert overlays(user.area().spaces.active) == before
    yield from user.until(lambda: not any(overlays(user.area().spaces.active).values()), "they are hidden again")
    bpy.ops.wm.open_mainfile(filepath=str(scenes / "toys.blend"), load_ui=False)
    assert overlays(user.area().spaces.active) == before
    assert addon("ui.hide_overlays").MARK not in user.window.screen


VIEWS_SCENARIOS = (autosaved,)
