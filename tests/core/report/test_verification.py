"""Verification passes what is right and finds what is wrong, against witnesses that are made here in float32."""

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.maths.rotations import rotation
from camera_ray_caster.core.records import BlenderCamera
from camera_ray_caster.core.report.verification import verify

from ..cameras.model_examples import EXAMPLES, camera
from .seeded_faults import BETWEEN_THE_CORNERS, CASES, HARD, Bent, half_a_pixel_in_x, half_a_pixel_in_y

F = np.float32
SHEARED = np.array([[0.4, 0.5, -0.7, 3], [-0.8, 0.6, 0.1, -2], [0.5, 0.6, 0.6, 7], [0, 0, 0, 1]], F).astype(float)
KEYS = [model.key for model in MODELS]
WITNESSES = ["view_frame", "calc_matrix_camera", "world_to_camera_view"]


class FloatWitness:
    """Where a camera of film and lens sees points, all in float32: similar triangles, nothing of the caster's.

    The film lies one unit behind the lens, or for parallel rays on the camera's plane.
    """

    def __init__(self, raw):
        self.size = tuple(side * raw.resolution_percentage // 100 for side in (raw.resolution_x, raw.resolution_y))
        self.matrix_world = np.array(raw.matrix_world)
        sides = F(self.size[0]) * F(raw.pixel_aspect_x), F(self.size[1]) * F(raw.pixel_aspect_y)
        fitted = {"HORIZONTAL": sides[0], "VERTICAL": sides[1], "AUTO": max(sides)}[raw.sensor_fit]
        sensor = F(raw.sensor_height if raw.sensor_fit == "VERTICAL" else raw.sensor_width)
        self.central = raw.type == "PERSP"
        length = sensor / F(raw.lens) if self.central else F(raw.ortho_scale)
        half = [side / fitted * length / F(2) for side in sides]
        middle = [F(shift) * length for shift in (raw.shift_x, raw.shift_y)]
        self.low = np.array([m - h for m, h in zip(middle, half, strict=True)])
        self.high = np.array([m + h for m, h in zip(middle, half, strict=True)])
        (left, bottom), (right, top) = self.low, self.high
        self.frame = np.array([(right, top, -1), (right, bottom, -1), (left, bottom, -1), (left, top, -1)], float)
        scale, offset = F(2) / (self.high - self.low), (self.high + self.low) / (self.high - self.low)
        column = 2 if self.central else 3
        self.matrix = np.zeros((4, 4))
        self.matrix[[0, 1], [0, 1]] = scale
        self.matrix[:2, column] = offset if self.central else -offset
        self.matrix[2:, 2:] = [[-1, -0.2], [-1, 0]] if self.central else [[-0.1, -1], [0, 1]]

    def view_coordinates(self, points):
        assert points.dtype == F
        axes = self.matrix_world[:3, :3].astype(F)
        axes = axes / np.sqrt((axes * axes).sum(axis=0))
        local = (points - self.matrix_world[:3, 3].astype(F)) @ np.linalg.inv(axes).T
        depth = -local[:, 2:]
        plane = local[:, :2] / depth if self.central else local[:, :2]
        return np.concatenate(((plane - self.low) / (self.high - self.low), depth), axis=1).astype(float)


def raw_camera(kind, **settings):
    return BlenderCamera(**{"name": "Camera", "type": kind, "matrix_world": SHEARED, **settings})


def random_camera(rng, kind):
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    matrix = np.eye(4)
    matrix[:3, :3] = rotation @ (np.eye(3) + rng.choice([0, 0.3]) * rng.normal(size=(3, 3)))
    matrix[:3, 3] = rng.normal(size=3) * 10 ** rng.uniform(-1, 3)
    wide, high = rng.integers(4, 5000, 2)
    return raw_camera(
        kind,
        matrix_world=matrix.astype(F).astype(float),
        lens=float(F(10 ** rng.uniform(0, 3.5))),
        ortho_scale=float(F(10 ** rng.uniform(-2, 3))),
        sensor_fit=str(rng.choice(["AUTO", "HORIZONTAL", "VERTICAL"])),
        shift_x=float(F(rng.uniform(-2, 2))),
        shift_y=float(F(rng.uniform(-2, 2))),
        resolution_x=int(wide),
        resolution_y=int(high),
        pixel_aspect_x=float(F(rng.uniform(1, 3))),
    )


each_kind = pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])


@each_kind
def test_right_cameras_pass_and_bounds_are_not_idle(kind):
    rng = np.random.default_rng(20)
    ratios = []
    for _ in range(60):
        raw = random_camera(rng, kind)
        findings = verify(camera_from(raw), FloatWitness(raw))
        assert [finding.witness for finding in findings] == [*WITNESSES, "round trip"]
        assert all(finding.passed for finding in findings), findings
        ratios.append([finding.worst_pixels / finding.bound_pixels for finding in findings])
    assert (np.median(ratios, axis=0) > 1e-3).all()


@pytest.mark.parametrize(("kind", "fault"), CASES)
def test_every_fault_is_found(kind, fault):
    raw = raw_camera(kind, **HARD)
    witness = FloatWitness(raw)
    assert all(finding.passed for finding in verify(camera_from(raw), witness))
    failed = [finding.witness for finding in verify(fault(raw), witness) if not finding.passed]
    assert set(failed) >= set(WITNESSES[fault in BETWEEN_THE_CORNERS :])


