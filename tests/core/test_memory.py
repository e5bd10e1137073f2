"""Pictures that do not fit into the memory are refused before anything is allocated, and a border of them is cast."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core import memory
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.pass_needs import image_bytes
from camera_ray_caster.core.casting.passes import PASSES
from camera_ray_caster.core.records import BlenderCamera, InputError

from .camera.test_pixel_time import shapes

WHOLE = BlenderCamera(
    name="Camera",
    type="PERSP",
    matrix_world=np.eye(4),
    resolution_x=1 << 16,
    resolution_y=1 << 16,
    resolution_percentage=100,
)
BORDER = replace(WHOLE, use_border=True, border_min_x=0.5, border_max_x=0.501, border_min_y=0.25, border_max_y=0.251)
BALL = shapes(((0, 0, -5), 1.0))


@pytest.fixture
def little(monkeypatch):
    """A machine that has 1 GiB left, and a watch over what is allocated meanwhile."""
    monkeypatch.setattr(memory, "available", lambda: 1 << 30)
    tracemalloc.start()
    yield
    assert tracemalloc.get_traced_memory()[1] < 1 << 26
    tracemalloc.stop()


def test_every_pass_counts_as_many_bytes_as_its_array_has():
    for name, entry in PASSES.items():
        for dtype in (np.float16, np.float64):
            assert image_bytes((3, 5), [name], dtype) == entry.empty((3, 5), dtype).nbytes


@pytest.mark.parametrize("passes", ["depth", tuple(PASSES)])
def test_passes_that_do_not_fit_are_refused_with_what_they_take_and_what_is_there(little, passes):
    with pytest.raises(
        InputError, match=r"^the passes of 65536 x 65536 pixels take [\d.]+ GiB of memory and 1 GiB .*\(Ctrl B"
    ):
        cast(camera_from(WHOLE), BALL, passes=passes)


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_rays_that_do_not_fit_are_refused(little, kind):
    with pytest.raises(InputError, match=r"^the rays of 65536 x 65536 pixels take (100|196) GiB"):
        camera_from(replace(WHOLE, type=kind)).rays()


def test_times_of_an_image_that_do_not_fit_are_refused_border_or_not(little):
    gray = {"time_mode": "IMAGE", "time_image": np.zeros((2, 2)), "time_start": 1.0, "time_end": 2.0}
    with pytest.raises(InputError, match=r"^the times of 65536 x 65536 pixels .*fewer pixels"):
        camera_from(replace(BORDER, settings=gray))


def test_a_border_of_what_does_not_fit_is_cast_as_the_part_that_it_is(little):
    camera = camera_from(BORDER)
    images = cast(camera, BALL, passes=("shape_index", "depth"), dtype=np.float64)
    assert images["depth"].shape == (65, 65)
    raster = camera.raster
    assert (raster.x0, raster.y0) == (32768, 16384)
    directions = camera.rays().directions
    slope = 36 / 50 / 65536  # of a pixel
    x, y = (raster.columns() - 32768) * slope, (raster.rows() - 32768) * slope
    np.testing.assert_allclose(
        directions[..., 1] / -directions[..., 2], np.broadcast_to(y, directions.shape[:2]), rtol=1e-12
    )
    seen = 25 - 24 * (1 + x * x + y * y) >= 0  # the discriminant of the ball's nearest point
    assert np.array_equal(images["shape_index"] >= 0, seen)


def test_memory_is_known_here_and_never_asked_for_in_vain():
    there = memory.available()
    assert there is None or there > 1 << 24
    memory.require(memory.ALWAYS_THERE, "no passes")


def test_where_nobody_knows_the_memory_nothing_is_refused(monkeypatch):
    monkeypatch.setattr(memory, "available", lambda: None)
    memory.require(1 << 60, memory.of_pixels("passes", (1 << 20, 1 << 20)))
