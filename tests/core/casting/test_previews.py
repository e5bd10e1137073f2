"""Pictures to look at while a cast runs: coarse ones, then means of the samples so far; the result is the same."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.pixel_time import ImageTime, LinearTime
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting import previews
from camera_ray_caster.core.motion.evaluations import resolve

from .neighbors import with_motion
from .test_cast import camera_at, shapes_of
from .test_stopping import many_spheres


def shown(monkeypatch, camera, shapes, delay=0.0, share=1e9, **options):
    """A cast, and the pictures that it showed: (combined, rows, samples); by default all coarse ones may be shown."""
    for name, value in {"DELAY": delay, "PREVIEW_SHARE": share, "FIRST_PREVIEW_SHARE": share}.items():
        monkeypatch.setattr(previews, name, value)
    calls = []
    images = cast(
        camera, shapes, preview=lambda image, rows, count: calls.append((image.copy(), rows, count)), **options
    )
    return images, calls


@pytest.mark.parametrize("passes", [("combined",), ("depth", "combined")])
def test_means_of_the_samples_are_shown_and_the_picture_has_the_same_bits(monkeypatch, passes):
    camera, shapes = camera_at(resolution_x=160, resolution_y=120), many_spheres(30)
    expected = cast(camera, shapes, passes=passes, samples=12, threads=2)
    images, calls = shown(monkeypatch, camera, shapes, passes=passes, samples=12, threads=2)
    for name in passes:
        assert np.array_equal(images[name], expected[name])
    means = {count: picture for picture, rows, count in calls if count}
    assert list(means) == [1, 2, 4, 8]
    for count in (2, 4, 8):
        assert np.array_equal(means[count], cast(camera, shapes, passes="combined", samples=count)["combined"])


def test_coarse_pictures_come_first_and_have_the_pixels_of_the_picture(monkeypatch):
    camera, shapes = camera_at(resolution_x=403, resolution_y=301), many_spheres(3000)
    options = {"passes": "combined", "threads": 2}
    chief = cast(camera, shapes, **options)["combined"]
    _, calls = shown(monkeypatch, camera, shapes, samples=64, **options)
    assert calls[0][2] == 0, "every 8th pixel comes before the first sample"
    step = previews.PREVIEW_STEPS[0]
    middles = [step // 2 + step * np.minimum(np.arange(side) // step, (side - step // 2 - 1) // step)
               for side in chief.shape[:2]]  # fmt: skip
    assert np.array_equal(calls[0][0], chief[np.ix_(*middles)])


def test_a_coarse_picture_is_given_up_when_it_takes_too_long(monkeypatch):
    camera, shapes = camera_at(resolution_x=160, resolution_y=120), many_spheres(3000)
    _, calls = shown(monkeypatch, camera, shapes, share=1e-9, passes="combined", samples=8)
    assert [count for _, _, count in calls] == [1, 2, 4]


def test_a_quick_cast_shows_nothing_and_rays_are_counted_with_samples():
    camera, shapes = camera_at(resolution_x=40, resolution_y=30), shapes_of()
    calls = []
    images = cast(camera, shapes, passes=("depth", "combined"), preview=lambda *args: calls.append(args))
    assert (calls, images.rays) == ([], 1200)
    assert cast(camera, shapes, passes=("depth", "combined"), samples=16).rays == 1200 * 17


@pytest.mark.parametrize(("time", "axis"), [
    (LinearTime(0.0, 0.0, 0.1, 0.05, 12.95, 0.1, 256), 0),
    (LinearTime(0.0, 0.1, 0.0, 0.05, 15.95, 0.1, 256), 1),
    (ImageTime(np.arange(160).repeat(130).reshape(160, 130).T / 10, 0.1, 256), 1),
], ids=["rows", "columns", "image"])  # fmt: skip
def test_every_64th_time_comes_first_and_fills_the_picture(monkeypatch, time, axis):
    """Each pixel that is not cast yet is the last one before it that is; all have their bits in the end."""
    still, shapes = camera_at(resolution_x=160, resolution_y=130), many_spheres(30)

    def evaluate(frame):
        return still, replace(shapes, center=shapes.center + np.array((0.1 * frame, 0, 0)))

    moving = with_motion(replace(still, pixel_time=time), shapes, resolve(evaluate, 0.0, 16.0, 0.1, 64))
    options = {"passes": "combined", "samples": 2, "threads": 2}
    expected = cast(*moving, **options)["combined"]
    images, calls = shown(monkeypatch, *moving, **options)
    assert np.array_equal(images["combined"], expected)
    assert all((rows, samples) == (slice(0, 130), 0) for _, rows, samples in calls)
    for (picture, _, _), step in zip(calls, (64, 32, 16, 8, 4, 2), strict=True):
        places = np.arange(expected.shape[axis]) // step * step
        assert np.array_equal(picture, expected.take(places, axis)), step
