"""mrcal, nerfbaselines and ROS's image_geometry against what is written for them, where they are installed:
``scripts/calibration_readers.py`` says how.
"""

import json

import numpy as np
import pytest

from .shots import CAMERAS, exported, nearest, views

MRCAL = ["perspective", "shifted", "portrait", "pinhole", "radtan", "five", "rational", "prism", "scaled",
         "stereographic", "panorama", "part"]  # fmt: skip
ROS = ["perspective", "shifted", "portrait", "pinhole", "radtan", "five", "rational", "scaled"]
NERFBASELINES = ["perspective", "shifted", "portrait", "radtan", "scaled", "fisheye"]


@pytest.mark.parametrize("name", MRCAL)
def test_mrcal_sees_points_where_we_do(tmp_path, name):
    mrcal = pytest.importorskip("mrcal")
    exported("mrcal", name, tmp_path)
    for frame, (points, pixels) in zip(("0001", "0012", "10000"), views(name), strict=True):
        model = mrcal.cameramodel(str(tmp_path / f"{name}_{frame}.cameramodel"))
        seen = mrcal.transform_point_rt(model.rt_cam_ref(), points)
        theirs = mrcal.project(seen, *model.intrinsics()) + 0.5
        if model.intrinsics()[0] == "LENSMODEL_LONLAT":  # which is within half a turn of the middle
            turn = 2 * np.pi * model.intrinsics()[1][0]
            theirs[:, 0] += turn * np.rint((pixels - theirs)[:, 0] / turn)
        ahead = np.ones(200, bool) if CAMERAS[name][0] == "EQUIRECTANGULAR" else seen[:, 2] > 0
        assert np.count_nonzero(ahead) > 150
        assert model.imagersize().tolist() == [CAMERAS[name][1]["resolution_x"], CAMERAS[name][1]["resolution_y"]]
        assert np.abs(theirs - pixels)[ahead].max() < 1e-9


@pytest.mark.parametrize("name", ROS)
def test_ros_rectifies_pixels_to_the_rays_of_points(tmp_path, name):
    image_geometry = pytest.importorskip("image_geometry")
    yaml, messages = pytest.importorskip("yaml"), pytest.importorskip("sensor_msgs.msg")
    exported("ros", name, tmp_path)
    written = yaml.safe_load((tmp_path / f"{name}.yaml").read_text())
    info = messages.CameraInfo(
        width=written["image_width"], height=written["image_height"], distortion_model=written["distortion_model"],
        D=written["distortion_coefficients"]["data"], K=written["camera_matrix"]["data"],
        R=written["rectification_matrix"]["data"], P=written["projection_matrix"]["data"],
    )  # fmt: skip
    model = image_geometry.PinholeCameraModel()
    model.fromCameraInfo(info)
    assert written["camera_name"] == name
    apart = []
    for near, (points, pixels) in zip(nearest(name), views(name), strict=True):
        seen = points @ near.opencv_from_world[:3, :3].T + near.opencv_from_world[:3, 3]
        for point, pixel in zip(seen, pixels - 0.5, strict=True):
            apart.append(np.subtract(model.rectifyPoint(pixel), model.project3dToPixel(point)))
    assert np.abs(apart).max() < (1e-3 if any(info.D) else 1e-9)  # five steps of OpenCV's


@pytest.mark.parametrize("name", NERFBASELINES)
def test_nerfbaselines_sees_points_where_we_do(tmp_path, name):
    pytest.importorskip("nerfbaselines")
    from nerfbaselines.cameras import project
    from nerfbaselines.datasets.nerfstudio import load_nerfstudio_dataset

    exported("nerfstudio", name, tmp_path)
    path = tmp_path / "transforms.json"
    document = json.loads(path.read_text())
    document["train_filenames"] = [frame["file_path"] for frame in document["frames"]]  # none is kept for tests
    path.write_text(json.dumps(document))
    cameras = load_nerfstudio_dataset(tmp_path, "train", downscale_factor=1)["cameras"]
    for row, (points, pixels) in enumerate(views(name)):
        theirs = project(cameras[row : row + 1], points.astype(np.float32))
        assert np.abs(theirs - pixels).max() < 640 * 4e-6  # float32, of places 20 away
