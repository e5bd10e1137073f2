"""Exports without Blender: the files of each format, images by a writer of our own, and refusals in one line."""

import subprocess
import sys

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.exports.stmap import places
from camera_ray_caster.core.openexr.writing import exr

from ...exr import read_exr

SIZE = 40, 30


def perspectives():
    """A camera at two frames."""
    return [crc.camera("PERSP", SIZE, crc.look_at((k, -4, 2), (0, 0, 0)), name="left", frame=k) for k in (2, 1)]


@pytest.mark.parametrize("key", [export.key for export in EXPORT_FORMATS if export.key != "stmap"])
@pytest.mark.one_for_each("key")
def test_each_format_is_written(tmp_path, key):
    paths, remarks = crc.export(perspectives(), tmp_path / "out", key)
    assert paths
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [path.name for path in paths]
    assert all(isinstance(line, str) for line in remarks)


def test_maps_are_images_that_others_read(tmp_path):
    fisheye = crc.camera("OPENCV_FISHEYE", SIZE, fx=15.0, fy=15.0, cx=19.5, cy=14.5)
    perspective = crc.camera("PERSP", SIZE)
    paths, _ = crc.export(fisheye, tmp_path, "stmap", target=perspective)
    (distort,) = (path for path in paths if path.name.endswith("_distort.exr"))
    channels, expected = read_exr(distort), places(fisheye, perspective)
    for name, channel in zip("RGB", np.moveaxis(expected, -1, 0), strict=True):
        np.testing.assert_array_equal(channels[name], channel)


READ = """
import sys, numpy, OpenImageIO
image = OpenImageIO.ImageInput.open(sys.argv[1])
order = [image.spec().channelnames.index(name) for name in "RGB"]
numpy.save(sys.argv[2], image.read_image("float")[::-1][..., order])
"""
"""A program of its own: a process with OpenImageIO is none for Blender."""


@pytest.mark.full
def test_openimageio_reads_the_same(tmp_path):
    pixels = np.random.default_rng(1).normal(size=(3, 5, 3)).astype(np.float32)
    (tmp_path / "image.exr").write_bytes(exr(pixels))
    words = [sys.executable, "-c", READ, tmp_path / "image.exr", tmp_path / "image.npy"]
    subprocess.run(words, check=True, timeout=300)
    np.testing.assert_array_equal(np.load(tmp_path / "image.npy"), pixels)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("colmp", perspectives()), "did you mean colmap"),
        ((np.zeros(2), perspectives()), "unknown format array"),
        (("json", []), "there is no camera"),
        (("json", perspectives()[:1] * 2), "one name and one frame"),
        (("bop", crc.camera("EQUIRECTANGULAR", SIZE)), "BOP cannot represent the Equirectangular"),
    ],
)
def test_what_cannot_be_exported_is_one_line_and_leaves_nothing(tmp_path, words, message):
    with pytest.raises(crc.InputError, match=message) as caught:
        crc.export(words[1], tmp_path / "out", words[0])
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_the_help_names_every_format():
    for export in EXPORT_FORMATS:
        assert f'"{export.key}"' in crc.export.__doc__, f"crc.export, core/library/files.py, has no {export.key}"


@pytest.mark.parametrize("meters", [0, -1.0, np.float64(0)])
def test_a_unit_has_a_length(tmp_path, meters):
    with pytest.raises(crc.InputError, match=r"^meters is (0|-1\.0|0\.0): it must be above 0"):
        crc.export(perspectives(), tmp_path / "out", "bop", meters=meters)
    assert not (tmp_path / "out").exists()


def test_what_is_no_camera_and_no_folder(tmp_path):
    with pytest.raises(TypeError, match="takes cameras"):
        crc.export(3, tmp_path, "json")
    with pytest.raises(crc.InputError, match="folder is 3"):
        crc.export(perspectives(), 3, "json")
    for odd in "\0", "\ud800":
        with pytest.raises(crc.InputError, match=r"folder is .*no null characters and no halves of characters"):
            crc.export(perspectives(), f"{tmp_path}{odd}", "json")
    for fit in ("yes", -1.0, np.nan, (0, 0, 99999, 1)):
        with pytest.raises(crc.InputError, match=r"^fit is .*: (as an angle )?it must be (above 0, up to pi|\(x0, y0)"):
            crc.export(perspectives(), tmp_path, "colmap", fit=fit)
    with pytest.raises(crc.InputError, match="only maps have a target"):
        crc.export(perspectives(), tmp_path, "json", target=perspectives()[0])
    (tmp_path / "file").write_text("")
    with pytest.raises(crc.InputError, match="cannot write into"):
        crc.export(perspectives(), tmp_path / "file", "json")
