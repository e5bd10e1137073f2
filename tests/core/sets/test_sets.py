"""Finished sets for other programs: against OpenCV, pycolmap, and the casts that they were made from."""

import json

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.annotations.coco import Sheet, document
from camera_ray_caster.core.camera.facts import camera_facts
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.camera_json import recorded
from camera_ray_caster.core.exports.file_writer import write
from camera_ray_caster.core.records import PLANE, SPHERE, InputError
from camera_ray_caster.core.sets import SET_FORMATS, chosen, read_set, with_splits
from camera_ray_caster.core.sets.png import png

from ..cameras.model_examples import camera
from ..casting.test_cast import shapes_of
from ..colmap import colmap, errors

SHAPES = shapes_of((SPHERE, (0, 0, -5), 1.0), (SPHERE, (0.8, 0.3, -4), 0.4), (PLANE, (0, 0, -7), 4.0))
PASSES = "combined", "depth", "distance", "shape_index", "normal"
SIZE = 96, 72


def view(folder, frame, key="PERSP", **settings):
    """A picture of the shapes, a little to the side in each frame, as the commands write it."""
    matrix = np.eye(4)
    matrix[0, 3] = 0.3 * frame
    raw = {"resolution_x": SIZE[0], "resolution_y": SIZE[1], "lens": 30.0, "matrix_world": matrix}
    cam = camera(key, raw | settings)
    images = cast(cam, SHAPES, passes=PASSES)
    name = f"{key}_{frame:04}"
    np.savez(folder / f"{name}.npz", **{key: images[key] for key in PASSES})
    (folder / f"{name}.png").write_bytes(png(np.zeros((*cam.raster.picture_size[::-1], 3), np.uint8)))
    doc = document({"file_name": f"{name}.png"}, Sheet.of(cam.raster), cam, SHAPES, lambda name: name.replace(" ", "_"))
    (folder / f"{name}_coco.json").write_text(json.dumps(doc))
    report = {"frame": frame, "camera": camera_facts(cam) | {"name": key}, "record": None, **recorded(cam), "views": {},
              "host": {"meters": 0.5}, "made": {"files": {f"{name}.npz": 1}}}  # fmt: skip
    report["record"] = recorded(cam)
    (folder / f"{name}.json").write_text(json.dumps(report))
    return cam, images


@pytest.fixture
def written_set(tmp_path):
    """The folder of a set, and the cameras and casts of its two pictures."""
    folder = tmp_path / "set"
    folder.mkdir()
    return folder, [view(folder, frame) for frame in (1, 2)]


def exported(folder, key, **more):
    write(SET_FORMATS[key].files(read_set(folder), **more), folder / "out")
    return folder / "out"


def test_a_set_has_the_cameras_and_passes_that_were_cast(written_set):
    folder, casts = written_set
    for entry, (cam, images) in zip(read_set(folder), casts, strict=True):
        assert (entry.camera.rays().directions == cam.rays().directions).all()
        points, hit = entry.points()
        assert (hit == np.isfinite(images["depth"])).all()
        ends = cam.rays().origins + images["distance"].astype(float)[..., None] * cam.rays().directions
        assert np.allclose(points[hit], ends[hit], atol=1e-6)
    with pytest.raises(InputError, match="has no pass uv: cast the set with --passes uv"):
        entry.pixels("uv")
    with pytest.raises(InputError, match="has no pictures with reports"):
        read_set(folder / "none")


def test_a_set_may_have_more_views_than_files_can_be_open(written_set):
    resource = pytest.importorskip("resource")
    folder, _ = written_set
    for number in range(3, 103):
        for end in (".npz", ".json"):
            text = (folder / f"PERSP_0001{end}").read_bytes()
            (folder / f"PERSP_{number:04}{end}").write_bytes(text.replace(b"PERSP_0001", b"PERSP_%04d" % number))
    before = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (80, before[1]))
    try:
        views = read_set(folder)
        assert len(views) == 102
        assert all(entry.has("depth") for entry in views)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, before)


@pytest.mark.parametrize("damage", ["arrays", "directory"])
def test_a_damaged_file_is_refused_in_one_line(written_set, damage):
    folder, _ = written_set
    path = folder / "PERSP_0001.npz"
    data = path.read_bytes()
    path.write_bytes(data[:5000] + bytes(40) + data[5040:] if damage == "arrays" else data[:-500])
    first = read_set(folder)[0]
    with pytest.raises(InputError, match=r"PERSP_0001.npz' (is damaged: delete it|cannot be read: make the set)"):
        [first.pixels(key) for key in PASSES]


