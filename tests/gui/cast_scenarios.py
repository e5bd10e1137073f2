"""What a user does while a cast is running, one scenario a function: see scenarios.py."""

import time

import bpy
import numpy as np
from parts import BUTTON, addon, load

PAUSE = 10.0
"""Seconds after which the window stands still: casts here take minutes, and others may take the cores meanwhile."""


def begin(user, scenes, size, name="depth"):
    """Load the example and press Cast for one of its passes, in a picture of size x size pixels."""
    yield from load(user, scenes, "spheres_and_planes")
    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = size
    addon("properties.pass_properties").tick(scene, bpy.context.view_layer, [name])
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(lambda: (addon("ui.cast_operator").fraction() or 0) > 0, "it has begun")


def stop(user, scenes):
    """A cast of 16384 x 16384 error bounds leaves the window alive, shows how far it is, and Esc stops it."""
    yield from begin(user, scenes, 16384, "distance_bound")
    times = [time.monotonic()]
    while times[-1] - times[0] < 2:
        yield
        times.append(time.monotonic())
    user.screenshot("casting")
    assert np.diff(times).max() < PAUSE, np.diff(times)
    assert 0 < addon("ui.cast_operator").fraction() < 1
    yield from user.key("Escape")
    yield from user.until(lambda: addon("ui.cast_operator").fraction() is None, "it has stopped")
    assert addon("output.reports").latest() is None
    assert "Ray Caster distance_bound" not in bpy.data.images


def stop_samples(user, scenes):
    """Esc stops a picture of 256 x 256 pixels with 4,096 samples, which is one tile, as soon as any."""
    yield from load(user, scenes, "spheres_and_planes")
    scene, cast = bpy.context.scene, addon("ui.cast_operator")
    scene.render.resolution_x = scene.render.resolution_y = 256
    scene.camera_ray_caster.samples = 4096
    addon("properties.pass_properties").tick(scene, bpy.context.view_layer, ["combined"])
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(lambda: (cast.fraction() or 0) > 0, "it has begun")
    worker = cast._running[0].worker
    stop, waited = worker.stop, []

    def timed():
        started = time.perf_counter()
        stop()
        waited.append(time.perf_counter() - started)

    worker.stop = timed
    yield from user.key("Escape")
    yield from user.until(lambda: cast.fraction() is None, "it has stopped")
    print(f"stopped after {waited[0]:.2f} s")
    assert waited[0] < PAUSE, waited
    assert addon("output.reports").latest() is None


def load_while_casting(user, scenes):
    """Another file ends the cast of this one, and nothing of it stays."""
    yield from begin(user, scenes, 8192)
    bpy.ops.wm.open_mainfile(filepath=str(scenes / "orthographic.blend"), load_ui=False)
    yield from user.wait(1)
    assert addon("ui.cast_operator").fraction() is None
    assert addon("output.reports").latest() is None
    assert "Ray Caster depth" not in bpy.data.images


def show_result(user, scenes):
    """Without an Image Editor a cast says where its images are, and Show Result opens one, in colors."""
    yield from load(user, scenes, "spheres_and_planes")
    view = user.area()
    bpy.context.scene.render.resolution_percentage = 25
    addon("properties.pass_properties").tick(bpy.context.scene, bpy.context.view_layer, ["combined", "depth"])
    yield from user.press(f"{BUTTON}cast(")
    yield from user.until(addon("output.reports").latest, "the cast has ended")
    yield from user.wait(0.5)
    user.screenshot("cast_without_editor")
    with bpy.context.temp_override(window=user.window, area=view, region=user.region("WINDOW")):
        bpy.ops.camera_ray_caster.show_result(name="Ray Caster depth")
    yield from user.wait(1)
    user.screenshot("show_result")
    editor = next(area for area in user.window.screen.areas if area.type == "IMAGE_EDITOR")
    assert editor.spaces.active.image.name == addon("output.image_datablocks").VIEW
    yield from user.point(editor.x + editor.width // 2, editor.y + editor.height // 2)
    yield from user.key("Escape")
    yield from user.until(lambda: any(area.type == "VIEW_3D" for area in user.window.screen.areas), "the view is back")


CAST_SCENARIOS = (stop, stop_samples, load_while_casting, show_result)
