"""Tables of rays: what is between their entries, and files of them, against the cameras that they were sampled from."""

import json
import re
from io import BytesIO

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras import ray_table
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.report.accuracy import Accuracy
from camera_ray_caster.core.report.report import as_json, as_lines, report_cast

from .model_examples import camera
from .table_examples import pinhole, stacked

FRAME = 96, 54
SAMPLED = [
    ("PERSP", {"lens": 18.0}),
    ("FISHEYE_EQUIDISTANT", {"fisheye_fov": 3.0}),
    ("EQUIRECTANGULAR", {"longitude_min": -1.5, "longitude_max": 1.2, "latitude_min": -1.0, "latitude_max": 1.1}),
    ("OPENCV_PINHOLE", {"fx": 60.0, "fy": 60.0, "cx": 47.5, "cy": 26.5, "calibration_width": 96,
                        "calibration_height": 54, "k1": -0.2, "k2": 0.04, "p1": 0.004}),
    ("CROSS_SLIT", {"lens": 18.0}),
    ("TWISTED_ORTHOGRAPHIC", {"twist": 0.3, "ortho_scale": 8.0}),
]  # fmt: skip
each_sampled = pytest.mark.parametrize(("key", "settings"), SAMPLED, ids=[key for key, _ in SAMPLED])


def sampled(cam, columns=32, rows=18, **settings):
    """The table of a camera's rays at the centers of entries, which are larger than pixels."""
    width, height = cam.raster.size
    rays = cam.rays_at((np.arange(columns) + 0.5) * width / columns, (np.arange(rows)[:, None] + 0.5) * height / rows)
    origins = None if cam.model.central else rays.origins
    return crc.camera("RAY_TABLE", cam.raster.size, ray_directions=rays.directions, ray_origins=origins, **settings)


def everywhere(cam, count=3000):
    return (np.random.default_rng(4).uniform(0, 1, (count, 2)) * cam.raster.size).T


@pytest.mark.cases(1)
@each_sampled
@pytest.mark.parametrize("kind", ["CUBIC", "LINEAR"])
def test_the_error_between_entries_is_what_the_report_estimates(key, settings, kind):
    """At most twice the estimate, and at least a tenth of it: both are of the worst place, but of different ones."""
    cam = camera(key, settings)
    table = sampled(cam, ray_interpolation=kind)
    x, y = everywhere(cam)
    rays, of_table = cam.rays_at(x, y), table.rays_at(x, y)
    both = rays.valid & of_table.valid
    assert both.mean() > 0.95 * rays.valid.mean()
    angle = np.linalg.norm(rays.directions - of_table.directions, axis=1)[both].max()
    facts = table.model.facts()
    assert facts["interpolation_error"] / 10 <= angle <= 2 * facts["interpolation_error"]
    if not cam.model.central:
        off = np.linalg.norm(rays.origins - of_table.origins, axis=1)[both].max()
        estimate = facts["interpolation_error_of_origins"]
        assert estimate / 10 - 32 * EPS <= off <= 2 * estimate + 32 * EPS


@pytest.mark.cases(1)
@each_sampled
def test_finer_tables_are_nearer_to_their_camera(key, settings):
    """By 2^3 at least with twice the entries, and the entries themselves are rays of the table."""
    cam = camera(key, settings)
    x, y = everywhere(cam)
    errors = []
    for fine in (1, 2, 4):
        table = sampled(cam, 24 * fine, 14 * fine)
        rays, of_table = cam.rays_at(x, y), table.rays_at(x, y)
        inside = np.abs(np.stack((x, y), 1) / FRAME - 0.5).max(axis=1) < 0.45
        whole = rays.valid & of_table.valid & inside
        if key == "FISHEYE_EQUIDISTANT":
            whole &= np.hypot(x - 48, y - 27) < 38
        errors.append(np.linalg.norm(rays.directions - of_table.directions, axis=1)[whole].max())
        u, v = (np.arange(24 * fine) + 0.5) * 4 / fine, (np.arange(14 * fine)[:, None] + 0.5) * 54 / 14 / fine
        exact, other = cam.rays_at(u, v), table.rays_at(u, v)
        np.testing.assert_array_equal(exact.valid, other.valid)
        np.testing.assert_allclose(other.directions, exact.directions, rtol=0, atol=16 * EPS)
        np.testing.assert_allclose(other.origins, exact.origins, rtol=0, atol=32 * EPS)
    assert errors[1] < errors[0] / 8
    assert errors[2] < errors[1] / 8


