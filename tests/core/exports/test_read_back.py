"""What is written, read by our own readers of calibration files: the same camera."""

import numpy as np
import pytest

from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.programs.reading.lenses import lenses_of

from ..cameras.model_examples import camera
from .shots import CAMERAS, exported, shots, views

READ = {
    "colmap": "cameras.txt", "nerfstudio": "transforms.json", "opencv": "{}.yml", "ros": "{}.yaml",
    "mrcal": "{}_0001.cameramodel",
}  # fmt: skip
"""The file of each format that is read, too."""
PAIRS = [
    (export.key, name)
    for export in EXPORT_FORMATS
    for name in CAMERAS
    if export.key in READ and export.refusal(shots(name, [1])[0]) is None and CAMERAS[name][0] != "EQUIRECTANGULAR"
]


@pytest.mark.parametrize(("key", "name"), PAIRS)
def test_our_own_reader_makes_the_same_camera_of_it(tmp_path, key, name):
    (shot,) = shots(name, [1])
    exported(key, name, tmp_path, [1])
    path, raw = tmp_path / READ[key].format(name), shot.camera.record
    (lens,) = lenses_of(str(path), "OPENCV_PINHOLE")
    frame = {field: getattr(raw, field) for field in ("resolution_x", "resolution_y", "matrix_world")}
    back = camera(lens.model, frame | {"calibration_file": str(path)})
    ((points, _),) = views(name, frames=[1])
    assert np.abs(back.project(points) - shot.camera.project(points)).max() < 1e-9
