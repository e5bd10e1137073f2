"""Spherical stereo with depth of field: where the eye is beside a ray that has passed the lens, and what it sees."""

from math import pi

import numpy as np

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import Shapes

from .test_spherical_stereo import each_kind, each_mode, eye

LENS = {
    "use_dof": True, "aperture_fstop": 0.05, "focus_distance": 2.5, "focus_position": None, "aperture_blades": 5,
    "aperture_rotation": 0.3, "aperture_ratio": 1.5,
}  # fmt: skip


@each_kind
@each_mode
def test_a_ray_through_the_lens_has_an_eye_beside_it(key, mode):
    """As Cycles has it: first the lens, then the eye beside the ray that has passed it."""
    cam, plain = eye(key, **mode, **LENS), eye(key, interocular_distance=0.0, **LENS)
    x, y = cam.raster.columns(), cam.raster.rows()
    model = cam.model
    for sample in range(3):
        lens_origin, lens_direction = (np.stack(np.broadcast_arrays(*xyz), axis=-1) for xyz in
                                       plain.sample_rays(x, y, sample))  # fmt: skip
        origin, direction = (np.stack(np.broadcast_arrays(*xyz), axis=-1) for xyz in cam.sample_rays(x, y, sample))
        upright = np.eye(3) if model.upright is None else np.array(model.upright)
        ahead = lens_direction @ upright.T
        ahead /= np.linalg.norm(ahead, axis=-1, keepdims=True)
        side = np.cross(ahead, (0, 1, 0))
        side /= np.linalg.norm(side, axis=-1, keepdims=True)
        altitude, fade = np.abs(np.arcsin(ahead[..., 1:2])), 1.0
        if model.merge is not None:
            begin, end = model.merge
            fade = np.where(altitude > end, 0, np.cos(pi / 2 * np.clip((altitude - begin) / (end - begin), 0, 1)))
        beside = model.offset * fade * side
        turned = ahead - model.nearness * beside
        turned /= np.linalg.norm(turned, axis=-1, keepdims=True)
        np.testing.assert_allclose(origin, lens_origin + beside @ upright, rtol=0, atol=1e-13)
        np.testing.assert_allclose(direction, turned @ upright, rtol=0, atol=1e-13)


@each_kind
def test_bounds_hold_what_is_seen_through_the_lens(key):
    cam, random = eye(key, **LENS), np.random.default_rng(4)
    n, ones = 40, np.ones(40, np.int32)
    center = random.uniform(-6, 6, (n, 3))
    scene = Shapes(
        np.zeros(n, np.uint8), center + cam.pose.eye, np.eye(3) * random.uniform(0.05, 0.4, (n, 1, 1)), ones, ones,
        random.uniform(0, 1, (n, 4)).astype(np.float32), ones * 0, ("s",),
    )  # fmt: skip
    pictures = [cast(cam, scene, passes=("combined",), samples=4, cull=cull)["combined"] for cull in (True, False)]
    assert np.array_equal(*pictures, equal_nan=True)
    assert len(np.unique(pictures[0])) > 100