@pytest.mark.cases(1)
@each_sampled
def test_the_inverse_finds_the_pixel_of_every_ray(key, settings):
    table = sampled(camera(key, settings))
    x, y = everywhere(table)
    rays = table.rays_at(x, y)
    points = (rays.origins + np.random.default_rng(1).uniform(1, 50, (len(x), 1)) * rays.directions)[rays.valid]
    off = np.abs(table.project(points) - np.stack((x, y), axis=1)[rays.valid])
    assert off.max() <= 1e-9


@pytest.mark.cases(1)
@each_sampled
def test_ray_maps_are_tables_of_the_same_rays(key, settings, tmp_path):
    """In the camera's place and in another, also of a part of the picture."""
    border = {"use_border": True, "border_min_x": 0.25, "border_max_x": 0.75, "border_max_y": 0.5}
    turned = np.array(((0, -1, 0, 3), (1, 0, 0, -2), (0, 0, 1, 5), (0, 0, 0, 1.0)))
    for window in ({}, border):
        cam = camera(key, settings | window | {"matrix_world": turned})
        (path,) = crc.export(cam, tmp_path, "npz").paths
        table = crc.load_calibration(path, pose=turned)
        assert (table.model.key, table.raster.size) == ("RAY_TABLE", FRAME)
        exact, other = cam.rays(), table.rays_at(cam.raster.columns(), cam.raster.rows())
        np.testing.assert_array_equal(exact.valid, other.valid)
        np.testing.assert_allclose(other.directions, exact.directions, rtol=0, atol=32 * EPS)
        np.testing.assert_allclose(other.origins, exact.origins, rtol=0, atol=64 * EPS)
        assert crc.load_calibration(path, size=(48, 27)).raster.size == (48, 27)
        path.unlink()


def test_half_an_entry_beyond_the_outermost_centers_the_table_is_continued():
    """Exactly where rays change as a parabola does: origins here. Further out there are none."""
    x, y = np.arange(8.0)[None], np.arange(6.0)[:, None]
    origins = stacked((x + 5) ** 2 / 10, y - x * y / 8, 0.0)
    table = crc.camera("RAY_TABLE", (80, 60), ray_directions=np.full((6, 8, 3), (0, 0, -1.0)), ray_origins=origins)
    u, v = np.linspace(0, 80, 41), np.linspace(0, 60, 31)[:, None]
    rays = table.rays_at(u, v)
    assert rays.valid.all()
    i, j = u / 10 - 0.5, v / 10 - 0.5
    np.testing.assert_allclose(rays.origins, stacked((i + 5) ** 2 / 10, j - i * j / 8, 0.0), rtol=0, atol=1e-5)
    assert not table.rays_at([-0.1, 80.1, 40, 40], [30, 30, -0.1, 60.1]).valid.any()


def test_holes_are_squares_without_rays_and_their_neighbors_are_not_bent():
    table = pinhole(48, 36)
    whole = crc.camera("RAY_TABLE", (96, 72), ray_directions=table)
    table[10:14, 20:26] = np.nan
    cam = crc.camera("RAY_TABLE", (96, 72), ray_directions=table)
    x, y = everywhere(cam)
    inside = (x > 40) & (x < 52) & (y > 20) & (y < 28)
    rays = cam.rays_at(x, y)
    np.testing.assert_array_equal(rays.valid, ~inside)
    off = np.abs(rays.directions - whole.rays_at(x, y).directions)[~inside].max()
    assert off < 5e-5  # half an entry beyond: 0.31 h^3 times the third derivative
    assert cam.model.facts()["entries_without_ray"] == 24
    assert np.isnan(cam.project(whole.rays_at(x[inside], y[inside]).directions)).all()


def test_origins_that_jump_along_their_rays_may_be_slid():
    cam = camera("CROSS_SLIT", {"lens": 18.0})
    x, y = (np.arange(48) + 0.5) * 2, (np.arange(27)[:, None] + 0.5) * 2
    rays = cam.rays_at(x, y)
    jumps = rays.origins + np.random.default_rng(3).uniform(-0.1, 0.1, (27, 48, 1)) * rays.directions
    table = {"ray_directions": rays.directions, "ray_origins": jumps}
    x, y = everywhere(cam)
    expected = cam.rays_at(x, y)
    off = []
    for slide in (False, True):
        of_table = crc.camera("RAY_TABLE", FRAME, **table, ray_slide=slide).rays_at(x, y)
        off.append(np.linalg.norm(np.cross(of_table.origins - expected.origins, expected.directions), axis=1).max())
    assert off[1] < 1e-4 < 1e-3 < off[0]


