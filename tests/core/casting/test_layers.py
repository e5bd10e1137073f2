"""Passes that are written shape by shape are those that each pixel looks up; so are those of a search in bands."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core import tuning
from camera_ray_caster.core.casting.passes import PASSES
from camera_ray_caster.core.records import Shapes

from ..still import STILL

CAMERAS = {
    "PERSP": {}, "ORTHO": {"ortho_scale": 6.0}, "FISHEYE_EQUIDISTANT": {}, "CAMERA_OBSCURA": {},
    "OMNIDIRECTIONAL_STEREO": {},
}  # fmt: skip


def shapes(around: float) -> Shapes:
    """Spheres, an ellipsoid, a plane and a mesh that hide each other in part, and a sphere around the eye."""
    turned = [[0.4, 0.3, 0.0], [-0.2, 0.9, 0.1], [0.0, 0.2, 0.6]]
    every = [
        crc.spheres([(-1, 0, -5), (0.5, 0.3, -6)], 1.0, object_index=[3, 4]),
        crc.spheres((1, -0.5, -4), 1.0, axes=turned),
        crc.planes((0, 0, -7), [[3, 0], [0, 1], [0, 1]], object_index=7),
        crc.mesh([(-2, -1, -5), (2, -1, -5.5), (0, 2, -6), (0, 0, -3.5)], [(0, 1, 2), (0, 1, 3)], object_index=9),
    ]  # fmt: skip
    return crc.join(*every, *([crc.spheres((0, 0, 0), around)] if around else []))


@pytest.mark.parametrize("around", [0.0, 20.0], ids=["some miss", "none misses"])
@pytest.mark.parametrize("model", CAMERAS)
def test_layers_change_no_pass(monkeypatch, model, around):
    camera, seen = crc.camera(model, (200, 144), **CAMERAS[model]), shapes(around)
    monkeypatch.setattr(tuning, "BLOCK_PIXELS", 200 * 40)
    monkeypatch.setattr(tuning, "LAYERED", np.inf)
    layered, sampled = crc.cast(camera, seen, passes=STILL), crc.cast(camera, seen, passes="combined", samples=2)
    assert layered.plan.is_layered
    monkeypatch.setattr(tuning, "LAYERED", 0.0)
    looked_up = crc.cast(camera, seen, passes=STILL)
    assert len(np.unique(layered["shape_index"])) >= 5
    for name in STILL:
        np.testing.assert_array_equal(layered[name], looked_up[name], err_msg=name)
    np.testing.assert_array_equal(sampled["combined"], crc.cast(camera, seen, passes="combined", samples=2)["combined"])


@pytest.mark.parametrize("last", ["wall", "floor", "ball"])
def test_a_search_in_bands_of_rows_changes_no_pixel(monkeypatch, last):
    """Also where the shape that is tested first covers or misses some of the bands as a whole."""
    every = {
        "ball": crc.spheres((0.5, 0, -5), 1.0),
        "wall": crc.planes((0, -5, -9), [[20, 0], [0, 6], [0, 0]]),
        "floor": crc.planes((0, -1, 0), [[9, 0], [0, 0], [0, 9]], infinite=True),
    }
    camera = crc.camera("PERSP", (160, 120))
    seen = crc.join(*(every[name] for name in every if name != last), every[last])
    whole = crc.cast(camera, seen, passes=STILL, threads=1)
    monkeypatch.setattr(tuning, "SEARCHED_PIXELS", 160 * 7)
    crc.cast(
        camera, crc.planes((0, 0, -0.5)), passes=STILL, threads=1
    )  # so that working arrays have other, nearer hits
    bands = crc.cast(camera, seen, passes=STILL, threads=1)
    assert len(np.unique(whole["shape_index"])) == 4
    for name in STILL:
        np.testing.assert_array_equal(bands[name], whole[name], err_msg=name)


def test_passes_of_surfaces_are_their_number_where_nothing_is_hit():
    images = crc.cast(crc.camera("PERSP", (48, 32)), crc.spheres((0, 0, -9), 1.0), passes=STILL)
    missed = images["shape_index"] < 0
    for name in STILL:
        if isinstance(PASSES[name].missed, int | float):
            assert (images[name][missed] == PASSES[name].missed).all(), name