def test_trajectories_have_the_set_s_own_time(written_set):
    folder, _ = written_set
    for rate, seconds in ((None, (1 / 24, 2 / 24)), (29.97, (1 / 29.97, 2 / 29.97))):
        for path in folder.glob("PERSP_000?.json"):
            report = json.loads(path.read_text())
            report["host"] |= {} if rate is None else {"frame_rate": rate}
            path.write_text(json.dumps(report))
        files, _ = export_files("tum", [entry.shot for entry in read_set(folder)])
        lines = [line for _, text in files for line in text.splitlines() if not line.startswith("#")]
        assert [float(line.split()[0]) for line in lines] == pytest.approx(seconds, abs=1e-6)


def test_pngs_are_what_opencv_reads(tmp_path):
    random = np.random.default_rng(1)
    for kind, shape in ((np.uint8, (5, 7)), (np.uint16, (5, 7)), (np.uint16, (4, 3, 3)), (np.uint8, (4, 3, 4))):
        pixels = random.integers(0, np.iinfo(kind).max, shape).astype(kind)
        (tmp_path / "a.png").write_bytes(png(pixels))
        image = cv2.imread(str(tmp_path / "a.png"), cv2.IMREAD_UNCHANGED)
        order = {3: (2, 1, 0), 4: (2, 1, 0, 3)}.get(pixels.shape[-1] if pixels.ndim == 3 else 0)
        assert (image == (pixels if order is None else pixels[..., order])).all()


def test_a_bop_scene_has_objects_where_their_pixels_are(written_set):
    """Of a sphere's visible pixels, depth and K give points on the sphere about the pose of the object."""
    folder, _ = written_set
    scene = exported(folder, "bop-scenes") / "test" / "000000"
    gt, info, cameras = (json.loads((scene / f"scene_{name}.json").read_text()) for name in ("gt", "gt_info", "camera"))
    assert list(gt) == ["1", "2"]
    depth = cv2.imread(str(scene / "depth" / "000001.png"), cv2.IMREAD_UNCHANGED) * cameras["1"]["depth_scale"]
    K = np.reshape(cameras["1"]["cam_K"], (3, 3))
    for k, (radius, pose, facts) in enumerate(zip((1.0, 0.4), gt["1"], info["1"], strict=False)):
        visible = cv2.imread(str(scene / "mask_visib" / f"000001_{k:06}.png"), cv2.IMREAD_UNCHANGED) > 0
        whole = cv2.imread(str(scene / "mask" / f"000001_{k:06}.png"), cv2.IMREAD_UNCHANGED) > 0
        assert (visible <= whole).all()
        assert (visible.sum(), whole.sum()) == (facts["px_count_visib"], facts["px_count_all"])
        row, column = np.nonzero(visible)
        points = np.linalg.inv(K) @ (column, row, np.ones(len(row))) * depth[visible]
        away = np.linalg.norm(points.T - pose["cam_t_m2c"], axis=1)
        assert np.abs(away - 500 * radius).max() < 0.2  # millimeters: two steps of depth, in meters of half a unit
    models = json.loads((folder / "out" / "models" / "models_info.json").read_text())
    assert models["1"]["size_x"] == pytest.approx(1000)
    view(folder, 3, "FISHEYE_EQUIDISTANT", fisheye_fov=3.0)
    with pytest.raises(InputError, match="BOP has pinholes only, and camera"):
        exported(folder, "bop-scenes")


def test_seed_points_are_seen_where_colmap_projects_them(written_set):
    folder, _ = written_set
    out = exported(folder, "colmap-scene", count=500)
    errors_of = colmap(errors, str(out / "sparse" / "0"))
    assert len(errors_of) == 500
    assert max(worst for worst, _ in errors_of) < 1e-9
    seen = [length for _, length in errors_of]
    assert 1.5 < np.mean(seen) <= 2
    assert min(seen) >= 1
    assert (out / "images" / "PERSP_0001.png").is_file()


