"""Points of an aperture for faces: their disc from every side, and rays that meet in the point of focus."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.faces.lens_points import lens_points

FOCUS = {"focus_distance": 3.0, "aperture_fstop": 0.1, "use_dof": True}


@pytest.mark.parametrize("seen_from", [(0, 0, 1), (1, 2, -3), (1, 0, 0)])
def test_the_ball_of_a_panorama_is_an_even_disc_from_every_side(seen_from):
    camera = crc.camera("FISHEYE_EQUIDISTANT", (64, 64), **FOCUS)
    places = np.array([point.position for point in lens_points(camera, 4096)]) / camera.aperture.radius
    axis = np.array(seen_from) / np.linalg.norm(seen_from)
    beside = np.linalg.norm(np.cross(places, axis), axis=1)
    for share in (0.25, 0.5, 0.75):
        assert (beside**2 < share).mean() == pytest.approx(share, abs=0.01)


@pytest.mark.parametrize("model", ["PERSP", "FISHEYE_EQUIDISTANT"])
def test_rays_through_every_point_meet_in_focus(model):
    camera = crc.camera(model, (64, 64), **FOCUS)
    chief = camera.rays().directions[8, 20]
    focus = chief * 3 / (-chief[2] if model == "PERSP" else 1)
    for point in lens_points(camera, 16):
        to_focus = focus - point.position
        assert point.directions(chief) == pytest.approx(to_focus / np.linalg.norm(to_focus), abs=1e-14)
