"""What once trapped a user in the window, one scenario a function: see scenarios.py."""

import bpy
from parts import BUTTON, load


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


WINDOW_SCENARIOS = (shown_camera,)
