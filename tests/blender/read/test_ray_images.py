"""Tables of rays in EXR images, which Blender reads."""

import sys

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender.read.openexr import openimageio
from camera_ray_caster.core.exports.exr import exr
from camera_ray_caster.core.programs.parts import ray_exr

from ...core.cameras.table_examples import fisheye, pinhole, without_eye


def has_openimageio():
    """Whether this Blender reads EXR: builds by others than its makers may have no OpenImageIO."""
    try:
        return bool(openimageio())
    except crc.InputError:
        return False


reads_exr = pytest.mark.skipif(not has_openimageio(), reason="this build of Blender has no OpenImageIO")


def written(path, channels, kind="float"):
    """Write channels by name, (rows, columns) from the bottom, into an EXR by OpenImageIO."""
    library = openimageio()
    pixels = np.stack(list(channels.values()), axis=2)[::-1].astype(np.float32).copy()
    spec = library.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kind)
    spec.channelnames = tuple(channels)
    out = library.ImageOutput.create(str(path))
    assert out.open(str(path), spec)
    assert out.write_image(pixels)
    out.close()
    return path


def channels_of(vectors, name, axes="XYZ"):
    return {f"{name}{axis}": vectors[..., k] for k, axis in enumerate(axes)}


@reads_exr
def test_red_green_and_blue_are_directions(tmp_path):
    path = tmp_path / "rays.exr"
    path.write_bytes(exr(np.nan_to_num(fisheye(20, 16)).astype(np.float32)))
    cam = crc.load_calibration(path)
    assert (cam.model.key, cam.raster.size, cam.model.central) == ("RAY_TABLE", (20, 16), True)
    np.testing.assert_array_equal(cam.rays().valid, ~np.isnan(fisheye(20, 16)[..., 0]))
    expected = crc.camera("RAY_TABLE", (20, 16), ray_directions=fisheye(20, 16)).rays().directions
    np.testing.assert_allclose(cam.rays().directions, expected, rtol=0, atol=2e-7)


@reads_exr
def test_channels_with_names_are_origins_and_directions(tmp_path):
    origins, directions = without_eye()
    for ahead, eye in (("ray_direction.", "ray_origin."), ("View Layer.Ray Direction.", "View Layer.Ray Origin.")):
        channels = channels_of(directions, ahead) | channels_of(origins, eye)
        cam = crc.load_calibration(written(tmp_path / "rays.exr", channels))
        np.testing.assert_allclose(cam.rays().origins, origins, rtol=0, atol=1e-7)
        assert not cam.model.central


@reads_exr
@pytest.mark.parametrize(
    ("make", "word"),
    [
        (lambda path: written(path, channels_of(pinhole(), "", "RGB"), "half"), "half floats"),
        (lambda path: written(path, {"Z": pinhole()[..., 2]}), "its channels are Z: it must have one direction"),
        (lambda path: written(path, channels_of(pinhole(), "a.") | channels_of(pinhole(), "b.")), "have one direction"),
        (lambda path: path.write_bytes(exr(np.float32(pinhole()))[:700]), "damaged"),
        (lambda path: path.write_bytes(exr(np.float32(pinhole()))[:30]), "cannot be read"),
        (lambda path: path.write_bytes(exr(np.zeros((4, 4, 3), np.float32))), "no ray"),
    ],
)
def test_images_that_are_no_table_are_refused_in_one_line(make, word, tmp_path):
    path = tmp_path / "rays.exr"
    make(path)
    with pytest.raises(crc.InputError, match=word) as caught:
        crc.load_calibration(path)
    assert "\n" not in str(caught.value)


def test_a_blender_without_openimageio_says_so(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "OpenImageIO", None)  # which raises ModuleNotFoundError where it is imported
    path = tmp_path / "rays.exr"
    path.write_bytes(exr(np.float32(pinhole(5, 5))))
    with pytest.raises(crc.InputError, match=r"rays.exr.*has no OpenImageIO: use a build") as caught:
        crc.load_calibration(path)
    assert "\n" not in str(caught.value)


def test_where_blender_is_not_they_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(ray_exr, "decoder", None)
    path = tmp_path / "other.exr"
    path.write_bytes(exr(np.float32(pinhole(5, 5))))
    with pytest.raises(crc.InputError, match="which Blender reads"):
        crc.load_calibration(path)
