"""EXR images without Blender: tables of rays, and damage. Blender's tests read what OpenImageIO writes."""

import random
import struct

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.openexr.reading import channels_of
from camera_ray_caster.core.openexr.writing import exr

from ..cameras.table_examples import fisheye


def test_red_green_and_blue_are_directions(tmp_path):
    path = tmp_path / "rays.exr"
    path.write_bytes(exr(np.nan_to_num(fisheye(20, 16)).astype(np.float32)))
    cam = crc.load_calibration(path)
    assert (cam.model.key, cam.raster.size, cam.model.central) == ("RAY_TABLE", (20, 16), True)
    np.testing.assert_array_equal(cam.rays().valid, ~np.isnan(fisheye(20, 16)[..., 0]))
    expected = crc.camera("RAY_TABLE", (20, 16), ray_directions=fisheye(20, 16)).rays().directions
    np.testing.assert_allclose(cam.rays().directions, expected, rtol=0, atol=2e-7)


def test_damaged_images_are_refused_in_one_line():
    content = exr(np.float32(fisheye(20, 16)))
    chance = random.Random(1)
    refused = set()
    for damage in range(400):
        damaged = bytearray(content[: chance.randrange(len(content))] if damage % 4 == 0 else content)
        damaged[chance.randrange(min(len(damaged), 330) or 1) : 0] = b"" if damage % 4 else b"\xff"
        if damage % 4:
            damaged[chance.randrange(330)] = chance.randrange(256)
        try:
            channels_of(bytes(damaged), "rays.exr")
        except crc.InputError as error:
            refused.add(str(error))
    assert all("rays.exr" in message and "\n" not in message for message in refused)
    assert "EXR image 'rays.exr' is damaged, or cut off" in refused


def test_a_channel_of_an_unknown_type_is_damage():
    content = bytearray(exr(np.float32(fisheye(20, 16))))
    kind = content.index(b"B\0") + 2
    content[kind : kind + 4] = b"\xff" * 4
    with pytest.raises(crc.InputError, match="damaged"):
        channels_of(bytes(content), "rays.exr")


@pytest.mark.parametrize(("pixels", "size", "says"), [
    (np.float32(fisheye(20, 16)), 700, "'.*rays.exr' is damaged, or cut off"),
    (np.float32(fisheye(20, 16)), 30, "'.*rays.exr' is damaged, or cut off"),
    (np.zeros((4, 4, 3), np.float32), None, "no ray"),
])  # fmt: skip
def test_what_is_no_table_is_refused(pixels, size, says, tmp_path):
    path = tmp_path / "rays.exr"
    path.write_bytes(exr(pixels)[:size])
    with pytest.raises(crc.InputError, match=says):
        crc.load_calibration(path)


def test_an_stmap_is_no_table_of_rays(tmp_path):
    v, u = np.mgrid[0.05:0.95:9j, 0.05:0.95:13j].astype(np.float32)
    path = tmp_path / "map.exr"
    path.write_bytes(exr(np.stack([u, v, np.ones_like(u)], axis=2)))
    with pytest.raises(crc.InputError, match="it is an STMap"):
        crc.load_calibration(path)
    path.write_bytes(exr(np.stack([u, v, u + v], axis=2)))
    assert crc.load_calibration(path).model.key == "RAY_TABLE"


def test_a_part_of_a_picture_is_no_table(tmp_path):
    """Programs that cut off empty borders write a data window that is not the display window."""
    path, content = tmp_path / "rays.exr", exr(np.float32(fisheye(20, 16)))
    name = b"displayWindow\0box2i\0" + struct.pack("<i", 16)
    whole, larger = struct.pack("<4i", 0, 0, 19, 15), struct.pack("<4i", 0, 0, 59, 47)
    path.write_bytes(content.replace(name + whole, name + larger))
    with pytest.raises(crc.InputError, match="its data window is not its display window"):
        crc.load_calibration(path)


def test_lines_may_have_an_attribute_of_tiles():
    content = exr(np.float32(fisheye(20, 16)))
    tiles = b"tiles\0tiledesc\0" + struct.pack("<iIIB", 9, 8, 8, 0)
    end = content.index(b"screenWindowWidth")
    shifted = bytearray(content[:end] + tiles + content[end:])
    first = len(shifted) - 16 * (8 + 12 * 20) - 8 * 16  # 16 lines behind their table
    offsets = np.frombuffer(shifted, "<u8", 16, first) + len(tiles)
    shifted[first : first + 8 * 16] = offsets.tobytes()
    expected = channels_of(content, "rays.exr")
    np.testing.assert_array_equal(channels_of(bytes(shifted), "rays.exr")["R"], expected["R"])
