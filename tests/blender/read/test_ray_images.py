"""Tables of rays in EXR images, beside Blender's OpenImageIO."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender.cycles.shader import openimageio
from camera_ray_caster.core.openexr.reading import channels_of

from ...core.cameras.table_examples import pinhole, without_eye


def has_openimageio():
    """Whether this Blender writes EXR for us: builds by others than its makers may have no OpenImageIO."""
    try:
        return bool(openimageio())
    except crc.InputError:
        return False


pytestmark = pytest.mark.skipif(not has_openimageio(), reason="this build of Blender has no OpenImageIO")


def written(path, channels, kind="float", compression="zip", tile=0, parts=("",)):
    """Write channels by name, (rows, columns) from the bottom, into each part of an EXR, the part's name ahead, by
    OpenImageIO.
    """
    library = openimageio()
    pixels = np.stack(list(channels.values()), axis=2)[::-1].astype(np.float32).copy()
    specs = []
    for prefix in parts:
        spec = library.ImageSpec(pixels.shape[1], pixels.shape[0], pixels.shape[2], kind)
        spec.channelnames = tuple(f"{prefix}{name}" for name in channels)
        spec.attribute("compression", compression)
        spec.tile_width = spec.tile_height = tile
        specs.append(spec)
    out = library.ImageOutput.create(str(path))
    assert out.open(str(path), tuple(specs))
    for k, spec in enumerate(specs):
        assert k == 0 or out.open(str(path), spec, "AppendSubimage")
        assert out.write_image(pixels)
    out.close()
    return path


def vector(values, name, axes="XYZ"):
    return {f"{name}{axis}": values[..., k] for k, axis in enumerate(axes)}


def smooth_and_noisy(rows, columns):
    y, x = np.mgrid[:rows, :columns]
    return {"smooth": x / 50 - y, "noisy": np.random.default_rng(rows).standard_normal((rows, columns)), "flat": x * 0}


@pytest.mark.parametrize("kind", ["float", "half"])
@pytest.mark.parametrize("compression", ["none", "rle", "zips", "zip", "piz"])
def test_numbers_are_those_that_openimageio_writes(compression, kind, tmp_path):
    several = "", "left."
    for shape, tile, parts in (((37, 53), 0, ("",)), ((1, 1), 0, ("",)), ((5, 300), 16, ("",)), ((200, 3), 0, several)):
        channels = smooth_and_noisy(*shape)
        path = written(tmp_path / "image.exr", channels, kind, compression, tile, parts)
        there = channels_of(path.read_bytes(), str(path))
        assert set(there) == {f"{prefix}{name}" for prefix in parts for name in channels}
        for name, values in there.items():
            expected = channels[name.split(".")[-1]].astype("f4" if kind == "float" else "f2")
            np.testing.assert_array_equal(values[::-1], expected)


@pytest.mark.parametrize("compression", ["pxr24", "b44", "dwaa"])
def test_compressions_with_loss_are_refused(compression, tmp_path):
    path = written(tmp_path / "rays.exr", vector(pinhole(), "", "RGB"), compression=compression)
    with pytest.raises(crc.InputError, match=rf"is {compression.upper()}, which changes .*: save it with ZIP"):
        crc.load_calibration(path)


def test_channels_with_names_are_origins_and_directions(tmp_path):
    origins, directions = without_eye()
    for ahead, eye in (("ray_direction.", "ray_origin."), ("View Layer.Ray Direction.", "View Layer.Ray Origin.")):
        channels = vector(directions, ahead) | vector(origins, eye)
        cam = crc.load_calibration(written(tmp_path / "rays.exr", channels))
        np.testing.assert_allclose(cam.rays().origins, origins, rtol=0, atol=1e-7)
        assert not cam.model.central


@pytest.mark.parametrize(
    ("make", "word"),
    [
        (lambda path: written(path, vector(pinhole(), "", "RGB"), "half"), "half floats"),
        (lambda path: written(path, {"Z": pinhole()[..., 2]}), "its channels are Z: it must have one direction"),
        (lambda path: written(path, vector(pinhole(), "", "RGB"), parts=("", "")), "parts with the same channels"),
        (lambda path: written(path, vector(pinhole(), "a.") | vector(pinhole(), "b.")), "have one direction"),
    ],
)
def test_images_that_are_no_table_are_refused(make, word, tmp_path):
    with pytest.raises(crc.InputError, match=word):
        crc.load_calibration(make(tmp_path / "rays.exr"))
