"""What a user does with all cameras of a scene, one scenario a function: see scenarios.py."""

import json

import _cycles
import bpy
import numpy as np
from parts import BUTTON, addon, load, timed
from window_scenarios import dialog, middle

STOP = 0.82
"""Where the button that stops a run is in the sidebar's width."""
LIST = 110
"""Pixels from the button Use in Cycles down to the title of the list of cameras."""


def cast_all(user, scenes):
    """The list of cameras casts them all at all frames into a folder by the terminal's command while the window works;
    a stop leaves whole frames.
    """
    yield from load(user, scenes, "toys")
    scene, run = bpy.context.scene, addon("ui.in_process")
    second = beside(scene)
    second.data.camera_ray_caster.model = "OMNIMAX"
    scene.frame_current = 7
    bpy.ops.ed.undo_push(message="A dome")
    before = kept(scene)
    yield from user.wait(0.7)
    user.screenshot("cameras_closed")
    yield from open_list(user)
    user.screenshot("cameras_open")
    yield from user.press(f"{BUTTON}cast_all(")
    folder = user.folder / "all"
    folder.mkdir(exist_ok=True)
    yield from into(user, folder)
    yield from user.until(run.running, "the pictures are being made")
    user.area().spaces.active.shading.type = "RENDERED"  # which the run does not disturb
    yield from user.until(lambda: run.running() is None, "the pictures are made")
    user.area().spaces.active.shading.type = "SOLID"
    assert run.latest().startswith("Wrote 4 pictures into"), run.latest()
    assert sorted(path.stem for path in folder.glob("*.png")) == [
        f"{name}_{frame:04}" for name in (scene.camera.name, "Dome") for frame in (1, 2)
    ]
    check_whole(folder)
    assert kept(scene) == before
    yield from user.wait(0.5)
    user.screenshot("cameras_cast")

    scene.render.resolution_percentage, scene.frame_end = 60, 50
    bpy.ops.ed.undo_push(message="Larger")
    yield from user.press(f"{BUTTON}cast_all(")
    folder = user.folder / "stopped"
    folder.mkdir(exist_ok=True)
    yield from into(user, folder)
    yield from user.until(lambda: run.running() and run.running().fraction, "a picture is made")
    yield from user.wait(0.5)
    user.screenshot("cameras_casting")
    yield from stop(user)
    yield from user.until(lambda: run.latest().startswith("Stopped: "), "it has ended")
    assert 0 < len(list(folder.glob("*.json"))) < 100
    check_whole(folder)
    scene.render.resolution_percentage, scene.frame_end = 20, 2
    assert kept(scene) == before


def cast_all_by_cycles(user, scenes):
    """The pictures of the list are Cycles' by choice, beside our depth; the scene's own engine stays."""
    yield from load(user, scenes, "toys")
    scene, run = bpy.context.scene, addon("ui.in_process")
    beside(scene)
    scene.cycles.samples = 4
    addon("properties.pass_properties").tick(scene, bpy.context.view_layer, ["combined", "depth"])
    before = kept(scene)
    yield from user.wait(0.7)
    yield from open_list(user)
    folder = user.folder / "by_cycles"
    folder.mkdir(exist_ok=True)
    yield from user.press(f"{BUTTON}cast_all(")
    yield from into(user, folder, engine="CYCLES", format="NPZ")
    if not _cycles.with_osl:  # as Debian builds it
        yield from user.until(lambda: "Open Shading Language" in run.latest(), "it says why")
        assert not list(folder.iterdir())
        assert kept(scene) == before
        user.screenshot("cameras_by_cycles")
        return
    yield from user.until(run.running, "the pictures are being made")
    yield from user.until(lambda: run.running() is None, "the pictures are made")
    assert run.latest().startswith("Wrote 4 pictures into"), run.latest()
    check_whole(folder)
    made = np.load(folder / f"{scene.camera.name}_0001.npz")
    assert made["depth"].shape == made["combined"].shape[:2]
    assert made["combined"][..., :3].std() > 0.05  # a picture is there
    assert kept(scene) == before
    yield from user.wait(0.5)
    user.screenshot("cameras_by_cycles")


