"""What once trapped a user in the window, one scenario a function: see scenarios.py."""

import bpy
from parts import BUTTON, addon, load


def shown_camera(user, scenes):
    """The sidebar's buttons change the camera that it shows while another one is selected, and say so of a light."""
    yield from load(user, scenes, "toys")
    scene = bpy.context.scene
    shown, other = scene.camera, bpy.data.objects.new("Other", bpy.data.cameras.new("Other"))
    scene.collection.objects.link(other)
    bpy.context.view_layer.objects.active = other
    other.select_set(True)
    shown.data.camera_ray_caster.model = other.data.camera_ray_caster.model = "CROSS_SLIT"
    yield from user.wait(0.5)
    yield from user.press(f"{BUTTON}add_line(")
    yield from user.until(lambda: shown.data.camera_ray_caster.slit_1, "the slit is added to the camera that is shown")
    assert other.data.camera_ray_caster.slit_1 is None
    scene.camera = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "SUN"))
    yield from user.wait(0.7)
    user.picture("camera_is_a_light")
    for command in ("see_through(", "load_calibration(", "cast("):
        yield from user.press(BUTTON + command)
    area = user.area()
    assert area.spaces.active.region_3d.view_perspective == "PERSP"
    area.ui_type = "PROPERTIES"
    yield from user.wait(0.7)
    user.picture("camera_is_a_light_properties")
    area.ui_type = "VIEW_3D"


def set_frame(user, scenes):
    """A button sets the frame of a fisheye; the load dialog shows both sizes, and sets the frame of a file."""
    yield from load(user, scenes, "toys")
    camera, render = bpy.context.scene.camera.data, bpy.context.scene.render
    camera.type, camera.panorama_type = "PANO", "FISHEYE_EQUIDISTANT"
    render.resolution_x, render.resolution_y = 1920, 1080
    yield from user.wait(0.7)
    user.picture("set_frame")
    yield from user.press(f"{BUTTON}set_frame(")
    yield from user.until(lambda: render.resolution_x == 1080, "the frame is square")
    path = user.folder / "cameras.txt"
    path.write_text("1 PINHOLE 1241 376 700 700 620 188\n")
    yield from user.press(f"{BUTTON}load_calibration(")
    browser = yield from dialog(user)
    browser.spaces.active.params.directory = str(user.folder).encode()
    browser.spaces.active.params.filename = path.name
    yield from user.wait(1)
    user.picture("load_dialog")
    yield from user.point(*middle(browser))
    yield from user.key("Return")
    yield from user.until(lambda: camera.camera_ray_caster.model == "OPENCV_PINHOLE", "the calibration is loaded")
    assert (render.resolution_x, render.resolution_y) == (1241, 376)
    yield from user.wait(0.5)
    user.picture("loaded")


def other_engine(user, scenes):
    """F12 by an engine that does not know the model says so in the status bar, and the panel has what would work."""
    yield from load(user, scenes, "toys")
    scene, said, other = bpy.context.scene, [], addon("ui.other_engine")
    scene.camera.data.camera_ray_caster.model, scene.render.engine = "OMNIMAX", "BLENDER_WORKBENCH"
    scene.render.resolution_percentage = 10
    show = other.show
    other.show = lambda text: (said.append(text), show(text))
    yield from user.wait(0.5)
    yield from user.point(*middle(user.region("WINDOW")))
    yield from user.key("F12")
    yield from user.until(lambda: said, "the status bar says it", 60)
    assert said[0].startswith("Workbench does not know Omnimax: it renders a perspective"), said
    yield from user.until(lambda: any(area.type == "IMAGE_EDITOR" for area in user.window.screen.areas), "it is shown")
    yield from user.wait(0.7)
    user.picture("other_engine_f12")
    yield from user.point(*middle(user.area("IMAGE_EDITOR")))
    yield from user.key("Escape")
    yield from user.until(lambda: any(area.type == "VIEW_3D" for area in user.window.screen.areas), "the view is back")
    yield from user.wait(0.5)
    user.picture("other_engine")
    yield from user.press(f"{BUTTON}use_this_engine(")
    yield from user.until(lambda: scene.render.engine == "CAMERA_RAY_CASTER", "the engine is set")
    yield from user.until(lambda: None in said, "the status bar is Blender's again", 60)
    other.show = show


def middle(part):
    """The middle of an area or a region, in the window."""
    return part.x + part.width // 2, part.y + part.height // 2


def dialog(user):
    """Wait for the file dialog, and return its area."""
    def areas():
        return [area for area in user.window.screen.areas if area.type == "FILE_BROWSER"]

    yield from user.until(lambda: areas() and areas()[0].spaces.active.params, "the file dialog is open")
    yield from user.wait(0.7)
    return areas()[0]


WINDOW_SCENARIOS = (shown_camera, set_frame, other_engine)
