"""Stereo eyes by hand geometry: where they stand, where they look, and what both see at the same place."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.camera.stereo import camera_name, eye_record
from camera_ray_caster.core.records import BlenderCamera, InputError

from ..cameras.model_examples import raw_of

DISTANCE, CONVERGENCE = 0.5, 4.0
SETTINGS = {
    "views_format": "STEREO_3D",
    "convergence_mode": "OFFAXIS",
    "pivot": "CENTER",
    "interocular_distance": DISTANCE,
    "convergence_distance": CONVERGENCE,
    "use_spherical_stereo": False,
    "panorama_type": "EQUIRECTANGULAR",
}


def raw(matrix=None, **settings):
    fields = {name: settings.pop(name) for name in ("type", "sensor_fit", "shift_x") if name in settings}
    matrix = np.eye(4) if matrix is None else matrix
    record = BlenderCamera("Camera", fields.pop("type", "PERSP"), matrix, resolution_x=400, resolution_y=200, **fields)
    return replace(record, sensor_height=18.0, settings=SETTINGS | settings)


def eyes(record):
    return [camera_from(eye_record(record, view)) for view in ("left", "right")]


@pytest.mark.parametrize("mode", ["OFFAXIS", "PARALLEL", "TOE"])
@pytest.mark.parametrize("pivot", ["CENTER", "LEFT", "RIGHT"])
def test_the_eyes_are_the_interocular_distance_apart(mode, pivot):
    left, right = eyes(raw(convergence_mode=mode, pivot=pivot))
    assert np.linalg.norm(right.pose.eye - left.pose.eye) == pytest.approx(DISTANCE, rel=1e-15)
    stays = {"CENTER": (left.pose.eye + right.pose.eye) / 2, "LEFT": left.pose.eye, "RIGHT": right.pose.eye}[pivot]
    assert stays == pytest.approx([0, 0, 0], abs=1e-16)
    assert left.pose.eye[0] < right.pose.eye[0]


@pytest.mark.parametrize("fit", ["HORIZONTAL", "AUTO"])
@pytest.mark.parametrize("pivot", ["CENTER", "LEFT", "RIGHT"])
def test_off_axis_frames_meet_at_the_convergence_distance(pivot, fit):
    """A window of the same size stands before both eyes: its points have no parallax."""
    left, right = eyes(raw(pivot=pivot, sensor_fit=fit, shift_x=0.1))
    points = np.array([(x, y, -CONVERGENCE) for x in (-1, 0, 0.7) for y in (-0.5, 0.4)])
    assert left.project(points) == pytest.approx(right.project(points), rel=1e-13)
    nearer = points * (1, 1, 0.5)
    assert (left.project(nearer)[:, 0] > right.project(nearer)[:, 0]).all()


LENS = {"fx": 210.0, "fy": 190.0, "cx": 201.0, "cy": 97.0, "skew": 3.0, "calibration_width": 300}
LENSES = {
    "in pixels": ("OPENCV_PINHOLE", LENS),
    "in millimeters": ("OPENCV_PINHOLE", {"calibration_unit": "MILLIMETERS"}),
    "inverted": ("CAMERA_OBSCURA", {"obscura_depth": 2.0, "obscura_width": 1.5}),
}


@pytest.mark.parametrize("name", LENSES)
@pytest.mark.parametrize("kind", ["PERSP", "PANO"])
def test_off_axis_frames_of_other_pinholes_meet_at_the_convergence_distance(name, kind):
    """Whatever the sensor fit and the type of the camera in Blender; the camera itself sees these points there, too."""
    key, settings = LENSES[name]
    record = replace(raw_of(key, SETTINGS | settings | {"sensor_fit": "VERTICAL"}), type=kind)
    left, right = eyes(record)
    points = np.array([(x, y, -CONVERGENCE) for x in (-1, 0, 0.7) for y in (-0.5, 0.4)])
    assert left.project(points) == pytest.approx(right.project(points), rel=1e-13)
    assert left.project(points) == pytest.approx(camera_from(record).project(points), rel=1e-13)
    assert np.abs(left.project(points / 2) - right.project(points / 2))[:, 0].min() > 1


@pytest.mark.parametrize("key", ["FISHEYE_STEREOGRAPHIC", "CYLINDRICAL", "OMNIMAX", "PENCIL", "UCM"])
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO", "PANO"])
def test_the_eyes_of_all_other_models_are_parallel(key, kind):
    """As Blender's panoramas are; an unused type of the camera in Blender changes nothing."""
    record = replace(raw_of(key, SETTINGS | {"shift_x": 0.1}), type=kind)
    for eye in eyes(record):
        assert np.array_equal(eye.rays().directions, camera_from(record).rays().directions, equal_nan=True)


