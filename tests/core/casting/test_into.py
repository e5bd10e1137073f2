"""Casts into the images of an earlier cast."""

import re

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cast import Images

from ..still import STILL

SHAPES = crc.join(
    crc.spheres([(-1, 0, -5), (1, 0.5, -6)], 1.0, object_index=[3, 4]),
    crc.mesh([(-2, -1, -8), (2, -1, -8), (0, 2, -7)], [(0, 1, 2)], object_index=9),
)
OTHER = crc.spheres((0.5, 0, -4), 0.7, object_index=5)
TWO = ("depth", "normal")


def camera(model="PERSP", size=(64, 48)):
    return crc.camera(model, size)


@pytest.mark.parametrize("model", ["PERSP", "FISHEYE_EQUIDISTANT", "ORTHO"])
@pytest.mark.parametrize("order", [(SHAPES, OTHER), (OTHER, SHAPES)], ids=["fewer hits", "more hits"])
def test_what_was_there_does_not_show(model, order):
    images = crc.cast(camera(model), order[0], passes=STILL)
    arrays = dict(images)
    plan = images.plan
    again = crc.cast(camera(model), order[1], passes=STILL, into=images)
    fresh = crc.cast(camera(model), order[1], passes=STILL)
    assert again is images
    assert images.shapes is order[1]
    assert images.plan is not plan
    assert list(again) == list(fresh)
    for name in STILL:
        assert again[name] is arrays[name]
        np.testing.assert_array_equal(again[name], fresh[name], err_msg=name)


def test_with_samples_and_without_culling():
    for keywords in ({"samples": 3}, {"threads": 1, "cull": False}):
        images = crc.cast(camera(), SHAPES, passes=("combined", "depth"), **keywords)
        fresh = crc.cast(camera(), OTHER, passes=("combined", "depth"), **keywords)
        again = crc.cast(camera(), OTHER, passes=("combined", "depth"), into=images, **keywords)
        for name in fresh:
            np.testing.assert_array_equal(again[name], fresh[name])


def test_passes_that_are_not_requested_are_removed():
    images = crc.cast(camera(), SHAPES, passes=("position", *TWO))
    crc.cast(camera(), SHAPES, passes=("normal", "depth"), into=images)
    assert list(images) == ["normal", "depth"]


def changed(**arrays):
    """Images of TWO with other arrays."""
    images = crc.cast(camera(), SHAPES, passes=TWO)
    for name, made in arrays.items():
        images[name] = made(images)
    return images


def read_only(images):
    images["depth"].setflags(write=False)
    return images["depth"]


BAD = {
    "a dictionary": (lambda: dict(crc.cast(camera(), SHAPES, passes=TWO)), "images that an earlier cast returned"),
    "empty": (Images, "no pass depth"),
    "a missing pass": (lambda: crc.cast(camera(), SHAPES, passes="depth"), "no pass normal"),
    "another size": (lambda: crc.cast(camera(size=(64, 40)), SHAPES, passes=TWO), "depth of into has the shape"),
    "another type": (
        lambda: crc.cast(camera(), SHAPES, passes=TWO, dtype=np.float64), "depth of into has the shape and type"
    ),
    "a list": (lambda: changed(depth=lambda images: images["depth"].tolist()), "no pass depth"),
    "read-only": (lambda: changed(depth=read_only), "writable"),
    "masked": (lambda: changed(depth=lambda images: np.ma.masked_array(images["depth"], mask=True, hard_mask=True)),
               "depth of into has a mask"),
    "columns first": (lambda: changed(normal=lambda images: np.asfortranarray(images["normal"])), "C-contiguous"),
    "memory of another": (lambda: changed(depth=lambda images: images["normal"].reshape(-1)[: 64 * 48].reshape(48, 64)),
                          "share memory"),
}


@pytest.mark.parametrize("case", BAD)
def test_images_that_do_not_fit_are_refused_before_anything_is_written(case):
    make, message = BAD[case]
    images = make()
    before = {name: np.array(image) for name, image in images.items()}
    with pytest.raises(crc.InputError, match=re.escape(message)):
        crc.cast(camera(), OTHER, passes=TWO, into=images)
    assert list(images) == list(before)
    for name, image in before.items():
        np.testing.assert_array_equal(images[name], image)