def test_panoptic_and_yolo_are_the_index_pass(written_set):
    folder, casts = written_set
    out = exported(folder, "panoptic")
    index = casts[0][1]["shape_index"][::-1]
    blue, green, red = np.moveaxis(cv2.imread(str(out / "panoptic" / "PERSP_0001.png")).astype(int), 2, 0)
    assert (red + 256 * green + 65536 * blue == index + 1).all()
    segments = json.loads((out / "panoptic.json").read_text())["annotations"][0]["segments_info"]
    assert {segment["id"]: segment["area"] for segment in segments} == {k + 1: (index == k).sum() for k in range(3)}
    out = exported(folder, "yolo")
    lines = [list(map(float, line.split())) for line in (out / "labels" / "PERSP_0001.txt").read_text().splitlines()]
    row, column = np.nonzero(index == 0)
    ends = column.min(), column.max() + 1, row.min(), row.max() + 1
    box = [(ends[0] + ends[1]) / 192, (ends[2] + ends[3]) / 144, (ends[1] - ends[0]) / 96, (ends[3] - ends[2]) / 72]
    assert np.allclose(lines[0][1:], box, atol=1e-7)
    assert len(lines) == 3


def test_splits_are_by_frames_and_told_by_each_format(tmp_path):
    for frame in range(1, 6):
        for key in ("PERSP", "OPENCV_PINHOLE"):
            view(tmp_path, frame, key)
    views = with_splits(read_set(tmp_path), 0.4)
    held = {entry.name for entry in views if entry.split == "val"}
    assert held == {f"{key}_{frame:04}" for key in ("PERSP", "OPENCV_PINHOLE") for frame in (2, 4)}
    for key, set_format in SET_FORMATS.items():
        if set_format.splits:
            write(set_format.files(views), tmp_path / key)
    for split, count in (("train", 6), ("val", 4)):
        names = {path.stem for path in (tmp_path / "yolo" / "images" / split).iterdir()}
        assert names == {path.stem for path in (tmp_path / "yolo" / "labels" / split).iterdir()}
        assert (names == held, len(names)) == (split == "val", count)
        assert f"{split}: images/{split}\n" in (tmp_path / "yolo" / "data.yaml").read_text()
        facts = json.loads((tmp_path / "panoptic" / f"panoptic_{split}.json").read_text())
        assert len(facts["annotations"]) == len(facts["images"]) == count
        assert {image["file_name"][:-4] for image in facts["images"]} == names
        transforms = json.loads((tmp_path / "nerfstudio-scene" / "transforms.json").read_text())
        assert {name[7:-4] for name in transforms[f"{split}_filenames"]} == names
        scenes = tmp_path / "bop-scenes" / split
        assert sum(len(list((scene / "rgb").iterdir())) for scene in scenes.iterdir()) == count
    assert {line[:-4] for line in (tmp_path / "colmap-scene/sparse/0/test.txt").read_text().split()} == held
    with pytest.raises(InputError, match="the set has one picture: it has no part for validation"):
        with_splits(chosen(views, ["PERSP"], [3]), 0.5)
    with pytest.raises(InputError, match="the set has no camera 'Fern', only OPENCV_PINHOLE, PERSP"):
        chosen(views, ["Fern"])
    with pytest.raises(InputError, match="the set has none of these frames, only 1 to 5"):
        chosen(views, [], [9])


def test_depth_and_normals_are_the_passes(written_set):
    folder, casts = written_set
    exported(folder, "depth16")
    out = exported(folder, "normals")
    _, images = casts[0]
    depth = cv2.imread(str(out / "PERSP_0001_depth.png"), cv2.IMREAD_UNCHANGED)[::-1]
    hit = np.isfinite(images["depth"])
    assert np.abs(depth[hit] - 500 * images["depth"][hit]).max() <= 0.5
    assert (depth[~hit] == 0).all()
    normal = cv2.imread(str(out / "PERSP_0001_normal.png"), cv2.IMREAD_UNCHANGED)[::-1, :, ::-1] / 65535 * 2 - 1
    assert np.abs(normal * (1, -1, -1) - images["normal"]).max() < 1e-4


def test_a_preview_shows_the_passes_side_by_side(written_set):
    folder, _ = written_set
    picture = cv2.imread(str(exported(folder, "preview") / "preview.png"))
    assert picture.shape == (72, 4 * 96, 3)
    assert len(np.unique(picture[:, 192:288].reshape(-1, 3), axis=0)) == 3 + (picture[:, 192:288] == 0).any()


