"""Poses of maplab, HOT3D, Metashape, Meshroom, Polycam and ARKitScenes: points seen by each format's own formula."""

import json

import numpy as np
import pytest

from camera_ray_caster.core.programs.parts.placed import FROM_BLENDER
from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.records import InputError

from .test_contract import SAMPLES
from .test_more_programs import PROJECT, hot3d, ncamera, sfm

POINTS = np.random.default_rng(5).uniform(-4, 4, (7, 3))
TO_BLENDER = np.array((1.0, -1.0, -1.0))
"""From x right, y down, z ahead to Blender's camera frame."""
AXES = np.array(((0.36, 0.48, -0.8), (-0.8, 0.6, 0.0), (0.48, 0.64, 0.6)))
"""A rotation of short decimals."""
PLACE = np.array((1.5, -2.0, 0.25))
HALF = np.sqrt(0.5)
QUATERNION = {"quaternion_wxyz": [HALF, 0, 0, HALF], "translation_xyz": PLACE.tolist()}
QUARTER = np.array(((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
"""The same quarter turn about z as a matrix."""


def read(path, text=None):
    if text is not None:
        path = path / "file"
        path.write_text(text)
    return mounted(str(path), "", (640, 480), 24.0)


def in_view(pose):
    """The points in the frame of a Blender camera of this pose."""
    return (POINTS - pose[:3, 3]) @ pose[:3, :3]


def rows(axes=AXES, position=PLACE):
    return np.vstack((np.column_stack((axes, position)), (0, 0, 0, 1)))


def flat(matrix):
    return ", ".join(map(repr, matrix.ravel().tolist()))


IDENTITY = flat(np.eye(4))


STANDING = rows()


def metashape(transform="", camera=STANDING, reference="", of='component_id="0"'):
    """A project whose chunk's component has a transform; IMG_0003 was not aligned."""
    cameras = f"""<components><component id="0"><transform>{transform}</transform></component></components>
      <cameras><group><camera id="0" sensor_id="1" {of} label="IMG_0002"><transform>{flat(camera).replace(",", "")}
      </transform></camera></group><camera id="1" sensor_id="0" label="IMG_0003"/></cameras>{reference}</chunk>"""
    return PROJECT.replace("</chunk>", cameras)


def test_maplab_leads_from_the_camera_to_the_body(tmp_path):
    (camera,) = read(tmp_path, ncamera("pinhole", "none", [0.0]).replace(IDENTITY.replace(".0", ""), flat(rows())))
    np.testing.assert_allclose(in_view(camera.poses[0]), (POINTS - PLACE) @ AXES * TO_BLENDER, atol=1e-14)
    assert (camera.name, camera.frames, camera.size) == ("front", [None], (640, 480))


def test_maplabs_rig_stands_in_the_body_of_all_sensors(tmp_path):
    rig = "\n".join(f"    {line}" for line in ncamera("pinhole", "none", [0.0]).splitlines()[1:])
    text = f"sensors:\n  - id: ab\n    sensor_type: NCAMERA\n{rig}\nextrinsics:\n  - sensor_id: ab\n    T_B_S:\n"
    text += "      rows: 4\n      cols: 4\n      data:\n" + "".join(f"        - [{flat(row)}]\n" for row in rows())
    (camera,) = read(tmp_path, text)
    np.testing.assert_allclose(in_view(camera.poses[0]), (POINTS - PLACE) @ AXES * TO_BLENDER, atol=1e-14)


@pytest.mark.parametrize("in_world", [True, False])
def test_hot3d_leads_from_the_camera_to_the_world_or_the_headset(tmp_path, in_world):
    streams = json.loads(hot3d(T_device_from_camera={} if in_world else QUATERNION))
    if in_world:
        streams["214-1"]["T_world_from_camera"] = QUATERNION
    else:
        del streams["214-1"]["T_world_from_camera"]
    (camera,) = read(tmp_path, json.dumps(streams))
    np.testing.assert_allclose(in_view(camera.poses[0]), (POINTS - PLACE) @ QUARTER * TO_BLENDER, atol=1e-14)
    assert camera.name == "camera-rgb"


def test_metashapes_chunk_is_turned_scaled_and_moved(tmp_path):
    moved = f"<rotation>{flat(QUARTER).replace(',', '')}</rotation><translation>1 2 3</translation><scale>2</scale>"
    (camera,) = read(tmp_path, metashape(moved))
    in_chunk = (POINTS - (1, 2, 3)) @ QUARTER / 2
    np.testing.assert_allclose(in_view(camera.poses[0]), (in_chunk - PLACE) @ AXES * 2 * TO_BLENDER, atol=1e-14)
    assert (camera.name, camera.frames, camera.lenses[0].name) == ("IMG", [2], "right")
    (plain,) = read(tmp_path, metashape(of=""))
    np.testing.assert_allclose(in_view(plain.poses[0]), (POINTS - PLACE) @ AXES * TO_BLENDER, atol=1e-14)


LOCATION = np.array((0.5, 0.0, 1.0))
OFFSET = f"<rotation>{flat(QUARTER).replace(',', '')}</rotation><location>0.5 0 1</location>"


def rig(offset=OFFSET, master="0", label="IMG_0002"):
    """The project above with a scale of 2, in which a camera of the left sensor follows IMG_0002; IMG_0003 has none."""
    left = '<sensor id="0" label="left" type="frame">'
    slaves = f"""<camera id="2" sensor_id="0" master_id="{master}" label="{label}"/>
      <camera id="3" sensor_id="0" master_id="1" label="IMG_0003"/></group>"""
    return metashape("<scale>2</scale>").replace(left, left + offset).replace("</group>", slaves)


def test_metashapes_slave_stands_beside_its_master(tmp_path):
    master, slave = read(tmp_path, rig())
    in_master = (POINTS / 2 - PLACE) @ AXES
    np.testing.assert_allclose(in_view(master.poses[0]), in_master * 2 * TO_BLENDER, atol=1e-14)
    np.testing.assert_allclose(in_view(slave.poses[0]), (in_master - LOCATION) @ QUARTER * 2 * TO_BLENDER, atol=1e-14)
    assert [(camera.name, camera.frames, camera.lenses[0].name) for camera in (master, slave)] == [
        ("IMG-1", [2], "right"), ("IMG-2", [2], "left")
    ]  # fmt: skip
    _, beside = read(tmp_path, rig(offset=""))
    np.testing.assert_allclose(in_view(beside.poses[0]), in_master * 2 * TO_BLENDER, atol=1e-14)


@pytest.mark.parametrize(("latitude", "longitude"), [(0.0, 0.0), (np.radians(48.2), np.radians(-120.4))])
def test_a_georeferenced_project_is_east_north_up_about_its_cameras(tmp_path, latitude, longitude):
    """One camera looks down, north up in its picture; the Earth's radius of curvature is that of WGS 84."""
    s, c = np.sin(latitude), np.cos(latitude)
    up = np.array((c * np.cos(longitude), c * np.sin(longitude), s))
    east = np.array((-np.sin(longitude), np.cos(longitude), 0.0))
    squared = 0.0066943799901413165
    radius = 6378137.0 / np.sqrt(1 - squared * s * s)
    center = radius * up - (0, 0, squared * radius * s) + 120.0 * up
    transform = f"<translation>{' '.join(map(repr, center.tolist()))}</translation><scale>3</scale>"
    axes = np.column_stack((east, -np.cross(up, east), -up))
    text = metashape(transform, rows(axes, np.zeros(3)), '<reference>GEOGCS["WGS 84"]</reference>')
    (camera,) = read(tmp_path, text)
    np.testing.assert_allclose(camera.poses[0], np.eye(4), atol=1e-11)  # Blender's camera looks along -z, y up


def of_meshroom(rotation=AXES, center=PLACE):
    """A pose of AliceVision: the rotation from the world to the camera, stored by columns, as text."""
    return {"rotation": list(map(repr, rotation.ravel(order="F").tolist())), "center": list(map(repr, center.tolist()))}


def test_meshrooms_rotation_is_from_the_world_and_by_columns(tmp_path):
    views = [{"viewId": "5", "poseId": "9", "intrinsicId": "7", "path": "C:/in/left_0004.jpg"},
             {"viewId": "6", "poseId": "1", "intrinsicId": "7", "path": "C:/in/left_0005.jpg"}]  # fmt: skip
    text = json.loads(sfm()) | {"views": views, "poses": [{"poseId": "9", "pose": {"transform": of_meshroom()}}]}
    (camera,) = read(tmp_path, json.dumps(text))
    np.testing.assert_allclose(in_view(camera.poses[0]), (POINTS - PLACE) @ AXES.T * TO_BLENDER, atol=1e-14)
    assert (camera.name, camera.frames) == ("left", [4])
    inner = {"status": "estimated", "pose": of_meshroom(QUARTER, np.array((0.5, 0.0, 1.0)))}
    views[0] |= {"rigId": "3", "subPoseId": "1", "isPoseIndependant": "false"}
    (camera,) = read(tmp_path, json.dumps(text | {"rigs": [{"rigId": "3", "subPoses": [{}, inner]}]}))
    in_rig = (POINTS - PLACE) @ AXES.T
    np.testing.assert_allclose(in_view(camera.poses[0]), (in_rig - (0.5, 0, 1)) @ QUARTER.T * TO_BLENDER, atol=1e-14)


def polycam(position=PLACE, fx=300.0):
    return json.dumps({"fx": fx, "fy": 301.0, "cx": 326.5, "cy": 236.75, "width": 640, "height": 480}
                      | {f"t_{i}{j}": t for (i, j), t in np.ndenumerate(rows(position=position)[:3])})  # fmt: skip


@pytest.mark.parametrize("folder", ["", "keyframes/corrected_cameras"])
def test_polycams_cameras_have_y_up_and_a_frame_for_each_file(tmp_path, folder):
    (camera,) = read(tmp_path, polycam())
    np.testing.assert_allclose(in_view(camera.poses[0]), (POINTS - PLACE) @ AXES, atol=1e-14)
    (tmp_path / "capture" / folder).mkdir(parents=True)
    for time, x in ((10_000, 2), (9_000, 1), (11_000, 3)):
        (tmp_path / "capture" / folder / f"{time}.json").write_text(polycam(PLACE * x, 300.0 + (x == 3)))
    (camera,) = read(tmp_path / "capture")
    assert camera.frames == [1, 2, 3]
    np.testing.assert_allclose([pose[:3, 3] for pose in camera.poses], [PLACE, PLACE * 2, PLACE * 3])
    assert camera.lenses[0] is camera.lenses[1]
    assert camera.lenses[2].settings["fx"] == 301


def test_a_clip_of_hot3d_has_a_frame_for_each_file(tmp_path):
    for frame in (7, 12):
        (tmp_path / f"{frame:06}.cameras.json").write_text(hot3d(T_device_from_camera=QUATERNION).replace(
            '"T_world_from_camera": {}', f'"T_world_from_camera": {json.dumps(QUATERNION)}'))  # fmt: skip
    (camera,) = read(tmp_path)
    assert (camera.name, camera.frames) == ("camera-rgb", [7, 12])
    assert camera.lens is not None


PLACE_2 = np.array((0.0, 0.0, 5.0))
TRAJECTORY = f"10.0 0 {np.pi / 2} 0 1.0 2.0 3.0\n10.5004 0 0 0 0 0 5\n"
"""World to camera: a quarter turn about y, and a place."""


@pytest.mark.parametrize("inside", [True, False])
def test_arkitscenes_is_from_the_world_to_the_camera(tmp_path, inside):
    folder = tmp_path / "lowres_wide_intrinsics"
    folder.mkdir()
    (tmp_path / "lowres_wide.traj").write_text(TRAJECTORY)
    for time, fx in (("10.500", 200.5), ("10.000", 200), ("10.250", 200)):
        (folder / f"41_{time}.pincam").write_text(f"256 192 {fx} 201 127.5 95\n")
    (camera,) = read(folder if inside else tmp_path)
    first = POINTS @ np.array(((0, 0, 1), (0, 1, 0), (-1, 0, 0))).T + (1, 2, 3)
    np.testing.assert_allclose(in_view(camera.poses[0]), first * TO_BLENDER, atol=1e-14)
    np.testing.assert_allclose(in_view(camera.poses[1]), (POINTS + PLACE_2) * TO_BLENDER, atol=1e-14)
    assert camera.frames == [1, 3]  # no pose is near to the second one's time
    assert [lens.settings["fx"] for lens in camera.lenses] == [200, 200.5]
    assert camera.lenses[0].settings["cx"] == 127.5
    (path,) = read(tmp_path / "lowres_wide.traj")
    assert path.frames == pytest.approx([1, 13.0096])


REFUSED = {
    "Metashape, none aligned": (metashape().replace("transform>", "else>"), "none of its cameras has a transform"),
    "Metashape, scale": (metashape("<scale>-1</scale>"), "scale of a chunk is -1: it must be above 0"),
    "Metashape, sheared": (metashape(camera=np.triu(np.ones((4, 4)))), "transform of IMG_0002 is no rotation"),
    "Metashape, short": (metashape().replace("1.5 ", "", 1), "transform of IMG_0002 has 15 numbers: a pose has"),
    "Metashape, master": (rig(master="7", label="IMG_0009"), "master_id of IMG_0009 is 7: no camera of its chunk has"),
    "Metashape, slave": (rig(OFFSET.replace("-1.0", "-2.0")), "rotation of sensor 0 is no rotation"),
    "Metashape, location": (rig(OFFSET.replace("0.5 0 1", "0.5 x")), "location of sensor 0 is .*: it must be 3 finite"),
    "Meshroom, none": (sfm(), "it has no poses of its views: give the file of StructureFromMotion"),
    "Meshroom, rig": (
        json.dumps(json.loads(sfm()) | {
            "views": [{"poseId": 1, "rigId": 2, "subPoseId": 4, "isPoseIndependant": False}],
            "poses": [{"poseId": 1, "pose": {"transform": of_meshroom()}}], "rigs": [{"rigId": 2, "subPoses": []}],
        }), "subPoseId of .* is 4: its rig has 0 cameras"),
    "maplab": (ncamera("pinhole", "none", [0.0]).replace(IDENTITY.replace(".0", ""), flat(rows(2 * AXES))),
               "T_B_C of front is no rotation"),
    "HOT3D": (hot3d(), "it has no quaternion_wxyz of camera-rgb"),
    "Polycam": (polycam().replace('"t_23"', '"t_24"'), "it has no t_23"),
    "TUM, long": ("1.0 0 0 0 0 1 0 0 0\n", "its lines have 9 numbers: those of .* of TUM 8"),
    "ARKit": ("1 0 0 0 0 0 5\n2 0 0 0 0 0\n", "its lines have 7 numbers: those of .* ARKitScenes .\\.traj. 7"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_pose_of_the_format_is_refused(tmp_path, name):
    text, words = REFUSED[name]
    with pytest.raises(InputError, match=words) as caught:
        read(tmp_path, text)
    assert "\n" not in str(caught.value)


def test_woodscape_leads_from_the_camera_to_the_vehicle(tmp_path):
    """Its camera looks along the vehicle's x, and its right is the vehicle's -y."""
    (camera,) = read(tmp_path, (SAMPLES / "woodscape.json").read_text())
    right, up, back, position = camera.poses[0][:3].T
    axes = [[0, -1, 0], [0, 0, 1], [1, 0, 0]]
    np.testing.assert_allclose([right, up, -back, position], [*axes, [3, 0.5, 1.25]], rtol=0, atol=1e-15)


def test_orb_slam_leads_from_the_second_camera_to_the_first(tmp_path):
    lens = "{0}.fx: 300\n{0}.fy: 300\n{0}.cx: 320\n{0}.cy: 240\n{0}.k1: 0.1\n{0}.k2: 0.1\n{0}.k3: 0.1\n{0}.k4: 0\n"
    pair = lens.format("Camera1") + lens.format("Camera2")
    pose = [[0, 1, 0, 0.5], [-1, 0, 0, 0.25], [0, 0, 1, 2], [0, 0, 0, 1]]
    first, second = read(tmp_path, f"Camera.type: KannalaBrandt8\n{pair}Stereo.T_c1_c2: {pose}\n")
    np.testing.assert_array_equal(first.poses[0] @ FROM_BLENDER, np.eye(4))
    np.testing.assert_array_equal(second.poses[0] @ FROM_BLENDER, pose)
    assert (first.name, second.name) == ("Camera1", "Camera2")
    assert second.lens.model == "OPENCV_FISHEYE"


def test_numbers_of_pictures_that_are_no_frames_are_none(tmp_path):
    names = ["frame_14036365797645.png", "IMG_20230415_101502.jpg", "VID_2023-04-15_10-15.jpg"]
    frames = [{"file_path": name, "transform_matrix": np.eye(4).tolist()} for name in names]
    (camera,) = read(tmp_path, json.dumps({"fl_x": 300, "w": 640, "h": 480, "frames": frames}))
    assert (camera.name, camera.frames) == ("Camera", [1, 2, 3])


def test_half_a_character_is_refused(tmp_path):
    text = r'{"fl_x": 300, "w": 64, "h": 48, "frames": [{"file_path": "\ud83d%s", "transform_matrix": %s}]}'
    with pytest.raises(InputError, match="a name has half of a character"):
        read(tmp_path, text % ("x", np.eye(4).tolist()))
    (camera,) = read(tmp_path, text % (r"\ude00_0003.png", np.eye(4).tolist()))
    assert (camera.name, camera.frames) == ("\N{GRINNING FACE}", [3])


def test_pictures_of_arkitscenes_need_their_trajectory(tmp_path):
    (tmp_path / "41_1.0.pincam").write_text("256 192 200 201 127.5 95\n")
    with pytest.raises(InputError, match=r"has 0 trajectories \(.traj\) beside its files"):
        read(tmp_path)
    (tmp_path / "a.traj").write_text("hello")
    with pytest.raises(InputError, match="its lines must have seven numbers: a time"):
        read(tmp_path)
    (tmp_path / "a.traj").write_text(TRAJECTORY)
    with pytest.raises(InputError, match="has no picture at a time of its trajectory"):
        read(tmp_path)
