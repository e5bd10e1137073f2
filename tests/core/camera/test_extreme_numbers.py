"""Numbers at the ends of float32: a camera is right with them, or refused in one line that names the number."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.report.verification import verify

from ..cameras.model_examples import raw_of

TINY, HUGE, MOST = 1e-38, 1e30, float(np.finfo(np.float32).max)
SMALL = {"resolution_x": 37, "resolution_y": 23}


def placed(scale=1.0, location=0.0):
    """A world matrix that is turned, scaled and moved, in float32 as Blender has it."""
    c, s = np.cos(1.0), np.sin(1.0)
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) * scale
    matrix[:3, 3] = location
    return matrix.astype(np.float32).astype(float)


def camera_of(kind, settings):
    """The camera; its matrix does not move slits and path with it."""
    raw = raw_of(kind, {**SMALL, **{name: value for name, value in settings.items() if name != "matrix_world"}})
    return camera_from(replace(raw, matrix_world=settings.get("matrix_world", np.eye(4))))


@pytest.mark.parametrize(
    ("kind", "settings", "message"),
    [
        ("PERSP", {"lens": HUGE, "matrix_world": placed()}, "cannot be distinguished: lens is 1e.30"),
        ("PERSP", {"lens": float("inf")}, "lens .* is inf"),
        ("PERSP", {"sensor_width": HUGE}, "along the image plane, .*: sensor_width is 1e.30"),
        ("PERSP", {"lens": TINY}, "along the image plane, .*: lens is 1e-38"),
        ("PERSP", {"shift_x": HUGE}, "shift_x .* is 1e.30"),
        ("PERSP", {"shift_y": 1e6}, "shift_y .* is 1e.06: it must be from -453438 to 453438"),
        ("EQUIRECTANGULAR", {"shift_y": -1e6}, "shift_y .* is -1e.06: it must be from -729444 to 729444"),
        (
            "ORTHO",
            {"matrix_world": placed(location=1e20)},
            "cannot be distinguished: its distance from the world's origin is 1e.20",
        ),
        ("ORTHO", {"ortho_scale": TINY, "matrix_world": placed()}, "cannot be distinguished: ortho_scale is 1e-38"),
        ("TWISTED_ORTHOGRAPHIC", {"ortho_scale": HUGE}, "along the image plane, .*: ortho_scale is 1e.30"),
        ("TWISTED_ORTHOGRAPHIC", {"twist": HUGE}, "along the image plane, .*: twist is 1e.30"),
        ("CAMERA_OBSCURA", {"obscura_width": HUGE}, "along the image plane, .*: obscura_width is 1e.30"),
        ("OPENCV_PINHOLE", {"cx": HUGE}, "cx .* is 1e.30: it must be from"),
        ("OPENCV_FISHEYE", {"cy": HUGE}, "cy .* is 1e.30: it must be from"),
        ("STRIP", {"matrix_world": placed(location=1e12)}, "path .* away, where float32 cannot distinguish its ends"),
        (
            "PENCIL",
            {"matrix_world": placed(location=1e12)},
            "slit_1 .* away, where float32 cannot distinguish its ends",
        ),
        ("PUSHBROOM", {"sensor_width": HUGE}, "along the image plane, .*: sensor_width is 1e.30"),
    ],
)
def test_what_float32_does_not_carry_is_refused_by_name(kind, settings, message):
    with pytest.raises(InputError, match=message) as refused:
        camera_of(kind, settings)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("kind", "settings"),
    [
        *(("PERSP", {"matrix_world": placed(scale=scale)}) for scale in (TINY, 1e-20, 1e20, MOST / 4)),
        *(("PERSP", {"matrix_world": placed(location=x)}) for x in (TINY, HUGE, MOST)),
        ("PERSP", {"lens": 1e9, "matrix_world": placed()}),
        ("PERSP", {"lens": HUGE}),  # not turned: each coordinate has all its digits
        ("PERSP", {"sensor_width": 1e6}),
        ("PERSP", {"shift_x": 4e5}),
        ("ORTHO", {"ortho_scale": HUGE}),
        ("ORTHO", {"ortho_scale": 1e-6, "matrix_world": placed(location=100.0)}),
        ("EQUIRECTANGULAR", {"shift_x": 4e5, "shift_y": 4e5}),
        ("EQUIRECTANGULAR", {"longitude_max": 1000.0}),  # more than a turn a pixel
        ("CENTRAL_CYLINDRICAL", {"central_cylindrical_range_v_max": 1e6}),
        ("CENTRAL_CYLINDRICAL", {"central_cylindrical_radius": TINY}),
        ("FISHEYE_EQUISOLID", {"sensor_width": HUGE}),  # one pixel has a ray
        ("FISHEYE_LENS_POLYNOMIAL", {}),  # whose middle pixel is at the rim of a cone that nothing sees
        ("OPENCV_PINHOLE", {"cx": 1e7}),
        ("PENCIL", {"matrix_world": placed(location=1e6)}),
        ("STRIP", {"matrix_world": placed(location=1e6)}),
        (
            "STRIP",
            {"path": ((-2, 0, 0), (0, 1, 0), (2, 0, 0)), "matrix_world": placed()},
        ),  # whose middle pixel is at a joint of the path
    ],
)
def test_what_it_carries_comes_back_to_its_pixel(kind, settings):
    """Nothing warns, a ray has its length, and the round trip holds to its bound."""
    camera = camera_of(kind, settings)
    rays = camera.rays()
    assert rays.valid.any()
    np.testing.assert_allclose(np.linalg.norm(rays.directions[rays.valid], axis=-1), 1.0, atol=1e-14)
    (round_trip,) = verify(camera)
    assert round_trip.passed, round_trip