def test_a_table_larger_than_the_memory_is_refused_before_it_is_copied():
    huge = np.broadcast_to(np.zeros(3), (200_000, 100_000, 3))
    with pytest.raises(crc.InputError, match=r"GiB of memory .*give a coarser table"):
        crc.camera("RAY_TABLE", FRAME, ray_directions=huge)


def test_the_cameras_of_a_rig_are_moved_without_preparing_their_tables_again(monkeypatch):
    monkeypatch.setattr(ray_table, "_latest", {})
    rig = [crc.camera("RAY_TABLE", FRAME, ray_directions=pinhole() * (1, 1, 1 + k / 8)) for k in range(8)]
    moved = [cam.with_pose(np.eye(4)).model.grid for cam in rig]
    assert all(grid is cam.model.grid for grid, cam in zip(moved, rig, strict=True))
    monkeypatch.setattr(ray_table, "LARGE", 3 * pinhole().size)
    for count in (4, 5):  # of large ones, four at once
        monkeypatch.setattr(ray_table, "_latest", {})
        moved = [cam.with_pose(np.eye(4)).model.grid for cam in 2 * rig[:count]]
        assert (moved[:count] == moved[count:]) == (count == 4)


def test_rays_that_are_the_same_or_cross_are_named_as_the_cause():
    same, random = np.broadcast_to((0.0, 0.0, -1.0), (12, 16, 3)), np.random.default_rng(0).normal(size=(12, 16, 3))
    for table in ({"ray_directions": same}, {"ray_directions": pinhole(16, 12), "ray_origins": random}):
        with pytest.raises(crc.InputError, match="its rays are the same or cross each other"):
            crc.camera("RAY_TABLE", FRAME, **table)


def saved(**arrays):
    content = BytesIO()
    np.savez(content, **arrays)
    return content.getvalue()


def array_file(array):
    content = BytesIO()
    np.save(content, array)
    return content.getvalue()


def test_arrays_of_numpy_are_tables(tmp_path):
    six = np.concatenate((pinhole() * (1, 1, 0), pinhole()), axis=2).astype(np.float32)
    (tmp_path / "six.npy").write_bytes(array_file(six))
    (tmp_path / "three.npy").write_bytes(array_file(pinhole()))
    loaded = crc.load_calibration(tmp_path / "six.npy")
    assert loaded.raster.size == (24, 18)
    rays = loaded.rays()
    np.testing.assert_allclose(rays.origins, six[..., :3], rtol=0, atol=8 * EPS)
    unit = six[..., 3:] / np.linalg.norm(six[..., 3:], axis=2)[..., None]
    np.testing.assert_allclose(rays.directions, unit, rtol=0, atol=1e-7)
    assert crc.load_calibration(tmp_path / "three.npy").model.central
    both = crc.camera("RAY_TABLE", (48, 36), calibration_file=tmp_path / "three.npy", ray_interpolation="LINEAR")
    assert both.model.grid.kind == "LINEAR"


def encrypted(data):
    """The file with the marks of encrypted entries."""
    for mark, offset in ((b"PK\x03\x04", 6), (b"PK\x01\x02", 8)):
        for header in re.finditer(re.escape(mark), bytes(data)):
            data = data[: header.start() + offset] + b"\x01" + data[header.start() + offset + 1 :]
    return data