def test_the_axes_of_a_report_are_its_camera_s(written_set):
    for view in read_set(written_set[0]):
        assert (view.basis == view.camera.pose.basis).all()


def test_masks_are_of_each_object(written_set):
    folder, casts = written_set
    out = exported(folder, "masks")
    visible = cv2.imread(str(out / "mask_visible" / "PERSP_0002_0000.png"), cv2.IMREAD_UNCHANGED) > 0
    assert (visible[::-1] == (casts[1][1]["shape_index"] == 0)).all()


def test_nerfstudios_frames_name_depths_and_masks(written_set):
    folder, casts = written_set
    out = exported(folder, "nerfstudio-scene")
    frame = json.loads((out / "transforms.json").read_text())["frames"][1]
    depth = cv2.imread(str(out / frame["depth_file_path"]), cv2.IMREAD_UNCHANGED)[::-1]
    _, images = casts[1]
    hit = np.isfinite(images["depth"])
    assert np.abs(depth[hit] - 1000 * images["depth"][hit]).max() <= 0.51
    assert (depth[~hit] == 0).all()
    assert (cv2.imread(str(out / frame["mask_path"]), cv2.IMREAD_UNCHANGED) == 255).all()
    assert (out / frame["file_path"]).is_file()


CASES = [(("depth", "distance"), 1), (("distance", "normal"), 2), (("normal",), 1)]


@pytest.mark.parametrize(("passes", "count"), CASES)
def test_a_preview_shows_the_distance_where_there_is_no_depth(tmp_path, passes, count):
    _, images = view(tmp_path, 1)
    np.savez(tmp_path / "PERSP_0001.npz", **{key: images[key] for key in passes})
    ((name, content),) = SET_FORMATS["preview"].files(read_set(tmp_path))
    shown = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR)
    assert (name, shown.shape[1]) == ("preview.png", count * SIZE[0])


METRIC = {"bop-scenes", "depth16"}
"""Formats with lengths in millimeters; the files of all others are the same at any Unit Scale."""


@pytest.mark.one_for_each("key")
@pytest.mark.parametrize("key", SET_FORMATS)
def test_lengths_of_sets_follow_the_unit_scale(written_set, key):
    folder, casts = written_set
    sets = {}
    for meters in (1.0, 0.01, 1000.0):
        for path in folder.glob("PERSP_000?.json"):
            report = json.loads(path.read_text())
            report["host"]["meters"] = meters
            path.write_text(json.dumps(report))
        sets[meters] = {name: content if isinstance(content, str | bytes) else "".join(content)
                         for name, content in SET_FORMATS[key].files(read_set(folder))}  # fmt: skip
        depth = np.where(np.isfinite(casts[0][1]["depth"]), casts[0][1]["depth"], 0)[::-1] * 1000 * meters
        if key == "bop-scenes":
            scene = "test/000000/"
            camera = json.loads(sets[meters][scene + "scene_camera.json"])["1"]
            pixels = cv2.imdecode(np.frombuffer(sets[meters][scene + "depth/000001.png"], np.uint8), -1)
            assert np.abs(pixels * camera["depth_scale"] - depth).max() <= camera["depth_scale"]
            assert np.allclose(camera["cam_t_w2c"], casts[0][0].opencv_from_world[:3, 3] * 1000 * meters, rtol=1e-6)
            truth = json.loads(sets[meters][scene + "scene_gt.json"])["1"]
            objects = {entry["obj_id"]: entry["cam_t_m2c"] for entry in truth}
            assert np.allclose(objects[1], np.array((-0.3, 0, 5)) * 1000 * meters, atol=1e-6 * meters)
            assert json.loads(sets[meters]["models/models_info.json"])["1"]["size_x"] == pytest.approx(2000 * meters)
        if key == "depth16":
            step = json.loads(sets[meters]["depth16.json"])["millimeters"]
            pixels = cv2.imdecode(np.frombuffer(sets[meters]["PERSP_0001_depth.png"], np.uint8), -1)
            assert np.abs(pixels * step - depth).max() <= step

    def words(files):  # without comments, which tell the unit
        return {name: [line for line in data.splitlines() if line[:1] != "#"] if isinstance(data, str) else data
                for name, data in files.items()}  # fmt: skip
    assert all(words(files) == words(sets[1.0]) for files in sets.values()) == (key not in METRIC)
