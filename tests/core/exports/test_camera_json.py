"""camera.json: what it holds makes the same rays, bit for bit."""

import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.camera.stereo import eye_record
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.motion.evaluations import resolve
from camera_ray_caster.core.records import no_shapes

from ..cameras.model_examples import BORDER, EXAMPLES, camera, raw_of
from .shots import CAMERAS, pose, shots

STEREO = {
    "views_format": "STEREO_3D", "convergence_mode": "OFFAXIS", "pivot": "CENTER", "interocular_distance": 0.065,
    "convergence_distance": 1.95, "use_spherical_stereo": False, "use_pole_merge": True,
    "pole_merge_angle_from": 1.0, "pole_merge_angle_to": 1.3,
}  # fmt: skip
LENS = {
    "use_dof": True, "focus_distance": 3.7, "aperture_fstop": 1.4, "aperture_blades": 5, "aperture_rotation": 0.3,
    "aperture_ratio": 1.7, "focus_position": None,
}  # fmt: skip
TIMES = {"time_mode": "ROWS", "time_start": 1.0, "time_end": 3.0, "time_tolerance": 0.1, "time_evaluations": 64}


def assert_same(left, right):
    """Every ray is the same in all its bits."""
    assert left.raster == right.raster
    here, there = left.rays(), right.rays()
    for name in ("origins", "directions", "valid", "time"):
        ours, theirs = getattr(here, name), getattr(there, name)
        assert (ours is None) == (theirs is None)
        assert ours is None or ours.tobytes() == theirs.tobytes()


@pytest.mark.parametrize("key", [model.key for model in MODELS])
def test_every_model_comes_back_bit_for_bit(key):
    for settings in EXAMPLES[key]:
        there = camera(key, {"matrix_world": pose(3), **settings})
        back = crc.camera_from_json(crc.camera_to_json(there))
        assert_same(there, back)
        assert (back.name, back.clip_start, back.clip_end) == (there.name, there.clip_start, there.clip_end)
        assert back.settings == there.settings


@pytest.mark.parametrize("view", ["left", "right"])
@pytest.mark.parametrize("spherical", [False, True])
def test_eyes_come_back(view, spherical):
    raw = raw_of("PERSP", STEREO | {"use_spherical_stereo": spherical, "matrix_world": pose(1)})
    eye = camera_from(eye_record(replace(raw, model=""), view))
    assert_same(eye, crc.camera_from_json(crc.camera_to_json(eye)))


def test_what_lets_rays_in_beside_the_chief_ray_comes_back():
    there = camera("PERSP", LENS | BORDER)
    back = crc.camera_from_json(crc.camera_to_json(there))
    assert back.aperture == there.aperture is not None
    x, y = there.raster.columns(), there.raster.rows()
    for ours, theirs in zip(there.sample_rays(x, y, 3), back.sample_rays(x, y, 3), strict=True):
        assert [array.tobytes() for array in map(np.asarray, ours)] == [
            array.tobytes() for array in map(np.asarray, theirs)
        ]


def timed(**settings):
    """A camera that turns while its rows are read."""

    def at(frame):
        turn = np.eye(4)
        turn[0, 0] = turn[2, 2] = math.cos(frame / 7)
        turn[0, 2], turn[2, 0] = math.sin(frame / 7), -math.sin(frame / 7)
        return camera("PERSP", TIMES | {"matrix_world": turn, "lens": 30.0 + frame, "frame": frame} | settings)

    now = at(2.0)
    clock = now.pixel_time
    motion = resolve(lambda frame: (at(frame), no_shapes()), clock.first, clock.last, 1e-3, 64)
    return replace(now, motion=motion)


def test_clocks_and_motion_come_back():
    there = timed()
    back = crc.camera_from_json(crc.camera_to_json(there))
    assert len(there.motion.states) > 4
    assert_same(there, back)
    assert_same(there.at(1.7), back.at(1.7))
    assert back.motion.in_words() == there.motion.in_words()
    point = there.pose.eye + there.rays_at(20.0, 30.0).directions * 5
    assert there.project(point).tobytes() == back.project(point).tobytes()


def test_a_time_image_comes_back():
    gray = np.random.default_rng(1).uniform(0, 1, (5, 7))
    there = timed(time_mode="IMAGE", time_image=gray)
    assert_same(there, crc.camera_from_json(crc.camera_to_json(there)))


