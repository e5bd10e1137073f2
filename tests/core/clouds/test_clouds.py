"""Points of a scan: on the surfaces, with the errors that were asked for, and as files that are read byte by byte."""

import struct
from dataclasses import replace
from io import BytesIO

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.clouds.cloud import WORLD
from camera_ray_caster.core.clouds.cloud_beams import FROM_CAMERA
from camera_ray_caster.core.clouds.formats import POINT_FORMATS, files_of
from camera_ray_caster.core.clouds.sequences import sequence
from camera_ray_caster.core.motion.apart import rows_of
from camera_ray_caster.core.motion.evaluations import resolve

SHAPES = crc.join(
    crc.spheres([(4.0, 0.0, 1.0)], 1.0, object_index=3, name="ball", color=(0.8, 0.4, 0.6)),
    crc.planes((0.0, 0.0, -1.0), infinite=True, object_index=7, name="ground"),
)
POSE = crc.look_at((0.0, 0.0, 1.0), (1.0, 0.0, 1.0))


def scanner(device="VLP_16", **settings):
    return crc.camera("SCANNER", (360, 16), POSE, scanner_device=device, **settings)


def test_points_lie_on_what_was_hit_and_say_what_it_is():
    cloud = crc.scan(scanner(), SHAPES)
    ball = cloud.category == 3
    assert ball.sum() > 100
    assert (cloud.instance == np.where(ball, 1, 2)).all()
    assert np.abs(np.linalg.norm(cloud.world[ball] - (4, 0, 1), axis=1) - 1).max() < 1e-12
    assert np.abs(cloud.world[~ball][:, 2] + 1).max() < 1e-12
    ahead = cloud.sensor @ cloud.pose[:3, :3].T + cloud.pose[:3, 3]
    assert np.abs(ahead - cloud.world).max() < 1e-12
    np.testing.assert_array_equal(cloud.range, cloud.true_range)
    np.testing.assert_allclose(np.linalg.norm(cloud.sensor, axis=1), cloud.range, rtol=0, atol=0.0113)  # the offsets
    down = np.degrees(np.arcsin(cloud.incidence[~ball]))  # the ground sees the elevation of the beam
    np.testing.assert_allclose(down, 15 - 2 * cloud.ring[~ball].astype(float), atol=1e-9)
    np.testing.assert_allclose(cloud.reflectance[ball], 0.6 * cloud.incidence[ball], rtol=1e-6)
    assert (np.diff(cloud.column) >= 0).all()  # in the order in which they fire


def test_times_are_seconds_after_the_frame():
    cloud = crc.scan(scanner(time_mode="SWEEP", fps=30, frame=12.0), SHAPES)
    laser = np.array([0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15])[cloud.ring]
    np.testing.assert_allclose(cloud.time, 1e-6 * (55.296 * 1808 / 360 * cloud.column + 2.304 * laser), atol=1e-9)


