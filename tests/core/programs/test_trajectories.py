"""Trajectories: the columns that a file names, and those of files that name none."""

import numpy as np
import pytest

from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.records import InputError

TURN = [[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]
"""By a right angle about z; its quaternion is half of the root of 2 in w and z."""
H = np.sqrt(0.5)


def read(tmp_path, text, name="path.txt"):
    """The trajectory of a text."""
    file = tmp_path / name
    file.write_text(text)
    return mounted(str(file), "", (640, 480), 10.0)[0]


@pytest.mark.parametrize(
    ("text", "frames"),
    [
        (f"# time x y z qw qx qy qz\n5 1 2 3 {H} 0 0 {H}\n5.5 1 2 3 {H} 0 0 {H}\n", [1, 6]),
        (f"# made by a program\n# timestamp tx ty tz qx qy qz qw\n5 1 2 3 0 0 {H} {H}\n", [1]),
        (f"#timestamp,tx,ty,tz,qx,qy,qz,qw\n158383.25,1,2,3,0,0,{H},{H}\n158384.25,1,2,3,0,0,{H},{H}\n", [1, 11]),
        (f"timestamp [ms],q_w [],q_x,q_y,q_z,p_x [m],p_y,p_z\n500,{H},0,0,{H},1,2,3\n1000,{H},0,0,{H},1,2,3\n", [1, 6]),
        (f"#sec,nsec,x,y,z,qx,qy,qz,qw\n7,600000000,1,2,3,0,0,{H},{H}\n8,100000000,1,2,3,0,0,{H},{H}\n", [1, 6]),
        (f"# timestamp_us, x, y, z, rx, ry, rz\n0,1,2,3,0,0,{np.pi / 2}\n500000,1,2,3,0,0,{np.pi / 2}\n", [1, 6]),
        (f"%time,field.header.seq,field.header.stamp,field.pose.position.x,field.pose.position.y,field.pose.position.z,"
         f"field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w\n"
         f"1500000000500000000,7,1500000000500000000,1,2,3,0,0,{H},{H}\n", [1]),
        (f"time_s,tx,ty,tz,ox,oy,oz,ow\n1,1,2,3,0,0,{H},{H}\n2,1,2,3,0,0,{H},{H}\n", [1, 11]),
        (f"graph_uid,tracking_timestamp_us,tx_world_device,ty_world_device,tz_world_device,qx_world_device,"
         f"qy_world_device,qz_world_device,qw_world_device,gravity_x_world,tx_ecef_device\n"
         f"01234567-89ab-cdef-0123-456789abcdef,500000,1,2,3,0,0,{H},{H},9,0\n", [1]),
        (f"1 2 3 0 0 {H} {H}\n1 2 3 0 0 {H} {H}\n", [1, 2]),
        (f"1,2,3,0,0,{H},{H}\n1,2,3,0,0,{H},{H}\n", [1, 2]),
        (f"time;x;y;z;qx;qy;qz;qw\n1.0;1;2;3;0;0;{H};{H}\n1.5;1;2;3;0;0;{H};{H}\n", [1, 6]),
        (f'"utime","x","y","z","qx","qy","qz","qw"\n"7500000","1","2","3","0","0","{H}","{H}"\n', [1]),
        (f"frame_id,x,y,z,qw,qx,qy,qz\n10,1,2,3,{H},0,0,{H}\n25,1,2,3,{H},0,0,{H}\n", [10, 25]),
        (f"frame,time,x,y,z,qw,qx,qy,qz\n10,0.5,1,2,3,{H},0,0,{H}\n25,2.0,1,2,3,{H},0,0,{H}\n", [1, 16]),
        ("0 -1 0 1 1 0 0 2 0 0 1 3\n" * 2, [1, 2]),
        ("0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1\n" * 2, [1, 2]),
        ("4 0 -1 0 1 1 0 0 2 0 0 1 3\n9 0 -1 0 1 1 0 0 2 0 0 1 3\n", [4, 9]),
        ("4.5 0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1\n5.0 0 -1 0 1 1 0 0 2 0 0 1 3 0 0 0 1\n", [1, 6]),
        (f"5 1 2 3 0 0 {H} {H}\n5 9 9 9 0 0 0 1\n5 1 2 3 0 0 {H} {H}\n6 1 2 3 0 0 {H} {H}\n", [1, 11]),
    ],
)  # fmt: skip
def test_a_line_is_what_its_columns_are_named(text, frames, tmp_path):
    camera = read(tmp_path, text)
    np.testing.assert_allclose(camera.frames, frames, rtol=0, atol=1e-6)
    for pose in camera.poses:
        np.testing.assert_allclose(pose[:3], np.c_[TURN, [1, 2, 3]], rtol=0, atol=1e-12)
    assert ("2 are left out" in camera.note) == (text.count("\n5 ") == 2)


def test_a_place_may_be_negative(tmp_path):
    assert read(tmp_path, "-1 2 3 0 0 0 1\n-2 2 3 0 0 0 1\n").poses[1][0, 3] == -2


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("# time x y z roll pitch yaw\n1 2 3 4 0 0 0\n", "its columns are 'time x y z roll pitch yaw': they must be"),
        ("0 2 3 0.5 0.6 0.7 0.8\n1 2 3 0.5 0.6 0.7 0.8\n", "its lines have 7 numbers: .* name the columns in the"),
        ("0 1 0 0 0 4 5 6\n1 1 0 0 0 4 5 7\n", "the second to the fifth are a quaternion"),
        ("#timestamp,x,y,z,qx,qy,qz,qw\n1,2,3,4,0,,0,1\n", "pose 1 is .* 8 finite numbers"),
        (f"# {'quat' * 20000} x y z qx qy qz\n1 2 3 4 5 6 7\n", "its lines have 7 numbers"),
        ("# utime, x, y, z, roll, pitch, yaw\n7,1,2,3,0,0,0.5\n", "its columns are 'utime, x, .*: they must be a time"),
        ("1.0 1 2 3 nan nan nan nan\n1.5 1 2 4 0 0 0 1\n", "pose 1 is .* 8 finite numbers"),
        ("1583836591.25,1,2,3,0,0,0,1\n", "not in whole nanoseconds as in .csv files"),
        ("# timestamp,x,y,z,rx,ry,rz\n0,4,0,0,0,0,1\n12500,4,0,0,0,0,1\n", "tell their unit in the first line"),
    ],
)
def test_other_columns_are_refused_in_one_line(text, says, tmp_path):
    with pytest.raises(InputError, match=says):
        read(tmp_path, text)
