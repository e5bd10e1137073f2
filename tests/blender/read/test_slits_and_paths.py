"""Cameras without one eye, set from objects of a scene: empties and curves that an artist grabs, moves and deletes."""

import math

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.conventions import EPS32
from camera_ray_caster.core.records import InputError

from ..cycles.cycles import cycles_surface

ENGINE = "CAMERA_RAY_CASTER"
WIDTH, HEIGHT = 48, 32


@pytest.fixture
def scene(blender):
    """A scene of 48 x 32 pixels with a camera 10 above the origin that looks down, and two spheres to be seen."""
    bpy = blender
    for x, radius in ((-1.2, 0.8), (1.1, 0.5)):
        bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=(x, 0.3, 0))
    bpy.ops.object.camera_add(location=(0, 0, 10), rotation=(0, 0, 0))
    made = bpy.context.scene
    made.camera = bpy.context.object
    made.render.engine = ENGINE
    made.render.resolution_x, made.render.resolution_y = WIDTH, HEIGHT
    return made


def settings_of(scene):
    return scene.camera.data.camera_ray_caster


def choose(scene, model, **settings):
    """Give the scene's camera a model and its settings."""
    settings_of(scene).model = model
    for name, value in settings.items():
        setattr(settings_of(scene), name, value)


def link(scene, item):
    scene.collection.objects.link(item)
    return item


def empty(bpy, scene, location, turn=(0, 0, 0)):
    """An empty; its X axis is the slit."""
    made = link(scene, bpy.data.objects.new("Slit", None))
    made.location, made.rotation_euler = location, turn
    return made


