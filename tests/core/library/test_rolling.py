"""Rolling shutters of files: cameras whose first and last rows have the poses and times of the file."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc

READOUTS = "TOP_TO_BOTTOM", "BOTTOM_TO_TOP", "LEFT_TO_RIGHT", "RIGHT_TO_LEFT"
WIDTH, HEIGHT, RATE = 32, 24, 25.0
LAST = [[0.8, -0.6, 0, 1.0], [0.6, 0.8, 0, 3.0], [0, 0, 1, -2.0], [0, 0, 0, 1]]


def written(folder, offsets, readout=READOUTS[0], **more):
    """A file with two pictures."""
    frames = [{"file_path": f"a_{number:04}.png", "transform_matrix": np.eye(4).tolist(), "transform_matrix_rs": LAST,
               "rolling_shutter": f"ROLLING_{readout}", "rolling_shutter_offsets": list(offsets)} | more
              for number in (3, 8)]  # fmt: skip
    head = {"camera_model": "OPENCV", "w": WIDTH, "h": HEIGHT, "fl_x": 20.0, "fl_y": 20.0, "cx": 16.0, "cy": 12.0}
    path = folder / "transforms.json"
    path.write_text(json.dumps(head | {"frames": frames}))
    return path


def times(start, shutter, duration, count):
    """Seconds from the frame to the middle of the exposures of the first and the last row, by hand."""
    return tuple((start * shutter + duration * shutter / 2 + shutter * (1 - duration) * k / count) / RATE
                 for k in (1, count))  # fmt: skip


@pytest.mark.one_for_each("readout")
@pytest.mark.parametrize("readout", READOUTS)
@pytest.mark.parametrize(("start", "duration"), [(0, 0.25), (-0.5, 0), (-1, 0.5)])
def test_what_is_read_is_written_again(readout, start, duration, tmp_path):
    offsets = times(start, 0.5, duration, HEIGHT if readout in READOUTS[:2] else WIDTH)
    path = written(tmp_path, offsets, readout)
    camera = crc.load_rig(path, frame_rate=RATE)["a"]
    assert camera.frames == (3, 8)
    for view in camera:
        assert view.record.settings["motion_blur_shutter"] == pytest.approx(0.5, rel=1e-12)
    crc.export(list(camera), tmp_path / "again", format="nerfstudio")
    before, after = (json.loads(file.read_text())["frames"]
                     for file in (path, tmp_path / "again" / "transforms.json"))  # fmt: skip
    for entry, other in zip(before, after, strict=True):
        assert entry["rolling_shutter"] == other["rolling_shutter"]
        assert np.multiply(other["rolling_shutter_offsets"], 24 / RATE) == pytest.approx(offsets, abs=1e-12)
        for name in ("transform_matrix", "transform_matrix_rs"):
            np.testing.assert_allclose(other[name], entry[name], rtol=0, atol=1e-12)


def test_rows_have_the_poses_between(tmp_path):
    camera = crc.load_rig(written(tmp_path, times(-0.5, 0.5, 0, HEIGHT)), frame_rate=RATE)["a"]
    rays = camera.rays()
    share = np.linspace(1, 0, HEIGHT)[:, None]  # rows are counted from the bottom
    np.testing.assert_allclose(rays.origins[:, 0], share * (1, 3, -2), rtol=0, atol=1e-12)
    np.testing.assert_allclose(rays.time[:, 0], 3 - 0.25 + 0.5 * np.arange(HEIGHT, 0, -1) / HEIGHT, rtol=0, atol=1e-12)
    left = (0.5 - 16) / 20, (12 - 0.5) / 20, -1.0
    bottom = np.array(((0.8, -0.6, 0), (0.6, 0.8, 0), (0, 0, 1))) @ (left * np.array((1, -1, 1)))
    np.testing.assert_allclose(rays.directions[0, 0], bottom / np.linalg.norm(bottom), rtol=0, atol=1e-12)
    assert camera.at(camera.pixel_time.last).pose.eye == pytest.approx((1, 3, -2), abs=1e-12)


@pytest.mark.parametrize("frame", [1.0, 3.5, 100.0])
def test_a_frame_that_is_neither_the_files_nor_a_time_of_its_rows_has_no_pose(frame, tmp_path):
    camera = crc.load_rig(written(tmp_path, times(-0.5, 0.5, 0, HEIGHT)), frame_rate=RATE)["a"]
    first, last = camera.pixel_time.span
    assert 2.75 < first < 3 < last < 3.5
    with pytest.raises(crc.InputError, match="no pose at frame"):
        camera.at(frame)


def test_times_that_no_shutter_has_are_moved_and_rows_keep_their_poses(tmp_path):
    camera = crc.load_rig(written(tmp_path, (0.0, 0.01)), frame_rate=RATE)["a"]
    origins = camera.rays().origins
    np.testing.assert_allclose(origins[[-1, 0], 0], ((0, 0, 0), (1, 3, -2)), rtol=0, atol=1e-12)
    assert camera.pixel_time.last - camera.pixel_time.first == pytest.approx(0.25, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"rolling_shutter_offsets": [0.1, 0.1]}, "rolling_shutter_offsets of a_0003.png is .* the seconds"),
        ({"rolling_shutter": "GLOBAL"}, "rolling_shutter of a_0003.png is 'GLOBAL': it must be one of ROLLING_TOP"),
        ({"transform_matrix_rs": [[1, 2]]}, "transform_matrix_rs of a_0003.png has 2 numbers"),
    ],
)
def test_what_is_no_rolling_shutter_is_refused(change, says, tmp_path):
    with pytest.raises(crc.InputError, match=says):
        crc.load_rig(written(tmp_path, (0.0, 0.01), **change))