def export_all(user, scenes):
    """The list of cameras exports them all at all frames, by the terminal's command; a stop leaves nothing."""
    yield from load(user, scenes, "toys")
    scene, run = bpy.context.scene, addon("ui.in_process")
    second = bpy.data.objects.new("Dome", bpy.data.cameras.new("Dome"))
    scene.collection.objects.link(second)
    scene.frame_start, scene.frame_end, scene.frame_current = 1, 200, 7
    bpy.ops.ed.undo_push(message="Two cameras")
    before = kept(scene)
    yield from user.wait(0.7)
    yield from open_list(user)
    folder = user.folder / "exported"
    folder.mkdir(exist_ok=True)
    yield from user.press(f"{BUTTON}export(")
    yield from into(user, folder)
    folder /= "toys_json"
    yield from user.until(lambda: run.latest() == f"Wrote {folder / 'camera.json'}", "it has exported")
    cameras = json.loads((folder / "camera.json").read_text())["cameras"]
    assert [len(camera["frames"]) for camera in cameras] == [200, 200]
    assert kept(scene) == before
    yield from user.wait(0.5)
    user.screenshot("export_all")

    scene.frame_end, stopped = 100000, user.folder / "export_stopped"
    bpy.ops.ed.undo_push(message="Longer")
    stopped.mkdir(exist_ok=True)
    yield from user.press(f"{BUTTON}export(")
    yield from into(user, stopped)
    yield from user.until(lambda: run.running() and run.running().fraction, "it is exporting")
    yield from user.wait(1)
    user.screenshot("exporting_all")
    yield from stop(user)
    yield from user.until(lambda: run.running() is None, "it has ended")
    assert run.latest() == "Stopped", run.latest()
    assert not list(stopped.iterdir())
    scene.frame_end = 200
    assert kept(scene) == before


def stop(user):
    """Press the button at the right end of the progress."""
    yield from user.find(f"{BUTTON}stop_all(", share=STOP)
    user.send("click", 1)


def beside(scene):
    """Add a camera "Dome" where the scene's own is; two small frames are to be made of both. Return it."""
    second = bpy.data.objects.new("Dome", bpy.data.cameras.new("Dome"))
    second.matrix_world = scene.camera.matrix_world.copy()
    scene.collection.objects.link(second)
    scene.render.engine, scene.render.resolution_percentage = "BLENDER_WORKBENCH", 20
    scene.frame_start, scene.frame_end = 1, 2
    bpy.ops.ed.undo_push(message="Two cameras")
    return second


def kept(scene):
    """What a run must leave as it was."""
    render = scene.render
    return (
        scene.camera.name, scene.frame_current, render.engine, render.resolution_x, render.resolution_y,
        render.resolution_percentage, render.image_settings.file_format, render.use_lock_interface,
        bpy.context.view_layer.use_pass_z, bpy.context.preferences.view.render_display_type,
    )  # fmt: skip


def check_whole(folder):
    """Each report stands beside the files that it lists, with their sizes; nothing else is there."""
    named = set()
    for path in folder.glob("*.json"):
        sizes = json.loads(path.read_text())["made"]["files"]
        assert {name: (folder / name).stat().st_size for name in sizes} == sizes
        named |= {path.name, *sizes}
    assert {path.name for path in folder.iterdir()} == named


def open_list(user):
    """Unfold the list of cameras, below the button Use in Cycles and the notes, unless it is unfolded: drawn."""
    seconds = []
    end = timed(addon("ui.cameras_list").SidebarCameras, seconds)
    user.region().tag_redraw()
    yield from user.wait(0.3)
    end()
    if seconds:
        return
    button, region = f"{BUTTON}use_in_cycles(", user.region()
    yield from user.find(button)
    yield from user.click(region.x + region.width // 4, user.known[button] - LIST)
    yield from user.wait(0.7)


def into(user, folder, **options):
    """Choose a folder, and options of the operator, in the file dialog."""
    browser = yield from dialog(user)
    browser.spaces.active.params.directory = str(folder).encode()
    for name, value in options.items():
        setattr(browser.spaces.active.active_operator, name, value)
    yield from user.wait(1)
    user.screenshot("cameras_dialog")
    yield from user.point(*middle(browser))
    yield from user.key("Return")


ALL_SCENARIOS = (cast_all, cast_all_by_cycles, export_all)
