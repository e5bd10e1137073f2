"""The rays of random cameras against what Blender answers, within the bounds it can reach, and faults that it finds."""

import itertools

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.camera_fields import camera_record
from camera_ray_caster.blender.read.scene_reader import evaluated, read_camera
from camera_ray_caster.blender.verification.blender_witness import ask
from camera_ray_caster.blender.verification.check import verify_camera
from camera_ray_caster.core.report.verification import verify

from ...core.report import seeded_faults

WITNESSES = ["view_frame", "calc_matrix_camera", "world_to_camera_view", "round trip"]
FITS = ["AUTO", "HORIZONTAL", "VERTICAL"]
FRAMES = [(1001, 667), (667, 1001), (512, 512)]
PIXELS = [(1.0, 1.0), (2.0, 1.0), (1.0, 1.8)]
SHIFTS = [(0.0, 0.0), (0.35, -1.2)]
PERCENTAGES = [100, 33]
BORDERS = [None, (0.31, 0.74, 0.07, 0.9)]
CASES = list(itertools.product(["PERSP", "ORTHO"], FITS, FRAMES, PIXELS, SHIFTS, PERCENTAGES, BORDERS))


def add_camera(bpy):
    """Add the scene's camera under two parents, so that its matrix can be any."""
    scene = bpy.context.scene
    parents = [bpy.data.objects.new(f"Parent {i}", None) for i in range(2)]
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    for child, parent in itertools.pairwise([camera, *parents]):
        child.parent = parent
    for item in (camera, *parents):
        scene.collection.objects.link(item)
    scene.camera = camera
    return scene, camera, parents


def set_random_pose(camera, parents, rng):
    """Give the camera a random pose: scales negative, not uniform, sheared by turned parents, or plain."""
    kind = rng.choice(["plain", "scaled", "sheared"])
    for item in (camera, *parents):
        item.rotation_euler = rng.uniform(-np.pi, np.pi, 3)
        item.scale = (1, 1, 1) if kind == "plain" else rng.uniform(0.4, 2, 3) * rng.choice([-1, 1], 3)
        if kind == "scaled" and item is not camera:
            item.rotation_euler = 0, 0, 0
    parents[-1].location = rng.normal(size=3) * 10 ** rng.uniform(-1, 2.5)


def set_up(scene, data, case):
    kind, fit, frame, pixel, shift, percentage, border = case
    render = scene.render
    data.type, data.sensor_fit = kind, fit
    render.resolution_x, render.resolution_y = frame
    render.pixel_aspect_x, render.pixel_aspect_y = pixel
    data.shift_x, data.shift_y = shift
    render.resolution_percentage = percentage
    render.use_border = border is not None
    if border:
        render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = border


@pytest.mark.parametrize("count", [60, pytest.param(520, marks=pytest.mark.full)])
def test_random_cameras_agree_with_blender_within_its_rounding(blender, count):
    scene, camera, parents = add_camera(blender)
    rng = np.random.default_rng(2024)
    data = camera.data
    ratios = []
    for case in (CASES * (1 + count // len(CASES)))[:: max(1, len(CASES) // count)][:count]:
        set_up(scene, data, case)
        set_random_pose(camera, parents, rng)
        data.lens, data.ortho_scale = 10 ** rng.uniform(0, 3.5), 10 ** rng.uniform(-2, 3)
        data.sensor_width, data.sensor_height = rng.uniform(4, 70, 2)
        data.clip_start = 10 ** rng.uniform(-4, 1)
        findings = verify_camera(scene)
        assert [finding.witness for finding in findings] == WITNESSES
        assert all(finding.passed for finding in findings), (case, findings)
        ratios.append([finding.worst_pixels / finding.bound_pixels for finding in findings])
    assert (np.median(ratios, axis=0) > 1e-3).all()  # a bound that nothing comes near would hold nothing


@pytest.mark.parametrize(("kind", "fault"), seeded_faults.CASES)
def test_every_fault_is_found(blender, kind, fault):
    scene, camera, parents = add_camera(blender)
    camera.data.type = kind
    for name, value in seeded_faults.HARD.items():
        setattr(scene.render if hasattr(scene.render, name) else camera.data, name, value)
    camera.location, camera.rotation_euler = (2, -3, 1), (1.1, 0.2, 0.4)
    parents[0].scale = 1, 0.6, 1.5
    with evaluated(scene) as depsgraph:
        raw = camera_record(camera, depsgraph)
        findings = verify(fault(raw), ask(camera, depsgraph))
    assert all(finding.passed for finding in verify_camera(scene))
    failed = {finding.witness for finding in findings if not finding.passed}
    assert failed >= set(WITNESSES[fault in seeded_faults.BETWEEN_THE_CORNERS : 3])


def test_the_scene_is_not_touched(blender):
    scene, camera, _ = add_camera(blender)
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 1000, 333, 10
    with evaluated(scene) as depsgraph:
        witness = ask(camera, depsgraph)
        assert witness.size == (100, 33)
        corner = witness.frame[0]
        assert abs(corner[0] / corner[1] - 100 / 33) < 1e-6  # not 1000 / 333
        with pytest.raises(ValueError, match="sequence"):
            witness.view_coordinates(np.zeros((1, 1)))
        assert depsgraph.scene_eval.render.resolution_x == 1000
    assert (scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage) == (1000, 333, 10)


@pytest.mark.parametrize("percentage", [1, 25, 100])
def test_frames_smaller_than_blender_s_settings_reach(blender, percentage):
    scene, camera, _ = add_camera(blender)
    scene.render.resolution_x, scene.render.resolution_y = 300, 100
    scene.render.resolution_percentage = percentage
    assert all(finding.passed for finding in verify_camera(scene))
    with evaluated(scene) as depsgraph:
        assert ask(camera, depsgraph).size == (300 * percentage // 100, percentage)


def test_another_frame_and_another_camera(blender):
    scene, camera, _ = add_camera(blender)
    other = camera.copy()
    scene.collection.objects.link(other)
    camera.keyframe_insert("location", frame=1)
    camera.location.x = 100
    camera.keyframe_insert("location", frame=11)
    camera.data.keyframe_insert("lens", frame=1)
    camera.data.lens = 200
    camera.data.keyframe_insert("lens", frame=11)
    for arguments in ({"frame": 6.5}, {"camera_object": other}, {"camera_object": other, "frame": 3}):
        findings = verify_camera(scene, **arguments)
        assert [finding.witness for finding in findings] == WITNESSES
        assert all(finding.passed for finding in findings)


def test_blender_is_no_witness_for_a_panorama(blender):
    scene, camera, _ = add_camera(blender)
    camera.data.type = "PANO"
    with evaluated(scene) as depsgraph:
        assert ask(camera, depsgraph) is None
    assert read_camera(scene).model.key == camera.data.panorama_type
    (finding,) = verify_camera(scene)
    assert finding.witness == "round trip"
    assert finding.passed


@pytest.mark.parametrize("percentage", [100, 50])
def test_a_moving_camera_among_keyed_visibility_is_verified(camera_scene, percentage):
    """Blender 4.5 and 5.0 crashed."""
    bpy.ops.mesh.primitive_cube_add(location=(0, 0, -6))
    item, scene = bpy.context.object, camera_scene
    for frame, hidden in ((1, False), (2, True)):
        item.hide_render = hidden
        item.keyframe_insert("hide_render", frame=frame)
    scene.render.resolution_percentage = percentage
    scene.camera.data.camera_ray_caster.time_mode = "ROWS"
    assert all(finding.passed for finding in verify_camera(scene))
