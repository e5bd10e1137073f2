"""Render borders and percentages: pictures, depths, masks and lenses of every format are of one part of the frame."""

import json

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.exports import EXPORT_FORMATS, export_files
from camera_ray_caster.core.exports.file_writer import write
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.sets import SET_FORMATS, read_set

from .test_sets import view

BORDER = {"use_border": True, "border_min_x": 0.25, "border_max_x": 0.75, "border_min_y": 0.125, "border_max_y": 0.5}
CROP = BORDER | {"use_crop_to_border": True}
CASES = [(CROP, 50), (BORDER, 100), ({}, 100), (BORDER, 50), (CROP, 100), ({}, 50)]
NO_LENS = {"tum", "kitti", "euroc", "npz", "stmap", "yolo", "panoptic", "masks", "depth16", "normals", "preview"}
"""Formats without lenses."""


@pytest.fixture(params=CASES, ids=["crop 50", "border 100", "whole 100", "border 50", "crop 100", "whole 50"])
def cropped_set(request, tmp_path):
    """The folder of a set; size and left and top end of its pictures in the frame; camera and images of a view."""
    border, percentage = request.param
    folder = tmp_path / "set"
    folder.mkdir()
    scale = percentage / 100
    settings = {"resolution_percentage": percentage, "shift_x": 0.05, "pixel_aspect_x": 1.5, **border}
    cam, images = view(folder, 1, **settings)
    # by hand: columns 24 to 48 .. 72 of 96, rows 9 to 36 of 72 from the bottom, at half the size rows 4 to 18
    width, height, left, top = (48, 27, 24, 36) if border is CROP else (96, 72, 0, 0)
    size = int(width * scale), {27: 14}.get(int(height), 36) if percentage == 50 else height
    return folder, size, (int(left * scale), int(top * scale)), cam, images


def points_in(cam, corner):
    """World points of the window's pixels, and columns and rows of their pixels in the picture from the top left."""
    rays, raster = cam.rays(), cam.raster
    columns, rows = np.meshgrid(np.arange(raster.x0, raster.x1), np.arange(raster.y0, raster.y1))
    pixels = np.stack((columns - corner[0], raster.height - 1 - rows - corner[1]), axis=-1)
    return (rays.origins + 3 * rays.directions).reshape(-1, 3), pixels.reshape(-1, 2)


def check_lens(path, size, corner, cam):
    (lens,) = lenses_of(str(path), "", size)
    settings = lens.settings
    points, pixels = points_in(cam, corner)
    x, y, z = cam.opencv_from_world[:3, :3] @ points.T + cam.opencv_from_world[:3, 3:]
    projected = np.stack((settings["fx"] * x / z + settings["cx"], settings["fy"] * y / z + settings["cy"]), axis=-1)
    assert np.abs(projected - pixels).max() < 1e-4  # rotations that are near to float32 matrices
    assert (settings.get("calibration_width") or size[0], settings.get("calibration_height") or size[1]) == size


@pytest.mark.one_for_each("key")
@pytest.mark.parametrize("key", [export.key for export in EXPORT_FORMATS])
def test_cameras_are_those_of_the_picture(cropped_set, key, tmp_path):
    folder, size, corner, cam, _ = cropped_set
    shots = [entry.shot for entry in read_set(folder)]
    if key == "nerf":  # square pixels, the center in the middle
        with pytest.raises(InputError, match="camera_angle_x alone does not say"):
            export_files(key, shots)
        return
    if key == "stmap":
        for name, st in export_files(key, shots)[0]:
            assert st.shape[1::-1] == size
            if "undistort" in name:  # to the perspective of the same lens: the picture's own places, from the bottom
                assert np.allclose(st[0, :, 0], (np.arange(size[0]) + 0.5) / size[0], atol=1e-6)
                assert np.allclose(st[:, 0, 1], (np.arange(size[1]) + 0.5) / size[1], atol=1e-6)
        return
    paths = write(export_files(key, shots)[0], tmp_path / key)
    if key == "json":
        facts = json.loads(paths[0].read_text())["cameras"][0]["all_frames"]["camera"]
        seen = facts.get("picture", {"size": facts["raster"], "K": facts["K"]})
        assert seen["size"] == list(size)
        points, pixels = points_in(cam, corner)
        projected = (cam.opencv_from_world[:3, :3] @ points.T).T + cam.opencv_from_world[:3, 3]
        projected = projected @ np.array(seen["K"]).T
        assert np.abs(projected[:, :2] / projected[:, 2:] - pixels).max() < 1e-9
    elif key not in NO_LENS:
        check_lens(paths[0], size, corner, cam)


@pytest.mark.one_for_each("key")
@pytest.mark.parametrize("key", SET_FORMATS)
def test_files_of_sets_are_of_one_size(cropped_set, key, tmp_path):
    folder, size, corner, cam, images = cropped_set
    out = tmp_path / "out"
    write(SET_FORMATS[key].files(read_set(folder)), out)
    pictures = {path: cv2.imread(str(path), cv2.IMREAD_UNCHANGED) for path in out.rglob("*.png") if key != "preview"}
    assert {picture.shape[1::-1] for picture in pictures.values()} <= {size}
    _, pixels = points_in(cam, corner)
    columns, rows = pixels.T
    inside = np.zeros(size[::-1], bool)
    inside[rows, columns] = True
    depth = images["depth"].ravel()
    depth = np.where(np.isfinite(depth), depth, 0)
    for path, picture in pictures.items():
        if "depth" in str(path.relative_to(out)):
            assert (picture[~inside] == 0).all()
            step = {"depth16": 2, "nerfstudio-scene": 1}.get(key)  # millimeters: a unit is half a meter
            step = step or json.loads((out / "test/000000/scene_camera.json").read_text())["1"]["depth_scale"] * 2
            assert np.abs(picture[rows, columns] * step - 1000 * depth).max() <= step
        if "mask" in str(path.relative_to(out)):
            assert (picture[~inside] == 0).all()
    lens = {"nerfstudio-scene": "transforms.json", "colmap-scene": "sparse/0/cameras.txt",
            "bop-scenes": "test/000000/scene_camera.json"}.get(key)  # fmt: skip
    assert (lens is None) == (key in NO_LENS)
    if lens is not None:
        check_lens(out / lens, size, corner, cam)
    if key == "colmap-scene":
        lines = [line.split() for line in (out / "sparse/0/images.txt").read_text().splitlines() if line[:1] != "#"]
        seen = np.reshape(list(map(float, lines[1])), (-1, 3))
        assert len(seen) > 100
        assert ((seen[:, :2] >= 0) & (seen[:, :2] <= size)).all()
        assert inside[seen[:, 1].astype(int), seen[:, 0].astype(int)].all()
