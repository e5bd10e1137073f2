"""What a user sees of settings that are keyed and driven, one scenario a function: see scenarios.py."""

import bpy
import numpy as np
from parts import BUTTON, addon, cast_through, load
from window_scenarios import middle

PATH = "camera_ray_caster."
"""What the data paths of a camera's own settings begin with."""
FRAMES = 1, 2


def by_hand(user, scenes):
    """Over a setting I inserts a keyframe and Ctrl+D a driver, and its color says so; a file's name takes none of them.
    The view, the numbers, a cast and F12 follow the frame.
    """
    yield from load(user, scenes, "toys")
    scene, region = bpy.context.scene, user.region("WINDOW", "PROPERTIES")
    camera = scene.camera.data
    group, scene.render.engine, scene.render.resolution_percentage = camera.camera_ray_caster, "CAMERA_RAY_CASTER", 10
    group.model, bpy.context.view_layer.objects.active = "OPENCV_PINHOLE", scene.camera
    yield from user.wait(0.5)
    user.area("PROPERTIES").spaces.active.context = "DATA"
    yield from user.wait(0.7)
    yield from over(user, "calibration_file", region, "i")
    assert camera.animation_data is None or camera.animation_data.action is None

    group.model = "DOME_MASTER"
    yield from user.press(f"{BUTTON}see_through(")
    yield from user.wait(0.7)
    plain = user.picture("animated_plain")
    yield from over(user, "fov", region, "i")
    assert [curve.data_path for curve in curves(camera)] == [f"{PATH}fov"]
    keyed = user.picture("animated_keyed")
    assert is_colored(user, plain, keyed, "fov", region)
    yield from to_frame(user, 2)
    group.fov /= 2
    yield from over(user, "fov", region, "i")
    assert len(curves(camera)[0].keyframe_points) == 2
    yield from differ(user, "fov")

    yield from over(user, "tilt", region, "ctrl+d")
    (driver,) = camera.animation_data.drivers
    assert driver.data_path == f"{PATH}tilt"
    yield from user.key("Escape")  # the driver's popover
    yield from user.wait(0.5)
    driver.driver.variables.remove(driver.driver.variables[0])
    driver.driver.expression = "frame / 4"
    yield from user.wait(0.5)
    assert is_colored(user, plain, user.picture("animated_driven"), "tilt", region)
    lesson, numbers = addon("view3d.pixel_lessons"), []
    lesson.clicked.choose([(9, 9)])
    for frame in FRAMES:
        yield from to_frame(user, frame)
        assert abs(group.tilt - frame / 4) < 1e-6
        numbers.append(lesson.lessons(bpy.context)[9, 9].steps)
    lesson.forget()
    assert numbers[0] != numbers[1]
    reports = addon("output.reports")
    for begin in (lambda: user.press(f"{BUTTON}cast("), lambda: user.key("F12")):
        before = reports.latest(scene)
        yield from user.point(*middle(user.region("WINDOW")))
        yield from begin()
        yield from user.until(lambda before=before: reports.latest(scene) is not before, "it is cast")
        settings = reports.latest(scene).camera["settings"]
        assert abs(settings["tilt"] - 0.5) < 1e-6
        assert settings["fov"] == group.fov
    yield from user.see_render()


def over(user, name, region, keys):
    """Press keys while the mouse is over a setting of the camera's."""
    yield from user.find(f"{PATH}{name}", region, "ctrl+shift+c", 0.7)
    yield from user.key(keys)
    yield from user.wait(0.3)


def is_colored(user, before, after, name, region):
    """Whether a setting's field has another color than before."""
    y = user.known[f"{PATH}{name}"]
    row = np.s_[y - 8 : y + 8, region.x : region.x + region.width, :3]
    return np.abs(np.median(after[row] - before[row], axis=(0, 1))).max() > 0.05


def every_kind(user, scenes):
    """The view follows a keyed setting of each kind."""
    yield from load(user, scenes, "toys")
    scene = bpy.context.scene
    group, ball = scene.camera.data.camera_ray_caster, bpy.data.objects["Ball"].camera_ray_caster
    bpy.ops.camera_ray_caster.add_line(setting="slit_1")
    slit, settings = group.slit_1, scene.camera_ray_caster
    cast_through(user)
    group.model = "DOME_MASTER"
    yield from user.press(f"{BUTTON}see_through(")
    for model, owner, name, values in (
        ("CAMERA_OBSCURA", group, "obscura_depth", (0.05, 0.1)),
        ("DOME_MASTER", group, "tilt", (1.4, 0.7)),
        ("OPENCV_PINHOLE", group, "calibration_width", (1920, 960)),
        ("GENERAL_LINEAR", group, "ray_1", ((0, 0, -1, -1), (0, 0, 0, 0))),
        ("PENCIL", group, "pencil_slide", (0.0, 0.5)),
        ("OMNIMAX", group, "model", ("OMNIMAX", "OPENCV_FISHEYE")),
        ("PUSHBROOM", slit, "location", ((0, 0, 0), (0, 1, 0))),
        ("OPENCV_PINHOLE", ball, "primitive", ("SPHERE", "IGNORE")),
        ("OPENCV_PINHOLE", settings, "shading", ("MATERIAL", "GRID")),
    ):
        group.model = model
        for frame, value in zip(FRAMES, values, strict=True):
            setattr(owner, name, value)
            assert owner.keyframe_insert(name, frame=frame)
        yield from differ(user, name)
        owner.id_data.animation_data_clear()
        setattr(owner, name, values[0])
    yield from user.press(f"{BUTTON}see_through(")


def curves(owner):
    """The curves of an ID's action."""
    action = owner.animation_data.action
    bags = [strip.channelbag(owner.animation_data.action_slot) for layer in action.layers for strip in layer.strips]
    return [curve for bag in bags for curve in bag.fcurves]


def to_frame(user, frame):
    """Go to the next frame or the one before by an arrow key over the view."""
    scene = bpy.context.scene
    yield from user.point(*middle(user.region("WINDOW")))
    while scene.frame_current != frame:
        yield from user.key("Right" if scene.frame_current < frame else "Left")


def differ(user, name):
    """Wait until the second frame shows another picture than the first one."""
    seen = []

    def look(frame):
        seen.append(user.cut(user.picture(f"animated_{name}_{frame}"), user.region("WINDOW"))[:, 60:-400].tobytes())
        return seen[-1] != seen[0]

    for frame in FRAMES:
        yield from to_frame(user, frame)
        yield from user.wait(0.7)
        look(frame)
    yield from user.until(lambda: look(FRAMES[-1]), f"{name} is seen")


ANIMATED_SCENARIOS = (by_hand, every_kind)
