"""The engine in Blender's pipeline: what it stores comes out of Blender's own files bit for bit."""

from types import SimpleNamespace

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.passes import PASSES

from ...exr import read_exr

FAR = 1e10
"""Blender's depth of the background, from its own engines."""

LABELS = {
    "combined": ("Combined", "RGBA"),
    "depth": ("Depth", "Z"),
    "distance": ("Distance", "X"),
    "position": ("Position", "XYZ"),
    "normal": ("Normal", "XYZ"),
    "uv": ("UV", "UVA"),
    "object_index": ("Object Index", "X"),
    "material_index": ("Material Index", "X"),
    "shape_index": ("Shape Index", "X"),
    "valid": ("Valid", "X"),
    "ray_origin": ("Ray Origin", "XYZ"),
    "ray_direction": ("Ray Direction", "XYZ"),
    "distance_bound": ("Distance Bound", "X"),
    "position_bound": ("Position Bound", "X"),
    "normal_bound": ("Normal Bound", "X"),
}
BEFORE_5_0 = {"object_index": ("IndexOB", "X"), "material_index": ("IndexMA", "X")}
WIDTH, HEIGHT = 40, 30


@pytest.fixture
def scene(blender):
    """A sphere before a tilted plane that leaves the picture's left free, seen from 6 above."""
    bpy = blender
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1, location=(0.25, 0, 1))
    bpy.context.object.pass_index = 3
    material = bpy.data.materials.new("Clay")
    material.pass_index = 5
    bpy.context.object.data.materials.append(material)
    bpy.ops.mesh.primitive_plane_add(size=4, location=(2, 0, -1), rotation=(0, 0.3, 0))
    bpy.ops.object.camera_add(location=(0, 0, 6))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    tick(scene, PASSES)
    return scene


def tick(scene, names):
    """Tick these passes in every view layer."""
    from camera_ray_caster.blender.engine import passes

    for layer in scene.view_layers:
        passes.tick(scene, layer, names)


@pytest.fixture
def render(blender, tmp_path):
    """A function that renders the current frame by Blender's own operator to an EXR and reads it back."""

    def render(**options):
        path = tmp_path / "picture.exr"
        settings = blender.context.scene.render.image_settings
        if hasattr(settings, "media_type"):
            settings.media_type = "MULTI_LAYER_IMAGE"
        settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
        if hasattr(settings, "use_exr_interleave"):
            settings.use_exr_interleave = True
        blender.context.scene.render.filepath = str(path)
        if options.get("animation"):
            blender.context.scene.render.filepath = str(tmp_path / "frame_")
            blender.ops.render.render(animation=True)
            return {int(path.stem[-4:]): read_exr(path) for path in sorted(tmp_path.glob("frame_*.exr"))}
        blender.ops.render.render(write_still=True)
        return read_exr(path)

    return render


def picture(channels, name, layer="ViewLayer"):
    """A pass out of an EXR's channels, (height, width[, channels])."""
    import bpy

    label, letters = LABELS[name] if bpy.app.version >= (5, 0, 0) else {**LABELS, **BEFORE_5_0}[name]
    return np.stack([channels[f"{layer}.{label}.{letter}"] for letter in letters], axis=-1)


def expected(scene, name, precision="AUTOMATIC", **keywords):
    """A pass as the caster returns it, in the form in which Blender stores it."""
    from camera_ray_caster.blender.read.scene import read_camera, read_shapes

    camera = read_camera(scene, **keywords)
    image = cast(camera, read_shapes(scene, **keywords), [name], precision=precision)[name].astype(np.float32)
    if name == "depth":
        image[np.isinf(image)] = FAR
    return image.reshape(*camera.raster.shape, -1)


@pytest.mark.parametrize("name", PASSES)
def test_every_pass_comes_out_of_the_file_as_it_was_cast(scene, render, name):
    tick(scene, [name])
    found, cast_of_it = picture(render(), name), expected(scene, name)
    assert found.shape[:2] == (HEIGHT, WIDTH)
    np.testing.assert_array_equal(found, cast_of_it)
    if name not in ("valid", "ray_origin"):  # the same everywhere in this picture
        assert np.ptp(found) > 0


