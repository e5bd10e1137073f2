"""Slit scans and time displacement of scenes that move in every way: against motion worked out by hand."""

import numpy as np
import pytest

from camera_ray_caster.blender.output import reports
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.records import InputError

from ..pictures import picture
from .scene_parts import geometry_nodes, new_object, plain
from .time_scene import PASSES, SIZE, coordinates, disc, drive, fan, gray, key, same, still, walked


@pytest.mark.cases(1)
@pytest.mark.parametrize("mode", ["ROWS", "COLUMNS", "ROLLING_SHUTTER", "IMAGE"])
def test_of_a_still_scene_it_is_the_plain_picture_bit_for_bit(blender, scene, sphere, mode):
    sphere.location, sphere.scale = (0.3, -0.2, 1.0), (1.5, 1.0, 2.0)
    sphere.rotation_euler = (0.2, 0.3, 0.4)
    blender.ops.mesh.primitive_plane_add(size=5, location=(1, 1, 0), rotation=(0.3, 0.1, 0))
    settings = scene.camera.data.camera_ray_caster
    settings.time_mode = mode
    settings.time_image = gray(blender)
    timed, plain = walked(scene), still(scene)
    for name in PASSES:
        assert np.array_equal(timed[name], plain[name]), name


def test_a_sphere_at_constant_speed_is_a_sheared_ellipse_in_f12_too(blender, scene, sphere, render):
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7)
    x, y, frame = coordinates()
    hit, unsure = disc(x, y, (frame - 13) / 4)
    same(walked(scene)["shape_index"] == 0, hit, unsure)
    channels = render()
    same(picture(channels, "shape_index")[..., 0] == 0, hit, unsure)
    same(picture(channels, "depth")[..., 0] < 11, hit, unsure)
    assert scene.frame_current == 7
    report = reports.latest()
    assert report.frame == 7
    assert "evaluations" in report.motion[0]
    assert "ViewLayer" in report.layers
    blender.ops.camera_ray_caster.write_report()
    assert "evaluations" in blender.data.texts["Camera Ray Caster Report"].as_string()


@pytest.mark.full
def test_parents_drivers_and_the_camera_itself_move(blender, scene, sphere):
    """The parent carries the sphere along y, a driver along x by the frame, and the camera follows half of that."""
    parent = new_object("Parent")
    key(parent, "location", (1, -2.0), (25, 2.0), index=1)
    sphere.parent = parent
    drive(sphere, "location", 0, "frame / 8 - 1.5")
    key(scene.camera, "location", (1, -0.5), (25, 1.0), index=0)
    scene.frame_set(7)
    x, y, frame = coordinates()
    hit, unsure = disc(x + (frame - 9) / 16, y, frame / 8 - 1.5, (frame - 13) / 6)
    same(walked(scene)["shape_index"] == 0, hit, unsure)
    camera = read_camera(scene)
    assert camera.rays().origins[:, 0, 0] == pytest.approx((x[0, 0] + (frame - 9) / 16)[:, 0], abs=1e-5)


def test_geometry_that_changes(blender, scene, sphere):
    """A node moves the mesh's points: the object stands still, its sphere does not."""

    def build(node, link, mesh):
        moved, time = node("GeometryNodeSetPosition"), node("GeometryNodeInputSceneTime")
        offset = node("ShaderNodeCombineXYZ")
        link(mesh, moved.inputs["Geometry"])
        link(time.outputs["Frame"], offset.inputs[0])
        link(offset.outputs[0], moved.inputs["Offset"])
        return moved.outputs[0]

    geometry_nodes(sphere, build)
    sphere.scale = (0.2, 1.0, 1.0)
    sphere.location.x = -2.6
    x, y, frame = coordinates()
    away = np.hypot((x + 2.6 - 0.2 * frame) / 0.2, y) - 1
    same(walked(scene)["shape_index"] == 0, away <= 0, np.abs(away) < 1e-3)