def test_noise_is_gaussian_and_repeats_with_its_seed():
    first, same, other = (crc.scan(scanner(), SHAPES, noise=0.02, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(first.range, same.range)
    assert (first.range != other.range).all()
    off = first.range - first.true_range
    assert np.std(off) == pytest.approx(0.02, rel=4 / np.sqrt(2 * len(off)))  # four standard errors
    assert abs(off.mean()) < 4 * 0.02 / np.sqrt(len(off))
    ahead = first.sensor - crc.scan(scanner(), SHAPES).sensor
    np.testing.assert_allclose(np.linalg.norm(ahead, axis=1), np.abs(off), atol=1e-12)


def test_returns_are_lost_by_incidence_and_range():
    every, some = crc.scan(scanner(), SHAPES), crc.scan(scanner(), SHAPES, dropout=5.0)
    kept = np.isin(every.column * 16 + every.row, some.column * 16 + some.row)
    chance = np.minimum(1, every.incidence * (5.0 / every.range) ** 2)
    spread = np.sqrt((chance * (1 - chance)).sum())
    assert abs(kept.sum() - chance.sum()) < 4 * spread


def test_ranges_have_the_steps_of_a_device():
    cloud = crc.scan(scanner(), SHAPES, quantum=0.002)
    assert np.abs(cloud.range / 0.002 - np.rint(cloud.range / 0.002)).max() < 1e-9
    assert 0 < np.abs(cloud.range - cloud.true_range).max() <= 0.001 + 1e-12
    fine = crc.scan(scanner(), SHAPES, quantum=1e-320)
    assert np.abs(fine.range - fine.true_range).max() < 1e-12


@pytest.mark.parametrize(("device", "step", "behind"), [("VLP_16", 2, 0), ("VLP_32C", 4, 0), ("OS1_64", 1, 12.163)])
def test_ranges_are_rounded_as_the_device_stores_them(device, step, behind):
    """An Ouster's millimeters count from behind the origins of its beams, 12.163 mm from the axis."""
    cloud = crc.scan(scanner(device), SHAPES, quantum="device")
    stored = (1000 * cloud.range + behind) / step
    assert np.abs(stored - np.rint(stored)).max() < 1e-7
    off = 1000 * np.abs(cloud.range - cloud.true_range).max()
    assert 0.4 * step < off <= 0.5 * step + 1e-9
    reach = np.linalg.norm(cloud.sensor, axis=1)
    assert np.abs(reach - cloud.range).max() < 0.1  # origins beside the center


@pytest.mark.parametrize(
    "cam", [scanner("TERRESTRIAL"), scanner("CUSTOM"), crc.camera("FISHEYE_EQUIDISTANT", (32, 24), POSE)]
)
def test_a_quantum_that_is_not_known_is_refused(cam):
    with pytest.raises(crc.InputError, match="is not known: give a length"):
        crc.scan(cam, SHAPES, quantum="DEVICE")


def test_any_camera_has_points():
    cam = crc.camera("OPENCV_FISHEYE", (32, 24), POSE, fx=10.0, fy=10.0)
    cloud = crc.scan(cam, SHAPES, categories={"ball": 40})
    assert set(cloud.category.tolist()) == {40, 7}
    pixels = cam.project(cloud.world)
    assert np.abs(pixels - np.stack((cloud.column + 0.5, cloud.row + 0.5), axis=1)).max() < 1e-9


@pytest.mark.parametrize(
    "settings",
    [{"categories": {"ball": np.nan}}, {"noise": -1.0}, {"noise": np.nan}, {"dropout": -2}, {"quantum": "x"},
     {"seed": -1}, {"seed": 1.5}, {"categories": "x"}, {"categories": {"x": -1}}, {"categories": {"x": 1 << 31}}],
)  # fmt: skip
def test_numbers_without_meaning_are_refused_by_name(settings):
    with pytest.raises(crc.InputError, match=next(iter(settings))):
        crc.scan(scanner(), SHAPES, **settings)


CLOUD = crc.scan(scanner(), SHAPES, noise=0.01)


def written(key, cloud=CLOUD, axes="sensor"):
    return dict(files_of(cloud, key, axes))


def test_kittis_points_and_labels():
    files = written("kitti")
    points = np.frombuffer(files[".bin"], "<f4").reshape(-1, 4)
    np.testing.assert_array_equal(points[:, :3], CLOUD.sensor.astype("f4"))
    assert 0 <= points[:, 3].min() < points[:, 3].max() <= 1
    labels = np.frombuffer(files[".label"], "<u4")
    np.testing.assert_array_equal(labels & 0xFFFF, CLOUD.category)
    np.testing.assert_array_equal(labels >> 16, CLOUD.instance)


def test_the_layout_of_nuscenes():
    """x right, y ahead, z up, intensity to 255, ring; categories as bytes; 1000 category + instance."""
    files = written("nuscenes")
    points = np.frombuffer(files[".pcd.bin"], np.float32).reshape(-1, 5)
    np.testing.assert_array_equal(points[:, 0], -CLOUD.sensor[:, 1].astype("f4"))
    np.testing.assert_array_equal(points[:, 1], CLOUD.sensor[:, 0].astype("f4"))
    np.testing.assert_array_equal(points[:, 4], CLOUD.ring)
    assert 1 < points[:, 3].max() <= 255
    np.testing.assert_array_equal(np.frombuffer(files["_lidarseg.bin"], np.uint8), CLOUD.category)
    panoptic = np.load(BytesIO(files["_panoptic.npz"]))["data"]
    assert panoptic.dtype == np.uint16
    np.testing.assert_array_equal(panoptic, 1000 * CLOUD.category + 1)


def test_the_header_of_las():
    content = written("las", axes=WORLD)[".las"]
    assert content[:4] == b"LASF"
    assert tuple(content[24:26]) == (1, 4)
    first, length = struct.unpack_from("<I", content, 96)[0], struct.unpack_from("<H", content, 105)[0]
    assert struct.unpack_from("<Q", content, 247)[0] == len(CLOUD)
    assert len(content) == first + length * len(CLOUD)
    scale, offset = np.frombuffer(content, "<f8", 3, 131), np.frombuffer(content, "<f8", 3, 155)
    places = np.frombuffer(content, np.dtype([("xyz", "<i4", 3), ("rest", f"V{length - 12}")]), offset=first)["xyz"]
    assert np.abs(places * scale + offset - CLOUD.world).max() <= 0.5e-4 + 1e-9


def test_shapes_that_appear_while_beams_fire_have_no_numbers():
    """The row of a shape would mean the one in some points, and the other in others."""
    cam = scanner(time_mode="SWEEP")

    def evaluate(frame):
        return cam, SHAPES if frame > 1 else rows_of(SHAPES, np.array([1]))

    motion = resolve(evaluate, 0.0, 2.4, 0.01, 64)
    assert any("appear or disappear" in line for line in motion.in_words())
    scene = crc.Scene(cam, evaluate(0.0)[1]).with_timeline(motion)
    with pytest.raises(crc.InputError, match=r"frame \S+ differs in 'ball': show it at all"):
        crc.scan(scene)


def test_numbers_that_a_format_cannot_store_are_refused():
    many = replace(CLOUD, instance=CLOUD.instance + 70_000)
    with pytest.raises(crc.InputError, match=r"instance 70002.*65535"):
        written("kitti", many)
    classes = replace(CLOUD, category=CLOUD.category + 300)
    for key in ("las", "nuscenes"):
        with pytest.raises(crc.InputError, match="307"):
            written(key, classes)
    with pytest.raises(crc.InputError, match=r"unknown format of points \['ply'\]"):
        files_of(CLOUD, ["ply"])
    with pytest.raises(crc.InputError, match="did you mean pcd"):
        written("pdc")


@pytest.mark.parametrize("key", POINT_FORMATS)
def test_a_cloud_without_points_has_its_files(key):
    empty = crc.scan(scanner(), crc.spheres([(0.0, 0.0, 500.0)], 1.0))
    assert len(empty) == 0
    assert written(key, empty)


def test_a_sequence_has_the_poses_of_its_frames():
    cameras = [crc.camera("SCANNER", (8, 4), crc.look_at((x, 2.0, 1.0), (x + 1, 2.0 + x, 1.0))) for x in (0.0, 1.5)]
    files = dict(sequence(cameras, [0.5, 0.6]))
    poses = np.loadtxt(files["poses.txt"].splitlines()).reshape(-1, 3, 4)
    np.testing.assert_allclose(poses[0], np.eye(4)[:3], atol=1e-12)
    to_camera = np.vstack((np.array(files["calib.txt"].split("Tr: ")[1].split(), float).reshape(3, 4), (0, 0, 0, 1)))
    moved = np.vstack((poses[1], (0, 0, 0, 1)))
    between = np.linalg.inv(to_camera) @ moved @ to_camera  # from the second scanner to the first
    expected = [np.eye(4), np.eye(4)]
    for pose, camera in zip(expected, cameras, strict=True):
        pose[:3, :3], pose[:3, 3] = camera.pose.basis @ FROM_CAMERA.T, camera.pose.eye
    np.testing.assert_allclose(between, np.linalg.inv(expected[0]) @ expected[1], atol=1e-12)
    assert files["times.txt"].split() == ["0.000000000e+00", "1.000000000e-01"]
