"""What a picture of many times leaves behind: the frame, the report, a warning, one line where a setting is wrong."""

import numpy as np
import pytest

from camera_ray_caster.blender.output import reports
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.records import InputError

from .scene_parts import new_object
from .time_scene import coordinates, disc, fan, key, same, walked


def test_what_is_not_resolved_is_warned_of_and_in_the_report(blender, scene, capfd):
    fan(blender, 500)
    settings = scene.camera.data.camera_ray_caster
    settings.time_evaluations = 20
    blender.ops.render.render()
    assert "Warning: NOT RESOLVED" in "".join(capfd.readouterr())
    lines = reports.latest().motion
    assert any(line.startswith("NOT RESOLVED") for line in lines)
    assert "from 20 evaluations" in lines[0]
    assert scene.frame_current == 7


def test_evaluations_that_are_counted_are_those_that_were_made(blender, scene, sphere):
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7)
    seen = []
    count = lambda scene, *_: seen.append(scene.frame_current_final)  # noqa: E731
    blender.app.handlers.frame_change_post.append(count)
    try:
        blender.ops.render.render()
    finally:
        blender.app.handlers.frame_change_post.remove(count)
    stated = int(reports.latest().motion[0].split(" from ")[1].split()[0])
    assert 3 <= stated <= len(set(seen)) <= stated + 6  # beside: the checks, the frame before and after


@pytest.mark.cases(1)
@pytest.mark.parametrize("subframe", [0.0, 0.25])
def test_the_frame_is_put_back(blender, scene, sphere, subframe, monkeypatch):
    from camera_ray_caster.blender.read import evaluated

    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7, subframe=subframe)
    matrix = sphere.matrix_world.copy()
    walked(scene)
    assert (scene.frame_current, scene.frame_subframe) == (7, subframe)
    blender.ops.render.render()
    assert (scene.frame_current, scene.frame_subframe) == (7, subframe)
    assert sphere.matrix_world == matrix

    def fail(*_):
        raise InputError("this frame cannot be read")

    monkeypatch.setattr(evaluated, "shapes_record", fail)
    with pytest.raises(InputError):
        read_camera(scene)
    assert (scene.frame_current, scene.frame_subframe) == (7, subframe)
    with pytest.raises(RuntimeError, match="cannot be read"):
        blender.ops.render.render()
    assert (scene.frame_current, scene.frame_subframe) == (7, subframe)
    with pytest.raises(RuntimeError, match="cannot be read"):
        blender.ops.camera_ray_caster.cast()
    assert (scene.frame_current, scene.frame_subframe) == (7, subframe)
    assert sphere.matrix_world == matrix


def test_markers_that_bind_cameras_neither_change_the_eye_nor_stay(blender, scene, sphere):
    key(sphere, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7)
    other = new_object("Other", blender.data.cameras.new("Other"))
    other.location = (50, 0, 10)
    first = scene.camera
    for name, frame, camera in (("first", 1, first), ("other", 13, other)):
        scene.timeline_markers.new(name, frame=frame).camera = camera
    x, y, frame = coordinates()
    hit, unsure = disc(x, y, (frame - 13) / 4)
    same(walked(scene)["shape_index"] == 0, hit, unsure)
    assert scene.camera == first
    blender.ops.render.render()
    assert scene.camera == first


@pytest.mark.cases(1)
@pytest.mark.parametrize("hide", ["hide_viewport", "hide_render", "not active"])
def test_a_camera_that_is_hidden_or_not_the_active_one(blender, scene, sphere, hide):
    key(scene.camera, "location", (1, -3.0), (25, 3.0), index=0)
    scene.frame_set(7)
    expected = read_camera(scene).rays().origins
    assert np.ptp(expected[:, 0, 0]) == pytest.approx(6.0 * 47 / 48, abs=1e-5)
    camera = scene.camera
    scene.camera = new_object("Other", blender.data.cameras.new("Other"))
    if hide != "not active":
        setattr(camera, hide, True)
    cam = read_camera(scene, camera_object=camera)
    assert np.array_equal(cam.rays().origins, expected)
    assert scene.camera.name == "Other"
    assert scene.frame_current == 7


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"time_mode": "IMAGE"}, "image"),
        ({"time_end": 1.0}, "time_start and time_end"),
        ({"time_end": float("inf")}, "time_end"),
    ],
)
def test_bad_settings_are_one_line_and_change_nothing(blender, scene, sphere, settings, message, capfd):
    for name, value in settings.items():
        setattr(scene.camera.data.camera_ray_caster, name, value)
    with pytest.raises(InputError, match=message):
        read_camera(scene)
    with pytest.raises(InputError, match=message):
        read_shapes(scene)
    with pytest.raises(RuntimeError, match=message) as error:
        blender.ops.render.render()
    assert len(str(error.value).strip().splitlines()) == 1
    assert "Traceback" not in "".join(capfd.readouterr())
    assert scene.frame_current == 7


@pytest.mark.full
def test_the_round_trip_holds_for_a_camera_that_moves(blender, scene, sphere):
    from camera_ray_caster.blender.verification.check import verify_camera

    key(scene.camera, "location", (1, -3.0), (25, 3.0), index=0)
    key(scene.camera, "rotation_euler", (1, 0.0), (25, 0.4), index=2)
    scene.frame_set(7)
    findings = verify_camera(scene)
    assert [finding.witness for finding in findings][1:] == ["calc_matrix_camera", "world_to_camera_view", "round trip"]
    assert all(finding.passed for finding in findings)
    assert findings[-1].points == 4
    assert findings[-1].worst_pixels < 1e-9