def curve(bpy, scene, points, kind="POLY"):
    """A curve object through points of the world."""
    data = bpy.data.curves.new("Line", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new(kind)
    knots = spline.bezier_points if kind == "BEZIER" else spline.points
    knots.add(len(points) - 1)
    for knot, point in zip(knots, points, strict=True):
        knot.co = point if kind == "BEZIER" else (*point, 1)
        if kind == "BEZIER":
            knot.handle_left_type = knot.handle_right_type = "AUTO"
    return link(scene, bpy.data.objects.new("Line", data))


def picture(scene, tmp_path):
    """What the engine renders: combined, (rows, columns, 4), out of Blender's own file."""
    import bpy

    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(tmp_path / "picture.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(HEIGHT, WIDTH, 4)


def gap(rays, point, direction):
    """The largest distance of the rays' lines from a line."""
    along = np.array(direction) / np.linalg.norm(direction)
    across = np.cross(rays.directions, along)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    return np.abs(((rays.origins - point) * across).sum(axis=-1)).max()


FLOAT32 = 1e-5
"""Blender's matrices are float32: 2^-24 of coordinates about 10, over the sine of a ray's angle with the slit."""


def test_rays_meet_the_x_axes_of_empties_wherever_they_are(blender, scene):
    parent = empty(blender, scene, (0.5, 0, 0), (0.1, 0, 0.2))
    first = empty(blender, scene, (0, 0.2, 12), (0, 0.3, 0.2))
    second = empty(blender, scene, (0.3, 0, 15), (0.2, 0, math.pi / 2))
    second.parent, second.scale = parent, (3, 0.5, 2)
    choose(scene, "CROSS_SLIT", slit_1=first, slit_2=second)
    for angle in (0.0, 0.4):
        second.rotation_euler.y = angle
        rays = read_camera(scene).rays()
        for slit in (first, second):
            matrix = np.array(slit.matrix_world)
            assert gap(rays, matrix[:3, 3], matrix[:3, 0]) < FLOAT32


@pytest.mark.parametrize("kind", ["POLY", "NURBS", "BEZIER"])
def test_a_curve_is_a_slit_from_its_first_to_its_last_point(blender, scene, kind):
    ends = np.array(((-2, 0.3, 0), (1, 1, 1), (2, 3, 0), (4, 0.5, 0.5)))
    slit = curve(blender, scene, ends, kind)
    slit.location = 0, 0, 9.5
    choose(scene, "PUSHBROOM", slit_1=slit)
    rays = read_camera(scene).rays()
    assert gap(rays, ends[0] + (0, 0, 9.5), ends[-1] - ends[0]) < FLOAT32


def test_a_slit_that_is_animated_and_hidden_is_where_it_is_at_the_frame(blender, scene):
    slit = empty(blender, scene, (0, 0, 10))
    for frame, height in ((1, 10), (11, 20)):
        slit.location.z = height
        slit.keyframe_insert("location", frame=frame)
    slit.hide_set(True)
    choose(scene, "PUSHBROOM", slit_1=slit)
    for frame, height in ((1, 10), (11, 20)):
        origins = read_camera(scene, frame=frame).rays().origins
        assert np.abs(origins[..., 2] - height).max() < FLOAT32
    slit.hide_viewport = True  # Blender evaluates it no more: it would stay where it is
    with pytest.raises(ValueError, match=r"slit_1 of camera 'Camera' .*disabled"):
        read_camera(scene, frame=1)
    blender.ops.render.render()
    slit.hide_render = True
    with pytest.raises(RuntimeError, match=r"slit_1 of camera 'Camera' .*disabled"):
        blender.ops.render.render()


def test_every_model_renders_and_moving_its_object_changes_the_picture(blender, scene, tmp_path):
    slit, other = empty(blender, scene, (0, 0, 10)), empty(blender, scene, (0, 0, 12), (0, 0, math.pi / 2))
    path = curve(blender, scene, ((-3, 0, 10), (0, 1, 9), (3, 0, 10)), "BEZIER")
    uses = {
        "CROSS_SLIT": (other, {"slit_1": slit, "slit_2": other}),
        "PUSHBROOM": (slit, {}),
        "PENCIL": (slit, {"pencil_slide": 4.0}),
        "TWISTED_ORTHOGRAPHIC": (slit, {"twist": 0.2}),
        "STRIP": (path, {"path": path, "follow_path": True}),
    }
    for model, (moved, settings) in uses.items():
        choose(scene, model, **settings)
        before = picture(scene, tmp_path)
        assert np.ptp(before[..., :3]) > 0.1, model
        moved.location.x += 0.3
        moved.location.y += 0.5
        assert not np.array_equal(picture(scene, tmp_path), before), model
    for model, settings in (("GENERAL_LINEAR", {}), ("OMNIDIRECTIONAL_STEREO", {"eye": "RIGHT"})):
        choose(scene, model, **settings)
        assert np.ptp(picture(scene, tmp_path)[..., :3]) > 0.1, model


@pytest.mark.parametrize("how", ["unset", "removed", "deleted"])
@pytest.mark.parametrize(("model", "name"), [("CROSS_SLIT", "slit_2"), ("STRIP", "path")])
def test_a_line_that_is_gone_is_named(blender, scene, how, model, name):
    bpy = blender
    lost = curve(bpy, scene, ((-3, 0, 12), (0, 1, 12), (3, 0, 12)))
    choose(scene, model, slit_1=empty(bpy, scene, (0, 0, 10), (0, 0, 1)), **{name: lost})
    read_camera(scene)
    if how == "removed":
        bpy.data.objects.remove(lost)
    elif how == "deleted":
        with bpy.context.temp_override(selected_objects=[lost], active_object=lost):
            bpy.ops.object.delete()
    else:
        setattr(settings_of(scene), name, None)
    with pytest.raises(ValueError, match=f"{name} of camera 'Camera' is not set, or its object is deleted"):
        read_camera(scene)
    with pytest.raises(RuntimeError, match=name):
        bpy.ops.render.render()


def test_what_is_no_curve_is_no_path(blender, scene):
    choose(scene, "STRIP", path=empty(blender, scene, (0, 0, 0)))
    with pytest.raises(ValueError, match=r"path.*choose a curve"):
        read_camera(scene)


@pytest.mark.parametrize("kind", [None, "POLY", "BEZIER", "NURBS"])
@pytest.mark.parametrize(("model", "name"), [("CROSS_SLIT", "slit_2"), ("STRIP", "path")])
def test_a_curve_without_two_points_is_no_line(blender, scene, kind, model, name):
    """As the last point's deletion leaves one: Blender makes no mesh of it."""
    short = curve(blender, scene, ((0, 0, 12),), kind or "POLY")
    if kind is None:
        short.data.splines.clear()
    choose(scene, model, slit_1=empty(blender, scene, (0, 0, 10)), **{name: short})
    with pytest.raises(InputError, match=rf"{name} of camera 'Camera' has no (length|direction): .*"):
        read_camera(scene)


def test_a_strip_goes_where_blender_samples_the_curve(blender, scene):
    circle = curve(blender, scene, ((2, 0, 10), (0, 2, 10), (-2, 0, 10), (0, -2, 10)), "BEZIER")
    circle.data.splines[0].use_cyclic_u = True
    circle.data.resolution_u = 64
    choose(scene, "STRIP", path=circle)
    origins = read_camera(scene).rays_at(np.linspace(0, WIDTH, 49), np.full(49, 16.0)).origins
    assert np.linalg.norm(origins[:, :2], axis=1) == pytest.approx(np.full(49, 2.0), rel=0.05)  # nearly a circle
    steps = np.linalg.norm(np.diff(origins, axis=0), axis=1)
    assert steps == pytest.approx(np.full(48, steps.mean()), rel=1e-3)  # at constant speed,
    assert np.abs(origins[0] - origins[-1]).max() < FLOAT32  # once round


def test_the_scene_is_as_it_was(blender, scene):
    path = curve(blender, scene, ((-3, 0, 10), (3, 0, 10)))
    choose(scene, "STRIP", path=path)
    before = len(blender.data.meshes), len(blender.data.objects), np.array(path.matrix_world)
    read_camera(scene)
    assert (len(blender.data.meshes), len(blender.data.objects)) == before[:2]
    assert np.array_equal(np.array(path.matrix_world), before[2])


@pytest.mark.parametrize("view", ["left", "right"])
def test_omnidirectional_stereo_is_the_spherical_stereo_of_cycles(blender, scene, view):
    """Without convergence and pole merge: what Cycles meets on the walls of a box lies on our rays."""
    blender.ops.mesh.primitive_cube_add(size=20, location=(1, 2, 8), rotation=(0.1, 0.2, 0.3))
    data = scene.camera.data
    scene.camera.rotation_euler = 0.4, 0.1, 0.3
    data.stereo.interocular_distance = 0.5
    choose(scene, "OMNIDIRECTIONAL_STEREO", eye=view.upper())
    rays = read_camera(scene).rays()
    choose(scene, "BLENDER")
    data.type = "PANO"
    (data if hasattr(data, "panorama_type") else data.cycles).panorama_type = "EQUIRECTANGULAR"
    data.stereo.use_spherical_stereo, data.stereo.convergence_mode = True, "PARALLEL"
    scene.render.use_multiview = True
    for render_view in scene.render.views:
        render_view.use, render_view.file_suffix = render_view.name == view, ""
    position = cycles_surface(scene, "Position", 32.0)
    assert not np.isnan(position).any()
    beside = np.linalg.norm(np.cross(position - rays.origins, rays.directions), axis=-1)
    # 32 operations for the direction, over 20 to the wall, 32 for places of up to 16, and EPS32 of a witness of 64
    assert beside.max() <= (32 * 20 + 32 * 16 + 64) * EPS32
    plain = np.linalg.norm(np.cross(position - scene.camera.location, rays.directions), axis=-1)
    assert np.median(plain) > 0.2  # the eye is 0.25 from the center: the test would see it
