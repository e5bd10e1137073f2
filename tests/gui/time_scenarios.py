"""Cameras whose pixels have their own times, in the window, one scenario a function: see scenarios.py."""

import bpy
import numpy as np
from parts import BUTTON, addon, load
from user import pixels_of

BLOCKS = 16, 10
"""Parts of a picture, in columns and rows, whose mean colors are compared: its edges are not those of the view."""


def slit_scan_preview(user, scenes):
    """See Through shows a slit scan as a render does, with nothing of the scene changed, also after an edit and when it
    is switched off.
    """
    yield from load(user, scenes, "slit_scan_rows")
    scene, space, times = bpy.context.scene, user.area().spaces.active, addon("read.other_times")
    scene.render.resolution_percentage, scene.view_settings.view_transform = 50, "Standard"
    scene.camera.data.camera_ray_caster.time_end = 13  # a third of its frames are quicker to evaluate
    scene.frame_set(7)
    tower = next(item for item in scene.objects if item.animation_data and item.animation_data.drivers)
    engine = scene.render.engine
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.until(lambda: times._known.motion, "some frames are evaluated")
    user.screenshot("slit_scan_first")
    yield from user.until(lambda: times._known.is_done, "all frames are evaluated")
    yield from shown(user, "slit_scan_shown", space)
    assert (len(bpy.data.scenes), scene.frame_current) == (1, 7)
    yield from user.until(lambda: times._known.is_done, "all frames are evaluated after the render")
    count = len(times._known.states)
    scene.frame_set(9)
    yield from user.wait(1)
    assert len(times._known.states) == count, "the times are the same"
    before = tower.location.x
    tower.location.x += 1
    yield from user.until(lambda: times._known.is_done and len(times._known.states) >= 2, "it is read again")
    yield from shown(user, "slit_scan_moved", space)
    tower.location.x = before
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.until(lambda: not bpy.app.timers.is_registered(times.read_on), "it is off")
    assert not times._known.states
    assert (len(bpy.data.scenes), scene.frame_current, scene.render.engine) == (1, 9, engine)


def shown(user, name, space):
    """Compare what the view shows with a render."""
    scene, view = bpy.context.scene, user.region("WINDOW")
    space.overlay.show_overlays = False
    scene.render.filepath = str(user.folder / "f12.png")
    yield from user.wait(6)
    picture = user.cut(user.picture(name), view)
    with bpy.context.temp_override(window=user.window, area=user.area(), region=view):
        left, bottom, right, top = addon("read.view").camera_frame(bpy.context)
    before = scene.render.engine
    scene.render.engine = "CAMERA_RAY_CASTER"
    bpy.ops.render.render(write_still=True)
    scene.render.engine = before
    image = bpy.data.images.load(scene.render.filepath)
    rendered, off = pixels_of(image), []
    bpy.data.images.remove(image)
    for u, v in np.ndindex(*BLOCKS):
        x, y = (slice(*(int(low + k / count * (high - low)) for k in (i, i + 1)))
                for low, high, i, count in ((left, right, u, BLOCKS[0]), (bottom, top, v, BLOCKS[1])))  # fmt: skip
        columns, rows = (slice(i * size // count, (i + 1) * size // count)
                         for i, size, count in zip((u, v), rendered.shape[1::-1], BLOCKS, strict=True))  # fmt: skip
        if x.stop < view.width - 300:  # left of the sidebar
            both = picture[y, x, :3], rendered[rows, columns, :3]
            off.append(np.abs(np.subtract(*(picture.mean(axis=(0, 1)) for picture in both))).max())
    assert len(off) > 80, len(off)
    assert np.quantile(off, 0.95) < 0.06, np.sort(off)[-30:]  # one ray a pixel meets the lines of the grid or not


TIME_SCENARIOS = (slit_scan_preview,)