def test_a_render_searches_with_the_precision_that_is_set(scene, render):
    from camera_ray_caster.blender.output import reports

    robust = picture(render(), "distance")
    scene.camera_ray_caster.precision = "FAST"
    fast = picture(render(), "distance")
    np.testing.assert_array_equal(robust, expected(scene, "distance"))
    np.testing.assert_array_equal(fast, expected(scene, "distance", precision="FAST"))
    assert not np.array_equal(robust, fast)
    assert reports.latest().precision == "FAST"


def test_the_file_holds_what_is_ticked_and_nothing_else(scene, render):
    tick(scene, ["combined", "normal", "valid"])
    passes = {name.split(".")[1] for name in render() if name.startswith("ViewLayer.")}
    assert passes == {"Combined", "Normal", "Valid"}


def test_combined_stays_when_nothing_is_ticked(scene, render):
    tick(scene, [])
    assert np.ptp(picture(render(), "combined")) > 0


def test_background_of_depth_and_distance(scene, render):
    channels = render()
    left = np.s_[HEIGHT // 2, 0, 0]
    assert picture(channels, "shape_index")[left] == -1
    assert picture(channels, "depth")[left] == np.float32(FAR)
    assert picture(channels, "distance")[left] == np.inf
    middle = np.s_[HEIGHT // 2, WIDTH // 2, 0]
    assert picture(channels, "object_index")[middle] == 3
    assert picture(channels, "material_index")[middle] == 5
    assert 4 < picture(channels, "depth")[middle] < 4.1, "the sphere's top is 4 below the camera"


BORDERS = [(0.1, 0.7, 0.2, 0.9), (0.0, 0.5, 0.5, 1.0), (0.31, 0.77, 0.13, 0.59)]


@pytest.mark.parametrize("border", BORDERS)
@pytest.mark.parametrize("crop", [True, False])
def test_a_border_shows_the_full_pictures_pixels(scene, render, border, crop):
    whole = picture(render(), "ray_direction")
    settings = scene.render
    settings.use_border, settings.use_crop_to_border = True, crop
    settings.border_min_x, settings.border_max_x, settings.border_min_y, settings.border_max_y = border
    found = picture(render(), "ray_direction")
    # Blender's own rounding: the border times the size, in float32, cut
    x0, x1 = (int(np.float32(side) * np.float32(WIDTH)) for side in border[:2])
    y0, y1 = (int(np.float32(side) * np.float32(HEIGHT)) for side in border[2:])
    if not crop:
        outside = found.copy()
        outside[y0:y1, x0:x1] = 0
        assert not outside.any()
        found = found[y0:y1, x0:x1]
    np.testing.assert_array_equal(found, whole[y0:y1, x0:x1])


def test_each_view_layer_has_its_own_shapes(blender, scene, render):
    collection = blender.data.collections.new("Only here")
    scene.collection.children.link(collection)
    sphere = blender.data.objects["Sphere"]
    scene.collection.objects.unlink(sphere)
    collection.objects.link(sphere)
    other = scene.view_layers.new("Other")
    other.layer_collection.children["Only here"].exclude = True
    tick(scene, ["shape_index", "object_index"])
    channels = render()
    assert 3 in picture(channels, "object_index")
    assert 3 not in picture(channels, "object_index", "Other")
    assert 0 in picture(channels, "shape_index", "Other"), "the plane is in both"


def test_an_animation_moves_the_camera(blender, scene, render):
    scene.frame_start, scene.frame_end = 1, 3
    for frame in (1, 2, 3):
        scene.camera.location.x = 10 * frame
        scene.camera.keyframe_insert("location", frame=frame)
    frames = render(animation=True)
    assert sorted(frames) == [1, 2, 3]
    for frame, channels in frames.items():
        assert (picture(channels, "ray_origin")[..., 0] == 10 * frame).all()


def test_a_subframe_lies_between(scene, render):
    from camera_ray_caster.blender.output import reports

    for frame in (1, 2):
        scene.camera.location.x = 10 * frame
        scene.camera.keyframe_insert("location", frame=frame)
    for curve in curves(scene.camera):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_set(1, subframe=0.25)
    np.testing.assert_allclose(picture(render(), "ray_origin")[..., 0], 12.5, rtol=1e-6)
    assert reports.latest().frame == 1.25


def curves(item):
    """The animation curves of an object, wherever this Blender keeps them."""
    action = item.animation_data.action
    if hasattr(action, "fcurves"):
        return action.fcurves
    return action.layers[0].strips[0].channelbag(item.animation_data.action_slot).fcurves


@pytest.mark.parametrize(("stopped", "ends"), [(True, False), (False, True), (False, False)])
def test_each_tile_shows_progress_and_asks_whether_to_stop(stopped, ends, monkeypatch):
    from camera_ray_caster.blender.engine import engine
    from camera_ray_caster.blender.terminal import signals

    shown = []
    stand_in = SimpleNamespace(update_progress=shown.append, test_break=lambda: stopped)
    monkeypatch.setattr(signals, "_noted", ends)
    assert engine.CameraRayCaster.advance(stand_in, 0.25) is not (stopped or ends)
    assert shown == [0.25]


def test_the_whole_way_is_shown(scene, slow, monkeypatch):
    import bpy

    from camera_ray_caster.blender.engine.engine import CameraRayCaster

    scene.render.resolution_x = scene.render.resolution_y = 1000
    shown = []
    monkeypatch.setattr(CameraRayCaster, "advance", lambda self, fraction: not shown.append(fraction))
    bpy.ops.render.render()
    assert len(shown) > 3
    assert shown == sorted(shown)
    assert shown[-1] == 1


def test_a_stop_ends_the_render_after_a_tile_and_leaves_no_report(scene, slow, monkeypatch):
    import bpy

    from camera_ray_caster.blender.engine.engine import CameraRayCaster
    from camera_ray_caster.blender.output import reports

    scene.render.resolution_x = scene.render.resolution_y = 1000
    asked = []
    monkeypatch.setattr(CameraRayCaster, "advance", lambda self, fraction: bool(asked.append(fraction)))
    bpy.ops.render.render()
    assert len(asked) == 1
    assert asked[0] < 0.5
    assert CameraRayCaster.stopped
    assert reports.latest() is None


def test_bad_input_is_one_line_and_no_traceback(scene, capfd):
    import bpy

    scene.camera.scale.x = 0
    with pytest.raises(RuntimeError) as error:
        bpy.ops.render.render()
    assert str(error.value).splitlines() == [
        "Error: camera 'Camera' has a scale of zero: apply or clear its scale (Alt S)"
    ]
    assert "Traceback" not in "".join(capfd.readouterr())


def test_what_is_left_out_is_warned_of_by_name(blender, scene, capfd):
    for _ in range(12):
        blender.ops.mesh.primitive_monkey_add()
    capfd.readouterr()
    blender.ops.render.render()
    said = "".join(capfd.readouterr())
    assert said.count("is left out") == 10
    assert "'Suzanne.003' is left out: " in said
    assert "2 more objects are left out" in said


def test_the_report_is_kept_until_another_file_is_opened(blender, scene):
    from camera_ray_caster.blender.output import reports

    assert not blender.ops.camera_ray_caster.write_report.poll()
    scene.view_layers.new("Other")
    blender.ops.render.render()
    report = reports.latest()
    assert report.layers == ("ViewLayer", "Other")
    assert (report.pixels, report.passed) == (2 * WIDTH * HEIGHT, True)
    assert {finding.witness for finding in report.findings} >= {"view_frame", "calc_matrix_camera"}
    assert {"read", "rays", "cast", "passes", "write"} <= set(report.seconds)
    blender.ops.camera_ray_caster.write_report()
    assert "view_frame" in blender.data.texts["Camera Ray Caster Report"].as_string()
    blender.ops.wm.read_factory_settings(use_empty=True)
    assert reports.latest() is None
