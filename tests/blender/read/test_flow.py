"""Flow in scenes of Blender: the frames that are read for it, and Blender's own Vector pass."""

from dataclasses import replace

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read import evaluated, read_scene
from camera_ray_caster.blender.read.scene_reader import evaluated_camera
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.scene import Scene

from .scene_parts import ball, new_object
from .time_scene import key

BOTH = "flow_forward", "flow_backward"


@pytest.fixture
def scene(blender):
    """A camera that goes on, a ball that rolls, and a monkey that turns, before the ground; frame 5."""
    scene = bpy.context.scene
    camera = scene.camera = new_object("Camera", bpy.data.cameras.new("Camera"))
    camera.rotation_euler = (1.45, 0, 0)
    rolling = ball()
    bpy.ops.mesh.primitive_monkey_add(location=(2, 0, 0))
    monkey = bpy.context.object
    bpy.ops.mesh.primitive_plane_add(size=30, location=(0, 0, -1))
    key(camera, "location", (1, (0, -8, 1)), (11, (0.4, -7, 1)))
    key(rolling, "location", (1, (-1, 0, 0)), (11, (2, -1, 0.3)))
    key(rolling, "rotation_euler", (1, (0, 0, 0)), (11, (0.5, 1, 0)))
    key(monkey, "rotation_euler", (1, (0, 0, 0)), (11, (0, 0, 2)))
    scene.render.resolution_x, scene.render.resolution_y = 96, 72
    scene.frame_set(5)
    return scene


def test_neighbors_are_read_only_for_flow_and_the_scene_is_as_it_was(scene, monkeypatch):
    frames, read = [], evaluated.shapes_record

    def watched(depsgraph, *has_colors):
        frames.append(depsgraph.scene.frame_current)
        return read(depsgraph, *has_colors)

    monkeypatch.setattr(evaluated, "shapes_record", watched)
    moving = read_scene(scene, passes=("depth",))
    assert frames == [5]
    assert moving.next is moving.previous is None
    moving = read_scene(scene, frame=3.5, passes=("flow_forward",))
    assert frames[1:] == [3, 4]
    assert moving.previous is None
    np.testing.assert_array_equal(moving.next.camera.pose.eye, read_scene(scene, frame=4.5).camera.pose.eye)
    frames.clear()
    moving = read_scene(scene, passes=("flow_hidden",))
    assert sorted(frames) == [4, 5, 6]
    assert scene.frame_current == 5
    with pytest.raises(InputError, match="unknown pass"):
        read_scene(scene, passes=("flow",))


def test_within_another_reading_no_frame_is_gone_to(scene):
    with evaluated_camera(scene), pytest.raises(InputError, match="handler"):
        read_scene(scene, passes=("flow_forward",))


def test_blenders_vector_pass_is_the_same_flow(scene, render):
    """X and Y are the backward flow, Z and W the forward one with its sign turned; 0 in the background. float32 keeps
    1e-4 pixel; where rays pass an edge Cycles may see another surface.
    """
    scene.camera_ray_caster.exact_shapes = False
    read = read_scene(scene, passes=BOTH)
    images = cast(read.camera, read.shapes, passes=(*BOTH, "shape_index"), dtype=float)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.filter_width = 1, 0.01
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    bpy.context.view_layer.use_pass_vector = True
    channels = render(elsewhere=True)
    backward, forward = (np.stack([channels[f"ViewLayer.Vector.{c}"] for c in both], -1) for both in ("XY", "ZW"))
    for name, vector in (("flow_backward", backward), ("flow_forward", -forward)):
        flow = images[name]
        apart = np.abs(flow - vector).max(axis=-1)
        seen = ~np.isnan(apart)
        assert np.median(apart[seen]) < 2e-4
        assert (apart[seen] < 1e-3).mean() > 0.98
        assert np.ptp(flow[seen]) > 5
        assert np.abs(vector[images["shape_index"] < 0]).max() < 1e-4


def test_a_deforming_mesh_is_followed_and_a_new_topology_is_not(scene):
    monkey = bpy.data.objects["Suzanne"]
    monkey.animation_data_clear()
    wave = monkey.modifiers.new("Wave", "WAVE")
    wave.height = 0.2
    read = read_scene(scene, passes=("flow_forward",))
    row = [name for name in read.shapes.names].index("Suzanne")
    images = cast(read.camera, read.shapes, passes=("flow_forward", "shape_index"), dtype=float)
    here = images["shape_index"] == row
    assert not np.isnan(images["flow_forward"][here]).any()
    still = Scene(read.next.camera, replace(read.next.shapes, meshes=read.shapes.meshes))
    rigid = cast(read.with_timeline(next=still), passes=("flow_forward",), dtype=float)["flow_forward"]
    assert 0.05 < np.abs(rigid - images["flow_forward"])[here].max() < 5
    build = monkey.modifiers.new("Build", "BUILD")
    build.frame_start, build.frame_duration = 1, 10
    read = read_scene(scene, passes=("flow_forward",))
    images = cast(read.camera, read.shapes, passes=("flow_forward", "shape_index"), dtype=float)
    here = images["shape_index"] == list(read.shapes.names).index("Suzanne")
    assert here.any()
    assert np.isnan(images["flow_forward"][here]).all()


def test_a_rolling_shutter_comes_with_the_motion_of_its_neighbors(scene):
    scene.camera.data.camera_ray_caster.time_mode = "ROLLING_SHUTTER"
    read = read_scene(scene, passes=BOTH)
    assert None not in (read.next.motion, read.previous.motion)
    images = cast(read.camera, read.shapes, passes=(*BOTH, "shape_index"), dtype=float)
    for name, image in cast(read, passes=BOTH, dtype=float).items():
        np.testing.assert_array_equal(images[name], image)
    hit = images["shape_index"] >= 0
    assert 5 < np.nanmax(images["flow_forward"][hit]) < 50
    assert np.isnan(images["flow_forward"][hit]).mean() < 0.3