def test_cameras_and_frames_are_found_and_what_they_share_is_said_once(tmp_path):
    shot = [*shots("radtan"), *shots("perspective", [1, 2.5])]
    ((name, text),), remarks = (list(items) for items in export_files("json", shot))
    path = tmp_path / name
    path.write_text(text)
    assert (name, remarks) == ("camera.json", [])
    for view in shot:
        assert_same(view.camera, crc.camera_from_json(path, frame=view.frame, camera=view.name))
        assert_same(view.camera, crc.camera_from_json(str(path), view.frame, camera=view.name))
    assert_same(shot[0].camera, crc.camera_from_json(text, camera="radtan"))
    assert len(re.findall(r'"resolution_x"', text)) == len(re.findall('"formula"', text)) == 2
    document = json.loads(text, parse_constant=pytest.fail)
    facts = document["cameras"][1]["all_frames"]["camera"]
    assert facts["K"] == shot[-1].camera.K.tolist()
    plane = np.array(facts["plane_from_pixels"]) @ (12.5, 7.25, 1)
    assert plane == pytest.approx([float(value) for value in shot[-1].camera.model.rays(12.5, 7.25)[1][:2]], rel=1e-14)


def test_the_zeros_of_a_matrix_keep_their_signs_and_what_is_no_number_stays_none():
    matrix = [[1.0, -0.0, 0, 0], [0, 1, 0.0, -0.0], [-0.0, 0, 1, 0], [0, 0, 0, 1]]
    cameras = [camera("PERSP", LENS | {"use_dof": False, "aperture_ratio": math.nan, "matrix_world": pose})
               for pose in (matrix, np.eye(4).tolist())]  # fmt: skip
    ((_, text),) = export_files("json", [Shot("Camera", frame, cam) for frame, cam in enumerate(cameras)])[0]
    json.loads(text, parse_constant=pytest.fail)
    for frame, cam in enumerate(cameras):
        back = crc.camera_from_json(text, frame)
        assert json.dumps(back.record.matrix_world) == json.dumps(cam.record.matrix_world)
        assert math.isnan(back.record.settings["aperture_ratio"])


def test_a_calibration_file_is_not_asked_for_again(tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text("1 OPENCV 640 480 301.25 299.5 322 239 -0.03 0.004 0.001 -0.002\n")
    there = camera("OPENCV_PINHOLE", CAMERAS["radtan"][1] | {"calibration_file": str(path)})
    text = crc.camera_to_json(there)
    path.unlink()
    assert_same(there, crc.camera_from_json(text))


GOOD = crc.camera_to_json(camera("PERSP"))


def without_frames(text):
    """The file with a camera that has no frame."""
    document = json.loads(text)
    document["cameras"][0]["frames"] = []
    return json.dumps(document)


@pytest.mark.parametrize(
    ("change", "asked", "says"),
    [
        (lambda text: text[:-9], {}, "is damaged"),
        (lambda text: "{}", {}, "neither a camera.json nor a report.json of the Camera"),
        (lambda text: text.replace('"format_version": 1', '"format_version": 2'), {}, "of version 2: update"),
        (lambda text: text.replace('"lens": 50.0', '"lens": -50.0'), {}, "lens of camera 'Camera' is -50"),
        (lambda text: text.replace('"lens": 50.0', '"lens": "wide"'), {}, "lens of camera 'Camera' is 'wide'"),
        (lambda text: text.replace('"clip_start"', '"clip_stop"'), {}, "is damaged"),
        (lambda text: text.replace('"matrix_world"', '"matrix"'), {}, "is damaged"),
        (lambda text: "missing.json", {}, "cannot read 'missing.json': No such file"),
        (lambda text: "\0", {}, "cannot read"),
        (lambda text: 3, {}, "cannot read"),
        (lambda text: without_frames(text), {}, "'Camera' has no frame in this file"),
        (lambda text: text, {"frame": 7}, "no frame 7 in this file: the nearest is 0"),
        (lambda text: text, {"frame": "first"}, "frame is 'first': it must be a number"),
        (lambda text: text, {"camera": "Side"}, "has the cameras 'Camera': set camera"),
        (lambda text: text, {"camera": 3}, "camera is 3: it must be a string"),
    ],
)  # fmt: skip
def test_what_is_no_camera_is_refused_in_one_line(change, asked, says):
    with pytest.raises(crc.InputError, match=says) as refusal:
        crc.camera_from_json(change(GOOD), **asked)
    assert "\n" not in str(refusal.value)
