"""Exports of lenses that a format does not have: the nearest one, with its error in the files and the remarks."""

import json
import re

import cv2
import numpy as np
import pytest
import yaml

import camera_ray_caster as crc
from camera_ray_caster.core.exports import EXPORT_FORMATS, export_files
from camera_ray_caster.core.exports.of_program import ProgramFormat
from camera_ray_caster.core.records import InputError

from ..colmap import colmap, read
from .shots import shots

ERROR = re.compile(r"at most ([\d.e+-]+) and in the mean ([\d.e+-]+) pixels away")


def files(key, name, fit, frames=(1, 12)):
    made, remarks = export_files(key, shots(name, frames), fit)
    return dict(made), remarks


@pytest.mark.full
@pytest.mark.parametrize(("name", "kind"), [("division", "FISHEYE624"), ("eucm", "FISHEYE624")])
def test_opencv_reads_the_nearest_lens_and_errs_as_it_says(name, kind, tmp_path):
    """Each pixel's ray, projected by OpenCV with the written numbers."""
    made, remarks = files("opencv", name, 1.0)
    (text,) = made.values()
    remark = next(line for line in remarks if line.startswith(name))
    assert text.startswith(f"%YAML:1.0\n---\n# {remark}\n")
    (tmp_path / "a.yml").write_text(text)
    file = cv2.FileStorage(str(tmp_path / "a.yml"), cv2.FILE_STORAGE_READ)
    K, D = file.getNode("camera_matrix").mat(), file.getNode("distortion_coefficients").mat()
    camera = shots(name, (1,))[0].camera
    x, y = np.meshgrid(np.arange(640) + 0.5, np.arange(480) + 0.5)
    rays = np.stack(np.broadcast_arrays(*camera.model.rays(x, y)[1]), axis=-1)
    there = np.arctan2(np.hypot(rays[..., 0], rays[..., 1]), -rays[..., 2]) <= 1.0
    points = (rays[there] / -rays[there][:, 2:] * (1, -1, -1))[None]
    still = np.zeros(3)
    project = cv2.fisheye.projectPoints if file.getNode("fisheye_model").real() else cv2.projectPoints
    if file.getNode("xi").empty():
        pixels = project(points, still, still, K, D)[0].reshape(-1, 2)
    else:
        pixels = cv2.omnidir.projectPoints(points, still, still, K, file.getNode("xi").real(), D)[0].reshape(-1, 2)
    away = np.hypot(*(pixels - np.stack((x[there] - 0.5, 479.5 - y[there]), axis=-1)).T)
    worst, mean = map(float, ERROR.search(remark).groups())
    assert worst == pytest.approx(away.max(), rel=0.06)  # two digits
    assert mean == pytest.approx(away.mean(), rel=0.06)


@pytest.mark.parametrize("key", [kind.key for kind in EXPORT_FORMATS if isinstance(kind, ProgramFormat) and kind.table])
def test_every_format_of_lenses_states_the_error(key):
    if key == "nerf":  # has one focal length, and the center in the middle
        with pytest.raises(InputError, match="no lens of NeRF can be fitted to the Field of View"):
            files(key, "fov", 0.6)
        return
    made, remarks = files(key, "stereographic" if key == "kalibr" else "fov", 0.6 if key != "bop" else 0.2, (1,))
    fits = [line for line in remarks if "fitted to its" in line]
    if key == "colmap":  # has this lens itself
        assert not fits
        return
    for name, content in made.items():
        assert "fitted to its" in content or not fits, name
        if name.endswith(".json"):
            json.loads(content)
        if name.endswith("yaml"):
            yaml.safe_load(content)


def test_colmap_s_text_is_read_with_its_head(tmp_path):
    made, remarks = files("colmap", "omnidir", 1.0)
    assert "omnidir: fitted to its Unified (UCM, Mei), within 57.3 degrees" in remarks[-1]
    for name, text in made.items():
        assert text.startswith(f"# {remarks[-1]}\n")
        (tmp_path / name).write_text(text)
    cameras, images = colmap(read, str(tmp_path))
    assert (len(cameras), len(images)) == (1, 2)


def test_what_a_format_has_is_written_as_before():
    for name in ("fisheye", "pinhole"):
        assert files("opencv", name, 3.0) == files("opencv", name, None)


def test_what_is_far_from_all_lenses_is_refused_in_one_line(tmp_path):
    fisheye = crc.camera("MIRRORBALL", (64, 64))
    for arguments, words in (
        (("bop", fisheye, True), "no lens of BOP is like the Mirror Ball|can be fitted"),
        (("opencv", crc.camera("ORTHO", (64, 64)), True), "OpenCV cannot represent the Orthographic"),
        (("opencv", fisheye, 4.0), "fit is 4.0: as an angle it must be above 0, up to pi"),
    ):
        key, camera, fit = arguments
        with pytest.raises(InputError, match=words) as caught:
            crc.export(camera, tmp_path / "out", key, fit=fit)
        assert "\n" not in str(caught.value)
        assert not (tmp_path / "out").exists()