def test_shapes_that_are_switched_on_come_at_their_frame(scene, sphere):
    for frame, hidden in ((1, True), (13, False)):
        sphere.hide_viewport = sphere.hide_render = hidden
        for path in ("hide_viewport", "hide_render"):
            sphere.keyframe_insert(path, frame=frame)
    scene.frame_set(13)
    x, y, frame = coordinates()
    hit, unsure = disc(x, y, 0.0)
    same(walked(scene)["shape_index"] == 0, hit & (frame >= 13), unsure)


@pytest.mark.full
def test_what_is_hidden_for_a_few_of_a_hundred_frames_is_hidden_then(scene, sphere):
    """The keys are evaluated, since whole frames are too many and the first probes miss them."""
    for frame, hidden in ((1, False), (42, True), (56, False)):
        sphere.hide_render = hidden
        sphere.keyframe_insert("hide_render", frame=frame)
    settings = scene.camera.data.camera_ray_caster
    settings.time_start, settings.time_end = 1.0, 100.0
    x, y, _ = coordinates()
    sphere.scale.y = 9.0  # over all rows
    frame = 1 + 99 * (np.arange(SIZE)[:, None] + 0.5) / SIZE
    expected = (np.hypot(x, y / 9) <= 1) & ~((frame >= 42) & (frame < 56))
    same(walked(scene)["shape_index"] == 0, expected, np.abs(np.hypot(x, y / 9) - 1) < 1e-4)


def test_a_keyed_color_changes_from_row_to_row(blender, scene, sphere):
    material = plain("Paint", (0, 0, 0, 1))
    sphere.data.materials.append(material)
    has_nodes = blender.app.version >= (5, 0)
    path = 'nodes["Principled BSDF"].inputs["Base Color"].default_value' if has_nodes else "diffuse_color"
    key(material.node_tree if has_nodes else material, path, (1, (0, 0, 0, 1)), (25, (1, 0.5, 0, 1)))
    shapes = read_shapes(scene)
    for frame in (1.0, 7.3, 24.9):
        share = (frame - 1) / 24
        np.testing.assert_allclose(shapes.at(frame).color, [[share, share / 2, 0, 1]], atol=1e-6)


def test_an_image_displaces_time(blender, scene, sphere):
    settings = scene.camera.data.camera_ray_caster
    settings.time_mode, settings.time_image = "IMAGE", gray(blender)
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    x, y, _ = coordinates()
    level = np.rint(np.linspace(0, 1, 16, dtype=np.float32).reshape(4, 4) * 255) / 255
    share = np.kron(level, np.ones((SIZE // 4, SIZE // 4)))
    hit, unsure = disc(x, y, -3 + 6 * share)
    same(walked(scene)["shape_index"] == 0, hit, unsure)


def test_a_fan_of_whole_turns_a_frame_is_resolved(blender, scene):
    """At each whole frame it looks at rest; a slit scan over half a frame shows its half turns."""
    fan(blender, 3)
    settings = scene.camera.data.camera_ray_caster
    settings.time_start, settings.time_end = 7.0, 7.5
    camera, images = read_camera(scene), walked(scene)
    assert not camera.motion.unresolved
    assert len(camera.motion.states) > 6
    x, y, frame = coordinates()
    angle = 2 * np.pi * 3 * (7 + (frame - 1) / 48)
    along, across = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    edge = np.maximum(np.abs(along) - 2.5, np.abs(across) - 0.4)
    same(images["shape_index"] == 0, edge <= 0, np.abs(edge) < 0.05)  # the tolerance: a tenth of a pixel, doubled


def test_a_time_image_whose_file_is_missing_is_named_with_its_path(blender, tmp_path):
    blender.ops.object.camera_add()
    scene = blender.context.scene
    scene.camera = blender.context.object
    image = blender.data.images.new("Times\nof pixels", 2, 2)
    image.source, image.filepath = "FILE", str(tmp_path / "gone.png")
    settings = scene.camera.data.camera_ray_caster
    settings.time_mode, settings.time_image = "IMAGE", image
    path = str(tmp_path / "gone.png")
    with pytest.raises(InputError) as refusal:
        read_camera(scene)
    assert str(refusal.value).startswith(f"image 'Times\\nof pixels' cannot be read from {path!r}: find its file")
