"""Calls of earlier versions: the result is that of the new form, and a DeprecationWarning names it."""

import numpy as np
import pytest

import camera_ray_caster as crc

SIZE = 16, 12
UP = 0, 1, 0
SPHERES = crc.spheres([(0, 0, -4)])
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
NORMALS = [(0, 0, 1)] * 3
CAMERA = crc.camera("PERSP", SIZE)
RAYS = (0, 0, 0), [(0, 0, -1), (0, 1, 0)]

CALLS = {
    "passes=, dtype=": (
        lambda: crc.cast(CAMERA, SPHERES, ("depth",), np.float64)["depth"],
        lambda: crc.cast(CAMERA, SPHERES, passes=("depth",), dtype=np.float64)["depth"],
    ),
    "passes=": (
        lambda: crc.cast_rays(*RAYS, SPHERES, "distance")["distance"],
        lambda: crc.cast_rays(*RAYS, SPHERES, passes="distance")["distance"],
    ),
    "tolerance=": (
        lambda: crc.visible(CAMERA, SPHERES, [(0, 0, -3)], 1.0),
        lambda: crc.visible(CAMERA, SPHERES, [(0, 0, -3)], tolerance=1.0),
    ),
    "up=": (lambda: crc.look_at((0, 0, 9), (0, 0, 0), UP), lambda: crc.look_at((0, 0, 9), (0, 0, 0), up=UP)),
    "normals=": (
        lambda: crc.mesh(CORNERS, [(0, 1, 2)], NORMALS).meshes[0].normals,
        lambda: crc.mesh(CORNERS, [(0, 1, 2)], normals=NORMALS).meshes[0].normals,
    ),
    "within=": (
        lambda: crc.fit(CAMERA, "OPENCV_FISHEYE", 0.2).worst,
        lambda: crc.fit(CAMERA, "opencv_fisheye", within=0.2).worst,
    ),
    "within=, free=": (
        lambda: crc.fit(CAMERA, "OPENCV_FISHEYE", free=("fx", "fy"), region=0.2).worst,
        lambda: crc.fit(CAMERA, "OPENCV_FISHEYE", free=("fx", "fy"), within=0.2).worst,
    ),
}


@pytest.mark.parametrize("words", CALLS)
def test_an_old_form_does_the_same_with_a_warning(words):
    old, new = CALLS[words]
    with pytest.warns(DeprecationWarning, match=f"keywords here: {words.split(', ')[0]}") as caught:
        result = old()
    assert caught[0].filename == __file__
    np.testing.assert_array_equal(result, new())


def test_the_format_of_files_came_first(tmp_path):
    new = crc.export(CAMERA, tmp_path / "new", format="json")
    with pytest.warns(DeprecationWarning, match=r"export takes \(cameras, path, format=...\)") as caught:
        old = crc.export("json", CAMERA, folder=tmp_path / "old")
    assert caught[0].filename == __file__
    assert old.paths[0].read_bytes() == new.paths[0].read_bytes()
    cloud = crc.scan(CAMERA, SPHERES)
    with pytest.warns(DeprecationWarning, match="save_points"):
        (path,) = crc.save_points("ply", cloud, tmp_path, "points")
    assert path == tmp_path / "points.ply"
    assert path.read_bytes() == crc.save_points(cloud, tmp_path / "b.ply").paths[0].read_bytes()


def test_the_ending_of_a_path_tells_the_format(tmp_path):
    cloud = crc.scan(CAMERA, SPHERES)
    for name, also in {"a.pcd": [], "a.bin": ["a.label"], "a.pcd.bin": ["a_lidarseg.bin", "a_panoptic.npz"]}.items():
        paths = crc.save_points(cloud, tmp_path / name / name).paths
        assert sorted(path.name for path in paths) == sorted([name, *also])
    for name, files in {"rig.json": 1, "left.yml": 1, "transforms.json": 1, "cameras.txt": 3, "left.npz": 1}.items():
        paths = crc.export(CAMERA, tmp_path / name / name).paths
        assert len(paths) == files
        assert tmp_path / name / name in paths
    assert pytest.approx(CAMERA.K, rel=1e-12) == crc.load_calibration(tmp_path / "left.yml" / "left.yml").K
    for name, message in {"a.exr": "2 files: give a folder", "a": "give format=", "a.txt": "give format="}.items():
        with pytest.raises(crc.InputError, match=message):
            crc.export(CAMERA, tmp_path / "no" / name)
    assert not (tmp_path / "no" / "a.exr").exists()


def test_words_are_known_in_any_case_and_functions_take_a_scene():
    scene = crc.Scene(CAMERA, SPHERES)
    depth = crc.cast(scene, passes=["Depth", "DEPTH"], shading="grid")
    assert list(depth) == ["depth"]
    assert (
        crc.camera("persp", SIZE, sensor_fit="vertical").model == crc.camera("PERSP", SIZE, sensor_fit="VERTICAL").model
    )
    seen = crc.visible(CAMERA, SPHERES, [(0, 0, -3)])
    assert (
        seen.tolist() == crc.visible(scene, [(0, 0, -3)]).tolist() == crc.visible(scene, points=[(0, 0, -3)]).tolist()
    )
    assert str(crc.explain(scene, (8, 6))) == str(crc.explain(CAMERA, SPHERES, (8, 6)))
    assert len(crc.scan(scene)) == len(crc.scan(CAMERA, SPHERES))
    for call in (crc.visible, crc.explain):
        with pytest.raises(TypeError, match="takes a camera and shapes, or a scene"):
            call(SPHERES, CAMERA, (1, 2))


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"near": 1}, "did you mean clip_start"), ({"K": np.eye(3)}, "did you mean fx, fy, cx, cy"),
        ({"dist": [0.1]}, "did you mean k1, k2, p1, p2, k3"), ({"focal_length": 1}, "did you mean fx, fy"),
        ({"R": np.eye(3)}, "did you mean pose"), ({"width": 64}, "did you mean size"),
    ],
)  # fmt: skip
def test_names_of_other_libraries_lead_to_the_right_one(settings, message):
    with pytest.raises(crc.InputError, match=message):
        crc.camera("OPENCV_PINHOLE", SIZE, **settings)


@pytest.mark.parametrize(("word", "model"), {"orthographic": "ORTHO", "KannalaBrandt8": "OPENCV_FISHEYE"}.items())
def test_models_of_other_libraries_lead_to_the_right_one(word, model):
    with pytest.raises(crc.InputError, match=f"did you mean {model}"):
        crc.camera(word, SIZE)
    with pytest.raises(crc.InputError, match="use with_pose"):
        CAMERA.with_settings(pose=np.eye(4))
