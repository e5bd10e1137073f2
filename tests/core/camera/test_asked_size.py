"""The frames that cameras ask for, by hand: angles and lengths of a picture over those of its frame."""

import numpy as np
import pytest

from camera_ray_caster.core.camera.asked_size import asked_size
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import raw_of

PI = float(np.float32(np.pi))
WIDE = {"resolution_x": 1920, "resolution_y": 1080, "resolution_percentage": 100}
OWN = {
    "half a turn high, a turn wide": ("EQUIRECTANGULAR", {}, (1920, 960)),
    "half a turn, square": ("EQUIRECTANGULAR", {"longitude_min": -PI / 2, "longitude_max": PI / 2}, (1080, 1080)),
    "a circle": ("FISHEYE_EQUIDISTANT", {}, (1080, 1080)),
    "a ball": ("MIRRORBALL", {}, (1080, 1080)),
    "a face of a cube": ("EQUIANGULAR_CUBEMAP_FACE", {}, (1080, 1080)),
    "two eyes, one above the other": ("OMNIDIRECTIONAL_STEREO", {"eye": "TOP_BOTTOM"}, (1080, 1080)),
    "two eyes side by side": ("OMNIDIRECTIONAL_STEREO", {"eye": "SIDE_BY_SIDE"}, (1920, 480)),
    "a cylinder": ("CENTRAL_CYLINDRICAL", {"central_cylindrical_radius": 2 / PI}, (1920, 960)),
}  # fmt: skip
ANY = ("PERSP", "ORTHO", "FISHEYE_EQUISOLID", "FISHEYE_STEREOGRAPHIC", "DOME_MASTER", "OMNIMAX", "CROSS_SLIT")


@pytest.mark.parametrize("case", OWN)
def test_in_its_own_frame_a_picture_is_not_stretched(case):
    """Beside the middle of an eye's picture a ray turns as much to the right as upwards."""
    key, settings, size = OWN[case]
    asked = asked_size(raw_of(key, WIDE | settings))
    assert (asked.width, asked.height) == size
    assert "1920 × 1080" in asked.sentence
    assert f"{size[0]} × {size[1]}" in asked.sentence
    raw = raw_of(key, WIDE | settings | dict(zip(("resolution_x", "resolution_y"), size, strict=True)))
    assert asked_size(raw) is None
    side, eyes = 1e-3, settings.get("eye")
    x = size[0] / (4 if eyes == "SIDE_BY_SIDE" else 2)
    y = size[1] / (4 if eyes == "TOP_BOTTOM" else 2)
    rays = camera_from(raw).rays_at(np.array([x, x + side, x]), np.array([y, y, y + side])).directions
    right, up = np.linalg.norm(rays[1:] - rays[0], axis=1)
    assert right == pytest.approx(up, rel=2 / min(size))  # a side is rounded to a pixel


@pytest.mark.parametrize("key", ANY)
def test_a_model_that_fits_any_frame_asks_for_none(key):
    for size in ((1920, 1080), (300, 1000)):
        raw = raw_of(key, WIDE | dict(zip(("resolution_x", "resolution_y"), size, strict=True)))
        assert asked_size(raw) is None


def test_pixels_that_are_twice_as_high_make_a_frame_twice_as_wide():
    size = asked_size(raw_of("EQUIRECTANGULAR", WIDE | {"pixel_aspect_y": 2.0}))
    assert (size.width, size.height) == (1920, 480)


def test_a_calibrated_picture_has_its_own_size():
    lens = WIDE | {"calibration_width": 1241, "calibration_height": 376}
    size = asked_size(raw_of("OPENCV_PINHOLE", lens))
    assert (size.width, size.height) == (1241, 376)
    for others in (
        {"resolution_x": 1241, "resolution_y": 376, "resolution_percentage": 37},
        {"calibration_width": 0},
        {"calibration_unit": "MILLIMETERS"},
        {"pixel_aspect_y": 2.0},
    ):
        assert asked_size(raw_of("OPENCV_PINHOLE", lens | others)) is None


def test_a_file_has_the_size_of_its_pictures(tmp_path):
    path = tmp_path / "cameras.txt"
    path.write_text("1 PINHOLE 96 54 70 70 48 27\n2 PINHOLE 50 54 70 70 48 27\n")
    lens = WIDE | {"calibration_file": str(path), "calibration_camera": "2"}
    assert asked_size(raw_of("OPENCV_PINHOLE", lens))[:2] == (50, 54)
    assert asked_size(raw_of("OPENCV_PINHOLE", lens | {"calibration_camera": "1"})) is None
    with pytest.raises(InputError, match="has 2 cameras"):
        asked_size(raw_of("OPENCV_PINHOLE", lens | {"calibration_camera": ""}))
