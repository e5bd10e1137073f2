"""What may be asked of a cast, and how it is stopped."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import PLANE, SPHERE, Cancelled, InputError

from .test_cast import camera_at, shapes_of


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"threads": float("nan")}, "threads is nan: it must be a whole number from 1$"),
        ({"threads": 0}, "threads is 0: it must"),
        ({"threads": 1.5}, "threads is 1.5: it must"),
        ({"samples": float("nan")}, "samples is nan: it must"),
        ({"samples": 2**31 - 1}, "samples is 2147483647: it must be a whole number from 1 to 16777216"),
        ({"samples": "many"}, "samples is 'many': it must"),
        *(
            ({"dtype": dtype}, "it must be float16, float32 or float64")
            for dtype in (str, bool, np.int8, complex, object)
        ),
    ],
)
def test_what_cannot_be_meant_is_refused_in_one_line(arguments, message):
    with pytest.raises(InputError, match=message) as caught:
        cast(camera_at(), shapes_of((SPHERE, (0, 0, -5), 1.0)), passes=("depth",), **arguments)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("wrong", [None, 3, "camera", []])
def test_what_is_no_camera_and_no_shapes_is_told_by_its_type(wrong):
    shapes = shapes_of((SPHERE, (0, 0, -5), 1.0))
    for camera, cast_at in ((wrong, shapes), (camera_at(), wrong)):
        with pytest.raises(TypeError, match="cast takes a camera and shapes"):
            cast(camera, cast_at)


@pytest.mark.parametrize("points", [None, 5, "abc", ["a", "b", "c"], [[1, 2, 3], [1, 2]], [10**400, 0, 0], [1.0, 2.0]])
def test_what_is_no_point_is_not_projected(points):
    with pytest.raises(InputError) as caught:
        camera_at().project(points)
    assert "\n" not in str(caught.value)


def test_passes_may_come_from_a_generator():
    images = cast(camera_at(), shapes_of((SPHERE, (0, 0, -5), 1.0)), passes=(name for name in ("depth", "valid")))
    assert list(images) == ["depth", "valid"]
    assert images["valid"].all()


def test_many_samples_stop_soon_and_tell_how_far_they_are():
    """The one tile of this picture would take minutes."""
    heard = []

    def progress(fraction):
        heard.append(fraction)
        return len(heard) < 4

    with pytest.raises(Cancelled):
        cast(
            camera_at(resolution_x=256, resolution_y=256), shapes_of((SPHERE, (0, 0, -5), 1.0)), passes=("combined",),
            samples=1 << 20, progress=progress,
        )  # fmt: skip
    assert 0 < heard[-1] < 0.01
    assert heard == sorted(heard)


def test_a_number_too_large_for_its_type_has_an_infinite_bound():
    """The wall is 1e5 away, and float16 ends at 65504."""
    camera, wall = camera_at(clip_end=1e6), shapes_of((PLANE, (0, 0, -1e5), 1e6))
    images = cast(camera, wall, passes=("distance", "distance_bound", "normal_bound", "shape_index"), dtype=np.float16)
    hit = images["shape_index"] == 0
    assert hit.any()
    assert np.isinf(images["distance"][hit]).all()
    assert np.isinf(images["distance_bound"][hit]).all()
    assert np.isfinite(images["normal_bound"][hit]).all()
