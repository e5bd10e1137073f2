"""A camera as a custom one of Cycles: made, followed, read, and taken back."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.cycles import from_cycles, to_cycles
from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.records import InputError

from ..read.scene_parts import curves, new_object
from .cycles import cycles_directions, cycles_wires


@pytest.fixture
def scene(osl, camera_scene):
    render = camera_scene.render
    render.engine, render.resolution_x, render.resolution_y = "CYCLES", 48, 32
    return camera_scene


def settings_of(camera):
    return camera.data.camera_ray_caster


def same_rays(left, right):
    return all(
        np.array_equal(getattr(left, name), getattr(right, name), equal_nan=True) for name in ("origins", "directions")
    )


PORTRAIT = {"resolution_x": 32, "resolution_y": 48}
SHIFT = {"shift_x": 0.3, "shift_y": -0.2}
CAMERAS = {
    "perspective": {"lens": 30.0} | SHIFT | PORTRAIT,
    "perspective, fitted vertically": {"lens": 30.0, "sensor_fit": "VERTICAL", "pixel_aspect_x": 1.7} | SHIFT,
    "orthographic": {"type": "ORTHO"} | SHIFT | PORTRAIT,
    "panorama": {"type": "PANO", "panorama_type": "EQUIRECTANGULAR"} | SHIFT,
    "border": {"use_border": True, "border_min_x": 0.2, "border_max_x": 0.7, "border_min_y": 0.1} | SHIFT,
    "omnimax": {"model": "OMNIMAX"},
    "pushbroom": {"model": "CYLINDRICAL", "resolution_percentage": 37},
}
FLOAT32 = 2e-6
"""Radians: what float32 makes of rays that are nowhere singular; some ten operations, sine and cosine to 1e-6."""


def set_up(scene, settings):
    camera = scene.camera
    camera.location, camera.rotation_euler, camera.scale = (1.5, -2, 0.7), (0.5, 0.2, 0.7), (-1, 2, 0.5)
    for name, value in settings.items():
        owner = next(item for item in (camera.data, scene.render, settings_of(camera)) if hasattr(item, name))
        setattr(owner, name, value)
    return camera


def check(scene):
    rays, seen = read_camera(scene).rays(), cycles_directions(scene)
    assert np.array_equal(~np.isnan(seen[..., 0]), rays.valid)
    assert np.nanmax(np.linalg.norm(seen - rays.directions, axis=-1)) <= FLOAT32


@pytest.mark.parametrize("name", CAMERAS)
def test_cycles_renders_the_rays_that_are_read_before_and_after(scene, name):
    camera = set_up(scene, CAMERAS[name])
    before = read_camera(scene)
    assert to_cycles(scene) == []
    assert camera.data.type == "CUSTOM"
    after = read_camera(scene)
    assert type(after.model) is type(before.model)
    assert same_rays(before.rays(), after.rays())
    check(scene)


def test_what_is_changed_afterwards_is_followed(scene):
    camera = set_up(scene, {"lens": 30.0})
    to_cycles(scene)
    source = camera.data.custom_shader.as_string()
    camera.data.lens, camera.data.shift_x, scene.render.resolution_x = 70.0, 0.4, 64
    bpy.context.view_layer.update()
    assert camera.data.custom_shader.as_string() == source
    check(scene)
    settings_of(camera).model = "OMNIMAX"
    bpy.context.view_layer.update()
    check(scene)


def test_a_shader_is_left_alone_while_nothing_changes(scene, monkeypatch):
    from camera_ray_caster.blender.cycles import shader_updates

    set_up(scene, {"lens": 30.0})
    to_cycles(scene)
    new_object("Other").location.x = 1.0
    bpy.context.view_layer.update()
    monkeypatch.setattr(shader_updates, "shader_of", None)  # it would be called
    scene.objects["Other"].location.x = 2.0
    bpy.context.view_layer.update()


def test_inputs_are_the_settings_whatever_is_typed_into_them(scene):
    camera = set_up(scene, {"lens": 30.0})
    to_cycles(scene)
    camera.data.cycles_custom["window_pitch_x"] = 1.0
    camera.data.update_tag()
    bpy.context.view_layer.update()
    check(scene)


def test_of_cameras_with_the_same_data_the_active_one_counts(scene):
    camera = set_up(scene, {"model": "PENCIL"})
    settings_of(camera).slit_1 = slit = new_object("Slit")
    slit.location = (1.5, -2, 3)
    new_object("Other", camera.data).location = (5, 5, 5)
    bpy.context.view_layer.update()
    to_cycles(scene)
    slit.location.z = 3.5
    bpy.context.view_layer.update()
    check(scene)


@pytest.mark.parametrize("stretch", [2, pytest.param(1, marks=pytest.mark.full)])
def test_animation_is_keyframes_that_need_no_add_on(scene, monkeypatch, stretch):
    from camera_ray_caster.blender.cycles import shader_updates

    camera = set_up(scene, {"lens": 30.0})
    for frame, lens in ((1, 30.0), (5, 60.0)):
        camera.data.lens = lens
        camera.data.keyframe_insert("lens", frame=frame * stretch)
    scene.frame_start, scene.frame_end, scene.render.frame_map_old = 1, 5, 100 * stretch
    scene.frame_set(1)
    (warning,) = to_cycles(scene)
    assert "keyframes at frames 1 to 5" in warning
    monkeypatch.setattr(shader_updates, "update", lambda *arguments: None)
    scene.frame_set(4)
    assert 40 < camera.data.lens < 60
    check(scene)
    from_cycles(camera)
    assert [curve.data_path for curve in curves(camera.data)] == ["lens"]


def test_a_slit_that_moves_is_animation_too(scene):
    camera = set_up(scene, {"model": "CROSS_SLIT"})
    for name, turn in (("slit_1", 0.0), ("slit_2", 1.5)):
        slit = new_object(name)
        slit.location, slit.rotation_euler.z = (1.5, -2, 3.0 + turn), turn
        setattr(settings_of(camera), name, slit)
    bpy.context.view_layer.update()
    for frame, height in ((1, 3.0), (4, 3.5)):
        slit.location.z = height
        slit.keyframe_insert("location", frame=frame)
    scene.frame_end = 4
    assert to_cycles(scene)
    scene.frame_set(3)
    check(scene)


def test_it_goes_back_and_leaves_nothing(scene):
    camera = set_up(scene, {"type": "PANO", "panorama_type": "MIRRORBALL"})
    texts = set(bpy.data.texts)
    to_cycles(scene)
    to_cycles(scene)  # it is made anew
    from_cycles(camera)
    assert (camera.data.type, camera.data.custom_shader) == ("PANO", None)
    assert not camera.data.cycles_custom.keys()
    assert set(bpy.data.texts) == texts
    with pytest.raises(InputError, match="nothing to undo"):
        from_cycles(camera)


def test_a_shader_that_is_not_ours_is_refused_as_ever(scene):
    camera = set_up(scene, {})
    to_cycles(scene)
    text = camera.data.custom_shader
    text.from_string(text.as_string().replace("frame_width", "frame_size"))
    with pytest.raises(InputError, match="OSL shader"):
        read_camera(scene)


def test_a_camera_of_a_deleted_slit_keeps_its_last_rays(scene):
    camera = set_up(scene, {"model": "PENCIL"})
    settings_of(camera).slit_1 = slit = new_object("Slit")
    slit.location = (1.5, -2, 3)
    bpy.context.view_layer.update()
    to_cycles(scene)
    seen = cycles_directions(scene)
    bpy.data.objects.remove(slit)
    bpy.context.view_layer.update()
    assert np.array_equal(cycles_directions(scene), seen, equal_nan=True)
    with pytest.raises(InputError, match="slit_1"):
        read_camera(scene)


REFUSED = [
    ({"time_mode": "COLUMNS"}, "cast.py --engine CYCLES"),
    ({"type": "PANO", "panorama_type": "EQUIRECTANGULAR", "use_spherical_stereo": True}, "Spherical Stereo"),
    ({"lens": float("nan")}, "lens"),
]


@pytest.mark.parametrize(("settings", "message"), REFUSED)
def test_what_cannot_be_a_shader_is_refused_and_left_alone(scene, settings, message):
    data = scene.camera.data
    for name, value in settings.items():
        setattr(data.stereo if "stereo" in name else settings_of(scene.camera) if "time" in name else data, name, value)
    kind = data.type
    with pytest.raises(InputError, match=message):
        to_cycles(scene)
    assert data.type == kind
    assert not bpy.data.texts


@pytest.mark.parametrize(
    ("model", "mode"),
    [("BLENDER", "PARALLEL"), ("BLENDER", "OFFAXIS"), ("BLENDER", "TOE"), ("OMNIMAX", "PARALLEL"), ("OMNIMAX", "TOE")],
)
def test_both_eyes_of_stereo_are_those_that_are_read(scene, mode, model):
    camera = set_up(scene, {"model": model, "lens": 30.0} | SHIFT)
    scene.render.use_multiview = True
    camera.data.stereo.convergence_mode, camera.data.stereo.convergence_distance = mode, 2.5
    camera.data.stereo.interocular_distance = 0.3
    to_cycles(scene)
    for view, suffix in (("left", "_L"), ("right", "_R")):
        rays, seen = read_camera(scene, view=view).rays(), cycles_directions(scene, suffix)
        assert np.array_equal(~np.isnan(seen[..., 0]), rays.valid)
        assert np.nanmax(np.linalg.norm(seen - rays.directions, axis=-1)) <= FLOAT32


def test_eyes_that_cycles_would_shift_otherwise_are_refused(scene):
    set_up(scene, PORTRAIT)
    scene.render.use_multiview = True
    scene.camera.data.stereo.convergence_mode = "OFFAXIS"
    with pytest.raises(InputError, match="Sensor Fit to the frame's width"):
        to_cycles(scene)
    scene.camera.data.sensor_fit = "HORIZONTAL"
    settings_of(scene.camera).model = "OMNIMAX"  # a dome takes no shift
    with pytest.raises(InputError, match="choose Parallel"):
        to_cycles(scene)
    settings_of(scene.camera).model = "BLENDER"
    to_cycles(scene)


def test_an_engine_that_does_not_know_custom_cameras_is_named(scene):
    scene.render.engine = "BLENDER_WORKBENCH"
    (warning,) = to_cycles(scene)
    assert "choose Cycles" in warning


def test_the_file_renders_the_same_without_the_add_on(scene, tmp_path):
    import camera_ray_caster as crc

    set_up(scene, {"model": "OMNIMAX", "lens": 30.0} | SHIFT)
    to_cycles(scene)
    rays = read_camera(scene).rays()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "camera.blend"))
    crc.unregister()
    try:
        bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "camera.blend"))
        seen = cycles_directions(bpy.context.scene)
    finally:
        crc.register()
    assert np.array_equal(~np.isnan(seen[..., 0]), rays.valid)
    assert np.nanmax(np.linalg.norm(seen - rays.directions, axis=-1)) <= FLOAT32


def test_a_blender_without_osl_is_refused_in_one_line(scene, monkeypatch):
    import _cycles

    monkeypatch.setattr(_cycles, "with_osl", False)
    with pytest.raises(InputError, match="without the Open Shading Language: Cycles renders this camera as it is"):
        to_cycles(scene)
    assert scene.camera.data.type == "PERSP"


def test_a_camera_of_a_library_is_refused(scene, tmp_path):
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {scene.camera.data})
    with bpy.data.libraries.load(path, link=True) as (there, here):
        here.cameras = there.cameras
    scene.camera.data = here.cameras[0]
    with pytest.raises(InputError, match="library"):
        to_cycles(scene)


def test_rays_have_the_derivatives_of_cycles_own_camera(scene):
    """Lines of a width in pixels are as wide: they ask how far the rays of neighboring pixels are apart."""
    camera = set_up(scene, {"lens": 30.0})
    camera.scale = (1, 1, 1)
    read = read_camera(scene)
    corners = read.pose.eye + np.array([(-6, -6, -3), (7, -6, -4), (7, 6, -6), (-6, 6, -9)]) @ read.pose.basis.T
    mesh = bpy.data.meshes.new("Grid")
    mesh.from_pydata(corners.tolist(), [], [range(4)])
    new_object("Grid", mesh).modifiers.new("Grid", "SUBSURF").subdivision_type = "SIMPLE"
    scene.objects["Grid"].modifiers[0].render_levels = 3
    theirs = cycles_wires(scene)
    to_cycles(scene)
    ours = cycles_wires(scene)
    assert 0.2 < theirs.mean() < 0.8
    assert np.count_nonzero(ours != theirs) <= 2  # at the very edge of a line
