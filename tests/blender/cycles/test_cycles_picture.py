"""Cycles' picture beside our passes: it shows what our rays hit, pixel for pixel, at every pixel's own time."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.cycles.cycles_picture import picture_of
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from ..read.scene_parts import curves, new_object
from .cycles import cycles_passes, show, shown

pytestmark = pytest.mark.usefixtures("osl")

REACH = 32.0
"""More than any coordinate in these scenes."""
FLOAT32 = 2e-6
"""Radians, of a ray: see test_to_cycles."""
ROUNDING = 32 * 2**-24 * REACH
"""What float32 may lose in Cycles: an interpolated matrix, a position and its color."""


@pytest.fixture
def scene(blender, camera_scene):
    """Eight cubes around a camera, at frame 5."""
    scene = camera_scene
    for k, corner in enumerate(np.ndindex(2, 2, 2)):
        blender.ops.mesh.primitive_cube_add(size=3, location=6 * np.array(corner) - 3, rotation=(k, 0.3, 2 * k))
        blender.context.object.pass_index = k + 1
    camera = scene.camera
    camera.location, camera.rotation_euler = (0.3, -0.2, 0.4), (1.2, 0.1, 0.7)
    render = scene.render
    render.resolution_x, render.resolution_y = 48, 32
    scene.frame_set(5)
    return scene


def settings_of(camera):
    return camera.data.camera_ray_caster


def cross_slit(scene):
    settings_of(scene.camera).model = "CROSS_SLIT"
    for name, along, turn in (("slit_1", 0.0, 0.0), ("slit_2", 2.0, 1.5)):
        slit = new_object(name)
        slit.parent, slit.location.z, slit.rotation_euler.z = scene.camera, along, turn
        setattr(settings_of(scene.camera), name, slit)


def panorama(scene):
    scene.camera.data.type, scene.camera.data.panorama_type = "PANO", "FISHEYE_EQUIDISTANT"
    scene.camera.data.fisheye_fov = 4.0


def omnimax(scene):
    settings_of(scene.camera).model = "OMNIMAX"


def shifted(scene):
    scene.camera.data.lens, scene.camera.data.shift_x, scene.camera.data.shift_y = 15.0, 0.2, -0.1


CAMERAS = {make.__name__: make for make in (shifted, panorama, cross_slit, omnimax)}


def check(scene, view="", allowed=0.0):
    """Cycles shows the places that our rays hit, and nothing where they hit nothing."""
    show(scene, "Position", REACH)
    ours = cast(
        read_camera(scene, view=view), read_shapes(scene, view=view), passes=("position", "distance"), dtype=np.float64
    )
    theirs = shown(picture_of(scene).pixels[scene.view_layers[0].name, view][..., :3], REACH)
    hit = np.isfinite(ours["distance"])
    assert 0.1 < hit.mean() < 1
    assert np.count_nonzero(hit != ~np.isnan(theirs[..., 0])) == 0
    cosine = facing(scene, view)
    apart = np.linalg.norm(theirs - ours["position"], axis=-1) * cosine
    assert apart[hit].max() <= ROUNDING + allowed + FLOAT32 * ours["distance"][hit].max()


def facing(scene, view):
    """The cosine between ray and surface: what is off along the ray counts for little where it is seen edge on."""
    ours = cast(
        read_camera(scene, view=view),
        read_shapes(scene, view=view),
        passes=("normal", "ray_direction"),
        dtype=np.float64,
    )
    return np.abs((ours["normal"] * ours["ray_direction"]).sum(axis=-1))


@pytest.mark.parametrize("name", CAMERAS)
def test_edges_lie_on_the_same_pixels(scene, name):
    CAMERAS[name](scene)
    check(scene)


def test_a_perspective_is_cycles_own(scene):
    show(scene, "Position", REACH)
    ours = picture_of(scene).pixels[scene.view_layers[0].name, ""]
    theirs, _ = cycles_passes(scene)
    both = np.isnan(shown(theirs, REACH)) == np.isnan(shown(ours[..., :3], REACH))
    assert both.all()
    assert np.abs(ours[..., :3] - theirs).max() <= (ROUNDING + FLOAT32 * REACH) / REACH


def test_a_border_is_rendered_alone_and_black_is_where_no_ray_is(scene):
    panorama(scene)
    render = scene.render
    render.use_border, render.border_min_x, render.border_max_y, render.film_transparent = True, 0.3, 0.8, True
    check(scene)
    pixels = picture_of(scene).pixels[scene.view_layers[0].name, ""]
    camera = read_camera(scene)
    assert pixels.shape == (*camera.raster.shape, 4)
    assert not pixels[~camera.rays().valid, :3].any()


EYES = {
    "parallel": {"convergence_mode": "PARALLEL"},
    "off-axis, portrait": {"convergence_mode": "OFFAXIS"},
    "toe-in": {"convergence_mode": "TOE"},
}


@pytest.mark.parametrize("name", EYES)
@pytest.mark.parametrize("kind", ["shifted", "panorama", "omnimax"])
def test_each_eye_has_its_picture(scene, name, kind):
    CAMERAS[kind](scene)
    scene.render.use_multiview = True
    stereo = scene.camera.data.stereo
    stereo.interocular_distance, stereo.convergence_distance, stereo.pivot = 0.5, 3.0, "CENTER"
    for setting, value in EYES[name].items():
        setattr(stereo, setting, value)
    if "portrait" in name:
        scene.render.resolution_x, scene.render.resolution_y = 32, 48
    for view in ("left", "right"):
        check(scene, view)


@pytest.mark.parametrize("kind", ["shifted", "panorama"])
def test_each_eye_of_spherical_stereo_has_its_picture(scene, kind):
    CAMERAS[kind](scene)
    scene.render.use_multiview = True
    stereo = scene.camera.data.stereo
    stereo.use_spherical_stereo = stereo.use_pole_merge = True
    stereo.interocular_distance, stereo.convergence_distance = 0.5, 3.0
    for view in ("left", "right"):
        check(scene, view)


def test_a_model_with_eyes_of_its_own_shows_each(scene):
    settings_of(scene.camera).model = "OMNIDIRECTIONAL_STEREO"
    scene.render.use_multiview = True
    for view in ("left", "right"):
        check(scene, view)


def test_each_view_may_have_a_camera_of_its_own(scene):
    scene.render.use_multiview, scene.render.views_format = True, "MULTIVIEW"
    for name, x in (("_L", -0.5), ("_R", 0.5)):
        other = new_object(f"Camera{name}", bpy.data.cameras.new("Camera"))
        other.location, other.rotation_euler = (x, -0.2, 0.4), (1.2, 0.1, 0.7)
    scene.camera = bpy.data.objects["Camera_L"]
    for view in ("left", "right"):
        check(scene, view)


def move(item, *places):
    """Let an object move evenly from frame 0 to frame 10."""
    for frame, location in zip((0, 10), places, strict=True):
        item.location = location
        item.keyframe_insert("location", frame=frame)
    for curve in curves(item):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


CLOCKS = [
    ("TOP_TO_BOTTOM", 0, 0),
    ("BOTTOM_TO_TOP", 0, 0),
    ("LEFT_TO_RIGHT", 0, 0),
    ("RIGHT_TO_LEFT", 0, 0),
    ("ROWS", 1, 9),
    ("ROWS", 9, 1),
    ("COLUMNS", 1, 9),
    ("COLUMNS", 8.5, 2.25),
    ("IMAGE", 1, 9),
]


@pytest.mark.cases(1)
@pytest.mark.parametrize("border", [False, True])
@pytest.mark.parametrize(("mode", "start", "end"), CLOCKS)
def test_what_moves_is_seen_at_each_pixels_time(scene, mode, start, end, border):
    """A camera and the cubes move evenly: between two places Cycles is as exact as we are."""
    panorama(scene)
    settings = settings_of(scene.camera)
    if "_TO_" in mode:
        settings.readout, mode = mode, "ROLLING_SHUTTER"
    settings.time_mode, settings.time_start, settings.time_end = mode, start, end
    if mode == "IMAGE":
        settings.time_image = bpy.data.images.new("Times", 3, 2, float_buffer=True)
        settings.time_image.pixels.foreach_set(np.repeat([0, 0.5, 0.9, 0.2, 0.5, 1], 4).astype(np.float32))
    move(scene.camera, (0.3, -0.2, 0), (0.3, 0.4, 1))
    for item in scene.objects:
        if item.type == "MESH":
            move(item, item.location, item.location * 1.3)
    scene.frame_set(5)
    scene.render.motion_blur_shutter, scene.cycles.rolling_shutter_duration = 4.0, 0.0
    if border:
        render = scene.render
        render.use_border, render.border_max_x, render.border_min_y = True, 0.62, 0.3
    check(scene, allowed=ROUNDING)


PLAIN = "BOOLEAN", "INT", "FLOAT", "STRING", "ENUM"


def state():
    """All that a render might leave behind."""
    scene = bpy.context.scene
    plain = [
        {each.identifier: getattr(owner, each.identifier) for each in owner.bl_rna.properties if each.type in PLAIN}
        for owner in (scene.render, scene.cycles)
    ]
    motion = [(item.name, item.data, item.cycles.motion_steps, item.cycles.use_motion_blur) for item in scene.objects]
    blocks = [list(getattr(bpy.data, name)) for name in ("cameras", "texts", "actions")]
    return plain, motion, blocks, scene.frame_current_final, scene.camera, scene.camera.data.type


@pytest.mark.parametrize("mode", ["NONE", "COLUMNS", "IMAGE"])
@pytest.mark.parametrize("fails", [False, True])
def test_the_scene_is_as_it_was(scene, monkeypatch, mode, fails):
    from camera_ray_caster.blender.cycles import renderer

    settings = settings_of(scene.camera)
    settings.time_mode = mode
    settings.time_image = bpy.data.images.new("Times", 2, 1, float_buffer=True)
    scene.camera.data.lens = 20.0
    scene.camera.data.keyframe_insert("lens", frame=1)
    show(scene, "Position", REACH)
    scene.render.engine = "CAMERA_RAY_CASTER"
    before = state()
    if fails:
        monkeypatch.setattr(renderer, "raise_if_stopping", lambda: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            picture_of(scene)
    else:
        picture_of(scene)
    assert state() == before


def test_a_camera_that_is_a_custom_one_keeps_its_shader_and_keyframes(scene):
    from camera_ray_caster.blender.cycles import to_cycles

    for frame, lens in ((1, 15.0), (9, 40.0)):
        scene.camera.data.lens = lens
        scene.camera.data.keyframe_insert("lens", frame=frame)
    scene.frame_end = 9
    scene.frame_set(5)
    to_cycles(scene)
    source, paths = scene.camera.data.custom_shader.as_string(), [each.data_path for each in curves(scene.camera.data)]
    check(scene)
    assert scene.camera.data.custom_shader.as_string() == source
    assert [each.data_path for each in curves(scene.camera.data)] == paths


@pytest.mark.parametrize("color", [0.0, 0.5])
def test_a_picture_without_light_is_warned_of(scene, color):
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (color, color, color, 1.0)
    scene.render.resolution_x, scene.render.resolution_y, scene.cycles.samples = 12, 8, 1
    warnings = picture_of(scene).warnings
    assert [line.partition(":")[0] for line in warnings] == ([] if color else ["Cycles' picture is black"])


def test_cycles_renders_again_afterwards(scene, render):
    """Blender lost the engine's class with its subclass that renders our picture, and crashed."""
    picture_of(scene)
    scene.render.engine = "CYCLES"
    assert any(channel.any() for name, channel in render().items() if "Combined" in name)