@pytest.mark.parametrize("pivot", ["CENTER", "LEFT", "RIGHT"])
def test_toed_in_eyes_see_one_point_of_convergence_in_the_middle(pivot):
    """The base of an isosceles triangle with apex angle 2 atan(iod / (2 cv)) joins them."""
    left, right = eyes(raw(convergence_mode="TOE", pivot=pivot))
    middle = {"CENTER": (0, 0, -CONVERGENCE)}.get(pivot, (0, 0, -np.hypot(CONVERGENCE, DISTANCE / 2)))
    for eye in (left, right):
        assert eye.project(np.array(middle)) == pytest.approx((200, 100), rel=1e-13)


def test_parallel_eyes_look_where_the_camera_looks():
    left, right = eyes(raw(convergence_mode="PARALLEL"))
    assert np.array_equal(left.rays().directions, camera_from(raw()).rays().directions)
    assert np.array_equal(right.rays().directions, left.rays().directions)


def test_panoramas_take_no_shift_and_orthographic_cameras_do():
    panorama = raw(type="PANO", shift_x=0.25)
    assert eye_record(panorama, "left").shift_x == 0.25
    expected = 0.25 + DISTANCE / 2 / 36 * 50 / CONVERGENCE
    assert eye_record(raw(type="ORTHO", shift_x=0.25), "left").shift_x == pytest.approx(expected, rel=1e-15)


def test_distances_are_of_the_world_whatever_the_camera_is_scaled_by():
    matrix = np.diag((3.0, 0.5, 2.0, 1.0))
    assert eye_record(raw(matrix), "right").matrix_world[0, 3] == DISTANCE / 2


def test_the_camera_itself_is_the_empty_view():
    record = raw()
    assert eye_record(record, "") is record


@pytest.mark.parametrize(
    ("view", "settings", "message"),
    [
        ("middle", {}, "choose one of left, right"),
    ],
)
def test_what_is_no_eye_is_refused(view, settings, message):
    with pytest.raises(InputError, match=message):
        eye_record(raw(**settings), view)


def test_names_of_multi_view_cameras():
    suffixes = ["_L", "_R", "_far_R"]
    assert camera_name("Rig_L", "_R", suffixes) == "Rig_R"
    assert camera_name("Rig_far_R", "_L", suffixes) == "Rig_L"
    assert camera_name("Rig", "_L", suffixes) == "Rig"


@pytest.mark.parametrize("mode", ["OFFAXIS", "PARALLEL", "TOE"])
@pytest.mark.parametrize("shown", ["LEFT", "RIGHT"])
def test_a_camera_with_eyes_of_its_own_is_moved_once(mode, shown):
    """Straight ahead of an omnidirectional pair the eyes are half the distance beside the camera, and look ahead."""
    record = replace(raw(convergence_mode=mode, eye=shown), model="OMNIDIRECTIONAL_STEREO")
    for side, eye in zip((-1, 1), eyes(record), strict=True):
        rays = eye.rays_at(np.array([200.0]), np.array([100.0]))
        assert rays.origins[0] == pytest.approx([side * DISTANCE / 2, 0, 0], abs=1e-15)
        assert rays.directions[0] == pytest.approx([0, 0, -1], abs=1e-15)


@pytest.mark.parametrize("layout", ["TOP_BOTTOM", "SIDE_BY_SIDE"])
def test_both_eyes_in_one_picture_are_no_view_of_a_stereo_scene(layout):
    record = replace(raw(eye=layout), model="OMNIDIRECTIONAL_STEREO")
    with pytest.raises(InputError, match="both eyes in one picture: choose one eye, or disable Stereoscopy"):
        eye_record(record, "left")
    assert eye_record(record, "") is record