BAD = {
    "encrypted": (encrypted(saved(directions=pinhole())), "encrypted"),
    "truncated": (saved(directions=pinhole())[:900], "damaged"),
    "no directions": (saved(origins=pinhole()), "no directions"),
    "shape": (saved(directions=pinhole()[0]), r"of shape \(24, 3\)"),
    "origins": (saved(directions=pinhole(), origins=pinhole()[1:]), "origins are of shape"),
    "valid": (saved(directions=pinhole(), valid=np.ones(5)), "valid is of shape"),
    "objects": (saved(directions=np.array([None, "a"])), "no array of numpy"),
    "words": (saved(directions=np.full((3, 3, 3), "a")), "directions is"),
    "pose": (saved(directions=pinhole(), pose=np.zeros((4, 4))), "pose must be"),
    "area": (saved(directions=pinhole(), area=np.zeros(4)), "area must be"),
    "times": (saved(directions=pinhole(), time=np.zeros((18, 24))), "their own times"),
    "cut npy": (array_file(pinhole())[:500], "damaged"),
    "no type": (array_file(pinhole()).replace(b"'<f8'", b"',f8'"), "damaged"),
    "no end": (array_file(pinhole()).replace(b"3), }", b"3), ("), "damaged"),
    "everywhere NaN": (array_file(pinhole() * np.nan), "no ray"),
}


@pytest.mark.parametrize("name", BAD)
def test_files_that_are_no_table_are_refused_in_one_line(name, tmp_path):
    content, word = BAD[name]
    path = tmp_path / "table.bin"
    path.write_bytes(content)
    with pytest.raises(crc.InputError, match=word) as caught:
        crc.load_calibration(path)
    assert "\n" not in str(caught.value)
    assert str(path) in str(caught.value)


def test_exports_take_a_table_as_it_is_or_refuse_it_by_name(tmp_path):
    """STMaps only of rays with one eye."""
    central = crc.camera("RAY_TABLE", (24, 18), ray_directions=pinhole())
    apart = crc.camera("RAY_TABLE", (24, 18), ray_directions=pinhole(), ray_origins=pinhole() * (0.1, 0.1, 0))
    for cam, able in ((central, r"stmap, npz, json, or Fit Nearest Lens \(--fit\)"), (apart, "npz, json")):
        for name in ("colmap", "nerfstudio", "opencv", "ros", "kalibr", "mrcal", "bop"):
            with pytest.raises(crc.InputError, match=f"Ray Table of camera 'Camera'.*choose one of .*{able}$"):
                crc.export(cam, tmp_path, name)
        (path,) = crc.export(cam, tmp_path, "json").paths
        again = crc.camera_from_json(path)
        np.testing.assert_array_equal(again.rays().directions, cam.rays().directions)
        np.testing.assert_array_equal(again.rays().origins, cam.rays().origins)
    assert len(crc.export(central, tmp_path, "stmap").paths) == 2
    with pytest.raises(crc.InputError, match="no eye in common"):
        crc.export(apart, tmp_path, "stmap")


def test_a_report_states_the_errors_and_holds_small_tables_only():
    shapes = crc.spheres([(0, 0, -4)], 1.0)
    for table, held in ((pinhole(), True), (pinhole(200, 126), False)):
        cam = crc.camera("RAY_TABLE", (24, 18), ray_directions=table)
        images = crc.cast(cam, shapes, passes="depth")
        seconds = dict.fromkeys(("read", *images.seconds), 0.0)
        report = report_cast(cam, shapes, images, seconds, (), 1.0, "", accuracy=Accuracy())
        assert any(line.startswith("  interpolation error  ") for line in as_lines(report))
        document = json.loads(as_json(report))
        assert (document["record"] is not None) == held
        if held:
            again = crc.camera_from_json(as_json(report))
            np.testing.assert_array_equal(again.rays().directions, cam.rays().directions)


@pytest.mark.parametrize(("key", "settings"), [SAMPLED[k] for k in (0, 2, 3)])
def test_the_spline_is_as_near_as_one_without_knots_beside_its_ends(key, settings):
    """By the not-a-knot spline of another library, also half an entry beyond the outermost entries."""
    interpolate = pytest.importorskip("scipy.interpolate")
    cam = camera(key, settings)
    x, y = np.arange(24) * 4 + 2.0, np.arange(18) * 3 + 1.5
    inside, table = cam.rays_at(x, y[:, None]).directions, sampled(cam, 24, 18)
    u, v = np.linspace(0, 96, 97), np.linspace(0, 54, 55)
    right = cam.rays_at(u, v[:, None]).directions
    other = interpolate.CubicSpline(y, interpolate.CubicSpline(x, inside, axis=1)(u), axis=0)(v)
    other /= np.linalg.norm(other, axis=2, keepdims=True)
    off, others = (np.nanmax(np.linalg.norm(rays - right, axis=2)) for rays in
                   (table.rays_at(u, v[:, None]).directions, other))  # fmt: skip
    assert off <= 1.5 * others
