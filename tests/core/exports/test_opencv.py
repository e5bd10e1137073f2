"""OpenCV's YAML against OpenCV."""

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera
from .shots import CAMERAS, FRAME, exported, shots, views

REFUSED = {"skewed": "skew is not 0", "eucm": "", "fisheye624": "", "thin_prism": "", "fov": "", "division": "",
           "panorama": "", "part": ""}  # fmt: skip
SAID = [name for name in CAMERAS if name not in REFUSED]


def read(path):
    """What OpenCV reads in a file: matrices, numbers and lists of numbers."""
    file = cv2.FileStorage(str(path), cv2.FILE_STORAGE_READ)
    root = file.root()
    nodes = {}
    for name in root.keys():  # noqa: SIM118 (it is no mapping)
        node = root.getNode(name)
        nodes[name] = node.mat() if node.isMap() else node.real() if not node.isSeq() else [
            node.at(i).real() for i in range(node.size())
        ]  # fmt: skip
    return nodes


def project(file, row, points):
    """Project points with what a file says."""
    turn, move = np.split(file["extrinsic_parameters"][row], 2)
    points, K, terms = points[:, None], file["camera_matrix"], file["distortion_coefficients"]
    if "xi" in file:
        if not hasattr(cv2, "omnidir"):
            pytest.skip("this OpenCV has no omnidir")
        return cv2.omnidir.projectPoints(points, turn, move, K, file["xi"], terms)[0].reshape(-1, 2)
    if file.get("fisheye_model"):
        return cv2.fisheye.projectPoints(points, turn, move, K, terms)[0].reshape(-1, 2)
    return cv2.projectPoints(points, turn, move, K, terms)[0].reshape(-1, 2)


@pytest.mark.parametrize("name", SAID)
def test_opencv_sees_points_where_we_do(tmp_path, name):
    exported("opencv", name, tmp_path)
    (path,) = tmp_path.iterdir()
    assert path.name == f"{name}.yml"
    file = read(path)
    assert file["frames"] == [1, 12, 10000]
    for row, (points, pixels) in enumerate(views(name)):
        turn, move = np.split(file["extrinsic_parameters"][row], 2)
        ahead = (points @ cv2.Rodrigues(turn)[0].T + move)[:, 2] > 0  # others OpenCV sees only with omnidir
        ahead |= "xi" in file
        assert np.count_nonzero(ahead) > 150
        theirs = project(file, row, points[ahead]) + 0.5
        assert np.abs(theirs - pixels[ahead]).max() < 1e-9


@pytest.mark.parametrize("name", REFUSED)
def test_what_opencv_cannot_represent_is_refused(name):
    able = "choose one of .*json.*(, or Fit Nearest Lens .--fit.)?$"
    with pytest.raises(InputError, match=rf"^OpenCV cannot represent the .*{REFUSED[name]}.*: {able}"):
        export_files("opencv", shots(name))


def test_a_lens_that_zooms_has_a_file_a_frame():
    zooming = [Shot("Zoom", frame, camera("PERSP", FRAME | {"lens": 30.0 + frame})) for frame in (1, 2, 3)]
    files, _ = export_files("opencv", zooming)
    assert [name for name, _ in files] == ["Zoom_0001.yml", "Zoom_0002.yml", "Zoom_0003.yml"]
