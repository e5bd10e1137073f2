"""Poses: what is none is refused, in one line that says which, wherever a matrix is given."""

from io import BytesIO

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.report.omitted import omitted

POSE = crc.look_at((1.0, 2.0, 3.0), (0.0, -1.0, 0.5))
SIZE = 8, 6


def sheared():
    matrix = POSE.copy()
    matrix[:3, 0] += 1e-4 * matrix[:3, 1]
    return matrix


def with_last_row(*row):
    matrix = POSE.copy()
    matrix[3] = row
    return matrix


BAD = {
    "transposed": POSE.T,
    "mirrored": POSE @ np.diag([1.0, -1.0, 1.0, 1.0]),
    "sheared": sheared(),
    "last row": with_last_row(0, 0, 0, 2),
    "finite": np.where(np.eye(4) > 0, np.nan, POSE),
    "shape": POSE[:3, :3],
}


def from_ray_table(tmp_path):
    def read(matrix):
        path, content = tmp_path / "rays.npz", BytesIO()
        rays = crc.camera("PERSP", SIZE).rays()
        np.savez(content, directions=rays.directions, pose=matrix)
        path.write_bytes(content.getvalue())
        return crc.load_calibration(path)

    return read


@pytest.mark.parametrize("flaw", BAD)
def test_every_door_refuses_what_is_no_pose(flaw, tmp_path):
    lens = crc.camera("PERSP", SIZE)
    doors = {
        "camera": lambda matrix: crc.camera("PERSP", SIZE, matrix),
        "pose_from_opencv": crc.pose_from_opencv,
        "with_pose": lens.with_pose,
    }
    if flaw not in ("shape", "finite"):  # which tables say in other words
        doors["ray table"] = from_ray_table(tmp_path)
    for name, door in doors.items():
        with pytest.raises(crc.InputError, match=flaw) as caught:
            door(BAD[flaw])
        assert "\n" not in str(caught.value), name


def test_rounding_and_scale_are_no_flaws():
    for matrix in (POSE.astype(np.float32), POSE[:3], POSE @ np.diag([2.0, 0.5, 3.0, 1.0])):
        cam = crc.camera("PERSP", SIZE, matrix)
        np.testing.assert_allclose(cam.pose.basis, POSE[:3, :3], atol=1e-7)
        np.testing.assert_allclose(crc.camera("PERSP", SIZE).with_pose(matrix).pose.eye, (1, 2, 3), atol=1e-7)
    world_to_camera = crc.camera("PERSP", SIZE, POSE).opencv_from_world
    np.testing.assert_allclose(
        crc.pose_from_opencv(np.diag([500.0, 400.0, 1.0]) @ world_to_camera[:3])[:3, 3], (1, 2, 3)
    )


def test_a_camera_with_another_pose_keeps_the_rest():
    first = crc.camera("CROSS_SLIT", SIZE, slit_1=[(0, 0, -3), (1, 0, 0)], slit_2=[(0, 0, -2), (0, 1, 0)], name="slits")
    moved = first.with_pose(POSE)
    same = crc.camera("CROSS_SLIT", SIZE, POSE, slit_1=[(0, 0, -3), (1, 0, 0)], slit_2=[(0, 0, -2), (0, 1, 0)])
    np.testing.assert_array_equal(moved.rays().origins, same.rays().origins)
    assert moved.name == "slits"


def test_a_transposed_matrix_of_a_mesh_is_refused():
    corners = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    with pytest.raises(crc.InputError, match="transposed"):
        crc.mesh(corners, [(0, 1, 2)], pose=POSE.T)
    assert len(crc.mesh(corners, [(0, 1, 2)], pose=np.stack((POSE, BAD["mirrored"])))) == 2


def test_nothing_is_clipped_unless_it_is_asked_for():
    """Scenes in millimeters: a ball at 1,500, and one at 0.05, in front of a camera with and without a clip range."""
    balls = crc.spheres([(0.0, 0.0, -1500.0), (0.0, 0.0, -0.05)], [400.0, 0.001])
    free = crc.camera("PERSP", (33, 33))
    images = crc.cast(free, balls, passes=("depth", "shape_index"))
    assert images["depth"].min() == pytest.approx(0.049, rel=1e-4)
    assert set(np.unique(images["shape_index"])) == {-1, 0, 1}
    assert len(crc.scan(free, balls)) == (images["shape_index"] >= 0).sum()
    clipped = crc.cast(crc.camera("PERSP", (33, 33), clip_start=0.1, clip_end=1000.0), balls, passes="shape_index")
    assert (clipped["shape_index"] == -1).all()
    assert (
        crc.cast(crc.camera("PERSP", (33, 33), clip_end=1.0), balls, passes="shape_index")["shape_index"] != 0
    ).all()
    again = crc.camera_from_json(crc.camera_to_json(free))
    assert (again.clip_start, again.clip_end) == (0.0, np.inf)


def test_the_report_names_shapes_beyond_the_clip_range():
    """Three balls in view: nearer than the clip start, within the range and crossing its end, and beyond it."""
    centers, radii = [(0.0, 0.0, -0.5), (0.0, 0.0, -10.0), (0.0, 0.0, -20.0)], [0.1, 1.0, 2.0]
    named = zip(centers, radii, "ABC", strict=True)
    balls = crc.join(*(crc.spheres([at], size, name=name) for at, size, name in named))
    for settings, words in (
        ({"clip_start": 1.0, "clip_end": 10.0}, ["'A', 'C': beyond the clip range, 1 to 10"]),
        ({}, []),
    ):
        plan = crc.cast(crc.camera("PERSP", (9, 9), **settings), balls, passes="depth").plan
        assert [line for line in omitted(plan) if "clip range" in line] == words
