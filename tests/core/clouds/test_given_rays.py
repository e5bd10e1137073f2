"""Clouds of any rays: the points of a pattern without rows and columns, with its times and rings."""

import numpy as np
import pytest

import camera_ray_caster as crc

GROUND = crc.planes((0.0, 0.0, 0.0), infinite=True, object_index=7, name="ground")
BALL = crc.spheres([(5.0, 0.0, 1.0)], 1.0, object_index=3, name="ball")
SHAPES = crc.join(BALL, GROUND)


def rosette(count=400):
    """Directions in a flower, as of a scanner with two prisms, all downwards; and their times and rings."""
    turn = np.linspace(0, 2 * np.pi, count)
    azimuth, elevation = 0.6 * np.cos(5 * turn) * np.cos(turn), -0.05 + 0.5 * np.cos(5 * turn) * np.sin(turn)
    flat = np.cos(elevation)
    directions = np.stack((flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)), axis=1)
    return directions, 3 + np.arange(count) * 24e-5, np.arange(count) % 6


def test_a_pattern_is_a_cloud_with_its_times_and_rings(tmp_path):
    directions, times, rings = rosette()
    eye = np.array((0.0, 0.0, 1.8))
    images = crc.cast_rays(eye, directions, SHAPES, passes="distance", times=times, rings=rings)
    hit = np.isfinite(images["distance"])
    assert 0 < hit.sum() < len(hit)
    for cloud in (
        crc.scan(rays=images),
        crc.scan(rays=(eye, directions), shapes=SHAPES, times=times, rings=rings),
        crc.scan(SHAPES, rays=(eye, 3 * directions), times=times, rings=rings),
    ):
        np.testing.assert_allclose(cloud.range, images["distance"][hit], rtol=1e-14)
        np.testing.assert_array_equal(cloud.ring, rings[hit])
        np.testing.assert_allclose(cloud.time, (np.arange(len(hit)) * 1e-5)[hit], atol=1e-12)
        np.testing.assert_array_equal(cloud.column, np.flatnonzero(hit))
        np.testing.assert_allclose(cloud.world, eye + images["distance"][hit, None] * directions[hit], atol=1e-12)
        np.testing.assert_allclose(cloud.sensor, cloud.world - eye, atol=1e-12)
        assert set(cloud.category.tolist()) == {3, 7}
    for key in ("ply", "pcd", "kitti", "nuscenes", "las", "npz"):
        (path, *_) = crc.save_points(images, tmp_path, key).paths
        again = crc.save_points(crc.scan(rays=images), tmp_path / "again", key).paths[0]
        assert path.stat().st_size > 12 * hit.sum()
        assert path.read_bytes() == again.read_bytes()


def test_the_rays_of_a_camera_give_the_cloud_of_the_camera():
    """In another order; the pose gives the sensor's axes."""
    pose = crc.look_at((0, -1, 2), (5, 0, 1))
    cam = crc.camera("EQUIRECTANGULAR", (60, 30), pose)
    right, cloud = crc.scan(cam, SHAPES), crc.scan(rays=cam.rays(), shapes=SHAPES, pose=pose)
    assert cloud.size == right.size == (60, 30)
    order = np.lexsort((right.column, right.row))
    for name in ("world", "sensor", "normal", "sensor_normal", "range", "row", "column", "ring", "instance"):
        np.testing.assert_allclose(getattr(cloud, name), getattr(right, name)[order], rtol=0, atol=1e-12, err_msg=name)
    np.testing.assert_allclose(cloud.pose, right.pose, atol=1e-15)


@pytest.mark.parametrize(
    ("how", "word"),
    [
        ({"rays": 3}, "origins and directions"),
        ({"rays": ((0, 0, 0), (1, 0, 0)), "shapes": None}, "rays= and shapes="),
        ({"rays": ((0, 0, 0), np.ones((4, 3))), "rings": [1, 2]}, "rings of shape"),
        ({"rays": ((0, 0, 0), np.ones((2, 3))), "rings": [1, -2]}, "rings must be whole"),
        ({"rays": ((0, 0, 0), np.ones((2, 3))), "times": [1, 2, 3]}, "times of shape"),
        ({"rays": ((0, 0, 0), (1, 0, 0)), "quantum": "DEVICE"}, "quantum"),
        ({"rays": ((0, 0, 0), (1, 0, 0)), "fps": 0}, "fps"),
        ({"rays": crc.cast_rays((0, 0, 5), (0, 0, -1), GROUND, passes="distance", all_hits=True)}, "all_hits"),
    ],
)
def test_rays_that_make_no_cloud_are_refused_in_one_line(how, word):
    with pytest.raises(crc.InputError, match=word):
        crc.scan(**({"shapes": SHAPES} | how))
