"""Pixels that ``project`` returns see the point: of a model with a wrong inverse, and of cameras at their limits."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cameras import MODELS, find_model
from camera_ray_caster.core.cameras.perspective import Perspective
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import EXAMPLES, TURNED, camera, raw_of

SIZES = (24, 18), (1, 1), (1, 40), (65536, 1)


@dataclass(frozen=True)
class AlmostRight(Perspective):
    """An inverse that is a thousandth of a pixel beside the point."""

    def project(self, points):
        return super().project(points) + 1e-3


@dataclass(frozen=True)
class WrongSide(Perspective):
    """An inverse that also sees what is behind the camera."""

    def project(self, points):
        return super().project(points * (1, 1, -1))


def replaced(cam, kind):
    """The camera with the fields of its model in another class."""
    return type(cam)(**{**vars(cam), "model": kind(**vars(cam.model))})


def test_an_inverse_that_is_almost_right_is_brought_to_the_point():
    cam = camera("PERSP", {"matrix_world": TURNED})
    x, y = np.random.default_rng(1).uniform(0, 50, (2, 300))
    rays = cam.rays_at(x, y)
    pixels = replaced(cam, AlmostRight).project(rays.origins + 7 * rays.directions)
    assert np.abs(pixels - np.stack((x, y), axis=-1)).max() <= 1e-10


def test_an_inverse_that_is_wrong_gives_no_pixel():
    cam = camera("PERSP", {"matrix_world": TURNED})
    rays = cam.rays_at(*np.random.default_rng(1).uniform(0, 50, (2, 300)))
    points = rays.origins - 7 * rays.directions
    assert not np.isnan(WrongSide(**vars(cam.model)).project((points - cam.pose.eye) @ cam.pose.basis)).any()
    assert np.isnan(replaced(cam, WrongSide).project(points)).all()


def test_the_middle_of_a_wide_frame_is_found_to_the_rounding_of_its_coordinate():
    """x = 2048 is known to 4e-13 pixels of 6 units each, and its offset from the middle is not rounded at all."""
    cam = camera("ORTHO", {"resolution_x": 4096, "resolution_y": 1, "sensor_fit": "VERTICAL", "matrix_world": TURNED})
    points = np.asarray(cam.rays_at(2048 + np.linspace(-1e-9, 1e-9, 50), 0.5).origins) - [[0, 0, 0.3]]
    assert not np.isnan(cam.project(points)).any()


LIMITS = {
    "straight behind the eye": ("FISHEYE_EQUISOLID", {"sensor_fit": "VERTICAL", "sensor_height": 48.0,
                                                      "pixel_aspect_x": 2.0, "fisheye_fov": 2 * np.pi}),
    "picture below rounding": ("REAL_LENS", {"sensor_width": 1e-20, "matrix_world": TURNED}),
    "slit in the image plane": ("PUSHBROOM", {"sensor_width": 1e-45}),
    "no length along the slit": ("PUSHBROOM", {"ortho_scale": 1e-45}),
    "eye far along the slit": ("PENCIL", {"pencil_slide": 16777216.0}),
    "eye out of this world": ("PENCIL", {"pencil_slide": -1e152}),
    "steep rays": ("GENERAL_LINEAR", {"ray_1": (-0.195, 0.474, -0.428, 1e30)}),
    "wide frame": ("TWISTED_ORTHOGRAPHIC", {"ortho_scale": 2.0**30, "twist": 0.334}),
    "thin tube": ("CENTRAL_CYLINDRICAL", {"central_cylindrical_radius": 1e-45}),
    "narrow fisheye in a row": ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 1e-38, "matrix_world": TURNED}),
    "rows at 90 degrees": ("EQUIANGULAR_CUBEMAP_FACE", {"shift_y": -1.0, "matrix_world": TURNED}),
    "columns at 90 degrees": ("EQUIANGULAR_CUBEMAP_FACE", {"shift_x": 0.5, "matrix_world": TURNED}),
    "constant polynomial": ("OCAM", {"ocam_polynomial": "-1e-30"}),
    "lens of no length": ("OPENCV_PINHOLE", {"calibration_unit": "MILLIMETERS", "lens": 1e-45, "p1": 0.4, "k3": 0.1}),
    "sensor of no height": ("FISHEYE_LENS_POLYNOMIAL", {"sensor_height": 1e-45, "sensor_fit": "VERTICAL",
                                                        "fisheye_polynomial_k0": -2e-5, "matrix_world": TURNED}),
    "huge coefficient": ("FISHEYE_LENS_POLYNOMIAL", {"fisheye_polynomial_k4": 3.4e38, "sensor_width": 1e30}),
    "huge plane": ("UCM", {"calibration_unit": "MILLIMETERS", "sensor_width": 1e152, "k2": 0.5, "p1": 0.1}),
    "huge ellipsoid": ("EUCM", {"calibration_unit": "MILLIMETERS", "sensor_height": 1e7, "sensor_fit": "VERTICAL"}),
}  # fmt: skip


@pytest.mark.parametrize("size", SIZES, ids=str)
@pytest.mark.parametrize("case", LIMITS)
def test_at_its_limits_a_camera_agrees_with_itself_or_is_refused(case, size):
    key, given_settings = LIMITS[case]
    check(raw_of(key, {"resolution_x": size[0], "resolution_y": size[1], **given_settings}))


def numbers_of(setting):
    """A strategy for a setting over its whole declared range; None for one that the examples give."""
    if setting.kind in ("FLOAT", "INT"):
        low, high = (float(np.float32(np.clip(end, -3.4e38, 3.4e38))) for end in (setting.low, setting.high))
        near = st.integers(-2, 2).map(lambda k: float(setting.default) * 2.0**k).filter(lambda v: low <= v <= high)
        every = st.integers(int(low), int(min(high, 1e6))) if setting.kind == "INT" else st.floats(low, high, width=32)
        return near.map(int) | every if setting.kind == "INT" else near | every
    if setting.kind == "VECTOR":
        return st.tuples(*(st.floats(-2, 2) for _ in setting.default)) | st.tuples(
            *(st.floats(width=32, allow_nan=False, allow_infinity=False) for _ in setting.default)
        )
    if setting.kind == "ENUM":
        return st.sampled_from([item.key for item in setting.items])
    return st.booleans() if setting.kind == "BOOLEAN" else None


@st.composite
def records(draw, key):
    """A record of a model: some of its settings anywhere in their declared range, the rest as in an example."""
    chosen = dict(draw(st.sampled_from(EXAMPLES[key])))
    raw = raw_of(key, chosen)
    declared = {setting.name: setting for setting in find_model(raw).SETTINGS}
    for name in draw(st.lists(st.sampled_from(sorted(declared)), max_size=3, unique=True)) if declared else ():
        strategy = numbers_of(declared[name])
        if strategy is not None:
            chosen[name] = draw(strategy)
    chosen["resolution_x"], chosen["resolution_y"] = draw(st.sampled_from(SIZES))
    return raw_of(key, chosen)


def drawn(count):
    """The test of one model on ``count`` records."""

    def test(key):
        settings(max_examples=count, deadline=None, database=None, derandomize=True)(given(records(key))(check))()

    return test


test_a_camera_agrees_with_itself_or_is_refused = pytest.mark.parametrize("key", [model.key for model in MODELS])(
    drawn(5)
)
test_many_cameras_agree_with_themselves_or_are_refused = pytest.mark.hostile(
    pytest.mark.parametrize("key", [model.key for model in MODELS])(drawn(100))
)


def built(raw):
    """The camera of a record; None if it is refused, which must be in one line."""
    try:
        return camera_from(raw)
    except InputError as error:
        refused = str(error).splitlines()
    assert len(refused) == 1
    return None


def check(raw):
    """Hold rays, inverse, derivatives and bounds of a camera against each other. A warning fails (see pyproject)."""
    cam = built(raw)
    if cam is None:
        return
    x, y = (np.random.default_rng(3).integers(0, side, 60) + 0.5 for side in cam.raster.size)
    rays = cam.rays_at(x, y)
    x, y, origins, directions = (array[rays.valid] for array in (x, y, rays.origins, rays.directions))
    size = 1 + np.abs(origins).max(initial=0.0)
    points = origins + directions
    pixels = cam.project(points)
    lost = np.isnan(pixels).any(axis=-1)
    if cam.model.smooth and size < 1e6:
        across, up, behind = np.linalg.solve(cam.pose.basis, directions.T)
        singular = (np.hypot(across, up) <= 4 * EPS) & (behind > 0)  # a whole circle of pixels sees what is behind
        assert not (lost & ~singular).any()
    seen = cam.rays_at(*pixels[~lost].T)
    assert seen.valid.all()
    towards = points[~lost] - seen.origins
    beside = np.linalg.norm(np.cross(towards, seen.directions), axis=-1)
    assert (beside <= (1e-6 + 1e-10 * size) * np.linalg.norm(towards, axis=-1) + 1e-13 * size).all()
    around = [cam.rays_at(x + across, y + up).valid for across, up in ((0.01, 0), (-0.01, 0), (0, 0.01), (0, -0.01))]
    smooth = np.all(around, axis=0) & ~((x == cam.raster.width / 2) & (y == cam.raster.height / 2))  # no rim, no axis
    if cam.model.differentiable:
        assert np.isfinite(cam.rays_jacobian_at(x, y).directions[smooth]).all()
    if size < 1e6:
        local = np.linalg.solve(cam.pose.basis, (points - cam.pose.eye).T).T
        x0, x1, y0, y1 = cam.model.bounds(local, np.full(len(local), 1e-3)).T
        own_x, own_y = pixels.T
        # rounding of a point in the world may be more than the whole picture of a sensor of 1e-20 mm
        inside = ((pixels >= 0) & (pixels <= cam.raster.size)).all(axis=-1)
        assert (~inside | ((x0 <= own_x) & (own_x <= x1) & (y0 <= own_y) & (own_y <= y1))).all()
