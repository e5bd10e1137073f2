"""What the scenarios share: the add-on's modules, an example scene in the window, panels whose drawing is timed."""

import sys
import time

import bpy

MODULE = "bl_ext.user_default.camera_ray_caster"
BUTTON = "bpy.ops.camera_ray_caster."


def addon(name):
    """A module of the installed add-on's ``blender`` package, by its dotted name."""
    return sys.modules[f"{MODULE}.blender.{name}"]


def load(user, scenes, name):
    """Open an example scene in the window as it is, with the sidebar on our tab and at its top."""
    bpy.ops.wm.open_mainfile(filepath=str(scenes / f"{name}.blend"), load_ui=False)
    view = user.area().spaces.active
    view.shading.type, view.overlay.show_overlays = "SOLID", True
    view.region_3d.view_perspective = "PERSP"
    yield from user.wait(0.5)
    yield from user.open_tab("Ray Caster")
    yield from user.scroll(60, down=False)


def cast_through(user):
    """Have See Through show the picture of a cast: the view is Rendered by the add-on's engine."""
    bpy.context.scene.render.engine, user.area().spaces.active.shading.type = "CAMERA_RAY_CASTER", "RENDERED"


def timed(panel, seconds):
    """Have the drawing of a panel timed, in seconds of the processor. Return a function that ends it."""
    draw = panel.draw

    def measured(self, context):
        started = time.thread_time()
        draw(self, context)
        seconds.append(time.thread_time() - started)

    panel.draw = measured
    return lambda: setattr(panel, "draw", draw)
