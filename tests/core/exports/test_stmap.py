"""STMaps against OpenImageIO's st_warp: the picture that it makes of one camera's is the other one's."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from camera_ray_caster.core.exports import export_files
from camera_ray_caster.core.exports.format import Shot
from camera_ray_caster.core.exports.stmap import perspective_of
from camera_ray_caster.core.records import InputError

from ..cameras.model_examples import camera
from .shots import FRAME, MATRIX, RADIAL, RADTAN, pose

TURNED = FRAME | {"matrix_world": pose(1)}
WIDE = "PERSP", TURNED | {"lens": 20.0, "shift_x": 0.1}
PAIRS = {
    "radtan": (("OPENCV_PINHOLE", MATRIX | RADTAN | TURNED), None),
    "fisheye": (("OPENCV_FISHEYE", MATRIX | RADIAL | TURNED), None),
    "blenders_fisheye": (("FISHEYE_EQUIDISTANT", TURNED | {"shift_x": 0.1}), None),
    "panorama": (("EQUIRECTANGULAR", TURNED), WIDE),
    "fisheye_to_panorama": (("OPENCV_FISHEYE", MATRIX | RADIAL | TURNED), ("EQUIRECTANGULAR", TURNED)),
}


def maps(source, target, frame=7):
    shot = Shot("Lens", frame, camera(*source), target=None if target is None else camera(*target))
    files, remarks = export_files("stmap", [shot])
    return shot.camera, dict(files), remarks


def picture(camera):
    """What a camera sees of a smooth environment, from the top: values 0.25 to 0.75, and where it has rays."""
    rays = camera.rays()
    x, y, z = np.moveaxis(rays.directions, -1, 0)
    value = 0.5 + 0.125 * (np.sin(5 * x + 1) + np.cos(4 * y - 2 * z))
    return np.where(rays.valid, value, 0.0)[::-1].astype(np.float32), rays.valid[::-1]


def warp(picture, st_map, folder):
    """What OpenImageIO makes of a picture by a map."""
    paths = [folder / name for name in ("picture.npy", "map.npy", "warped.npy")]
    for path, image in zip(paths, (picture, st_map), strict=False):
        np.save(path, np.ascontiguousarray(np.atleast_3d(image), np.float32))
    subprocess.run([sys.executable, Path(__file__).with_name("st_warp.py"), *paths], check=True, timeout=300)
    return np.load(paths[-1])[..., 0]


@pytest.mark.cases(1)
@pytest.mark.parametrize("pair", PAIRS)
def test_a_warped_picture_is_the_other_cameras(pair, tmp_path):
    first, other = PAIRS[pair]
    camera_one, files, remarks = maps(first, other)
    camera_other = camera(*other) if other else perspective_of(camera_one)
    assert remarks == []
    assert sorted(files) == ["Lens_0007_distort.exr", "Lens_0007_undistort.exr"]
    for name, source, target in (("undistort", camera_one, camera_other), ("distort", camera_other, camera_one)):
        st = files[f"Lens_0007_{name}.exr"]
        assert st.shape == (*target.raster.size[::-1], 3)
        assert st.dtype == np.float32
        (before, had), (after, has) = picture(source), picture(target)
        warped = warp(before, st[::-1], tmp_path)
        s, t, alpha = np.moveaxis(st[::-1], -1, 0)
        width, height = source.raster.size
        # within the picture, and its rays, by the filter's reach
        column, row = np.clip(s * width, 0, width - 1).astype(int), np.clip((1 - t) * height, 0, height - 1).astype(int)
        reach = [(down, over) for down in (-2, 0, 2) for over in (-2, 0, 2)]
        inside = (np.abs(s * 2 - 1) < 1 - 6 / width) & (np.abs(t * 2 - 1) < 1 - 6 / height) & (alpha == 1) & has
        for down, over in reach:
            inside &= had[np.clip(row + down, 0, height - 1), np.clip(column + over, 0, width - 1)]
        assert np.count_nonzero(inside) > 10_000
        assert np.abs(warped - after)[inside].max() < 1e-3  # bilinear; half a pixel off is 2.6e-3 and more


def test_a_pixel_without_a_place_says_so():
    _, files, _ = maps(*PAIRS["panorama"])
    distort = files["Lens_0007_distort.exr"]
    assert np.isfinite(distort).all()
    lost = distort[..., 2] == 0
    assert 0.4 < lost.mean() < 0.6  # half of the sphere lies behind a perspective
    assert (distort[lost] == (-1, -1, 0)).all()


def test_what_the_places_of_the_eyes_mean_is_said():
    _, _, remarks = maps(("PERSP", TURNED), ("PERSP", FRAME))
    (line,) = remarks
    assert "'Camera' and 'Camera' are " in line
    assert line.endswith(" apart: the maps are exact for distant objects only")


@pytest.mark.parametrize(
    ("source", "target", "says"),
    [
        (("CROSS_SLIT", {}), None, "Cross-Slit .*, whose rays have no eye in common: choose one of tum, kitti,"),
        (("PERSP", {}), ("ORTHO", {}), "whose target 'Camera' is one whose rays have no eye"),
    ],
)
def test_cameras_without_an_eye_are_refused(source, target, says):
    with pytest.raises(InputError, match=f"^STMaps cannot represent the .*{says}"):
        maps(source, target)


def test_places_that_float32_cannot_hold_are_none():
    """The picture of a cylinder that is so high that another camera's pixels lie beyond float32."""
    high = {"central_cylindrical_range_v_min": 3.4e38}
    _, files, _ = maps(("CENTRAL_CYLINDRICAL", high), None)
    for st in files.values():
        assert np.isfinite(st).all()
        assert (st[st[..., 2] == 0] == (-1, -1, 0)).all()