@each_kind
@pytest.mark.parametrize("fault", [half_a_pixel_in_x, half_a_pixel_in_y])
def test_half_a_pixel_of_4096_is_found_by_every_witness(kind, fault):
    raw = raw_camera(kind, resolution_x=4096, resolution_y=4096)
    findings = verify(fault(raw), FloatWitness(raw))
    assert [finding.passed for finding in findings] == [False, False, False, True]
    assert [round(finding.worst_pixels, 2) for finding in findings[:3]] == [0.5] * 3


@pytest.mark.parametrize(
    ("key", "settings"),
    [pytest.param(key, row, id=f"{key}-{i}") for key in KEYS for i, row in enumerate(EXAMPLES.get(key, ()))],
)
def test_a_camera_without_a_witness_goes_to_the_world_and_back(key, settings):
    (finding,) = verify(camera(key, settings))
    assert finding.witness == "round trip"
    assert finding.points > 0
    assert finding.passed
    assert finding.bound_pixels < 1e-9


@pytest.mark.parametrize("key", KEYS)
def test_a_projection_that_is_no_inverse_is_found_without_a_witness(key):
    right = camera(key)
    wrong = Bent(right, lambda x, y: (x, y), lambda x, y: (x + 1e-6, y))
    assert not verify(wrong)[0].passed


@pytest.mark.parametrize(("eye", "share"), [("TOP_BOTTOM", 5 / 9), ("SIDE_BY_SIDE", 4 / 9)])
def test_a_point_that_both_eyes_see_may_come_back_to_the_other_one(eye, share):
    """One of the eyes has the pixel; of 9 x 9 pixels its half holds those on this side of the middle row or column."""
    right = camera("OMNIDIRECTIONAL_STEREO", {"eye": eye, "resolution_x": 64, "resolution_y": 64})
    (finding,) = verify(right)
    assert finding.passed
    assert finding.points == round(81 * share)
    wrong = Bent(right, lambda x, y: (x, y), lambda x, y: (x + 1e-6, y))
    assert not verify(wrong)[0].passed


def test_a_ray_that_is_missing_fails_where_there_is_a_witness():
    raw = raw_camera("PERSP")
    blind = Bent(camera_from(raw), lambda x, y: (np.where(x < 300, np.nan, x), y), lambda x, y: (x, y))
    findings = verify(blind, FloatWitness(raw))
    assert [finding.passed for finding in findings] == [False, False, False, True]


def test_far_from_the_world_s_origin_float32_sees_little_and_says_so():
    near, far = np.eye(4), np.eye(4)
    far[:3, 3] = 2.0**20, 0, 0
    bounds = []
    for matrix in (near, far):
        raw = raw_camera("ORTHO", matrix_world=matrix)
        findings = {finding.witness: finding for finding in verify(camera_from(raw), FloatWitness(raw))}
        assert all(finding.passed for finding in findings.values())
        bounds.append(findings["world_to_camera_view"].bound_pixels)
    assert bounds[0] < 0.5 < bounds[1]


def test_pixels_at_a_rim_have_neighbors_on_one_side_only():
    """Of all pixels of a round picture some lie so near to its rim that their neighbors to the right have no ray."""
    (finding,) = verify(camera("FISHEYE_EQUIDISTANT", {"resolution_x": 128, "resolution_y": 128}), grid=128)
    assert finding.points > 128 * 128 * 3 / 4
    assert finding.passed, finding


def test_one_pixel_is_enough():
    raw = raw_camera("PERSP", resolution_x=1, resolution_y=1)
    findings = verify(camera_from(raw), FloatWitness(raw))
    assert all(finding.passed for finding in findings)
    assert findings[-1].points == 1


def test_a_window_without_rays_has_nothing_to_err():
    corner = {"use_border": True, "border_max_x": 0.05, "border_max_y": 0.05}
    (finding,) = verify(camera("FISHEYE_EQUIDISTANT", corner))
    assert (finding.points, finding.worst_pixels, finding.passed) == (0, 0.0, True)


def test_a_pixel_whose_ray_bends_so_much_that_no_other_has_one_is_rounded_as_all_are():
    """The middle one, which no distortion moves: it comes back to a unit of its last place."""
    lens = {"k1": -1e30, "cx": 960.0, "cy": 540.0, "fx": 1500.0, "fy": 1500.0}
    size = {"calibration_width": 0, "calibration_height": 0, "resolution_x": 1921, "resolution_y": 1081}
    off = 0.0
    for turn in np.linspace(0, 3, 40):
        matrix = np.eye(4)
        matrix[:3, :3] = rotation(np.array([[turn, 0.3, turn / 2]]))[0]
        matrix[:3, 3] = 7.36, -6.93, 4.96
        (finding,) = verify(camera("OPENCV_PINHOLE", lens | size | {"matrix_world": matrix}))
        assert finding.points == 1
        assert finding.passed, finding
        off = max(off, finding.worst_pixels)
    assert off > 0


@pytest.mark.full
def test_slits_that_are_far_away_are_rounded_as_far_points_are():
    """A cross-slit camera's, whose ends lie anywhere up to 1e5 from it."""
    rng = np.random.default_rng(1)
    examples = [settings for settings in EXAMPLES["CROSS_SLIT"] if {"slit_1", "slit_2"} <= set(settings)]
    for settings in examples * 30:
        off = rng.normal(size=3) * 10 ** rng.uniform(0, 5)
        slits = {name: tuple(tuple(np.add(end, off)) for end in settings[name]) for name in ("slit_1", "slit_2")}
        (finding,) = verify(camera("CROSS_SLIT", settings | slits))
        assert finding.points > 0
        assert finding.passed, finding
