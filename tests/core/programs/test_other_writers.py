"""Files as other versions of the same programs write them: lens, pose and names by hand."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.programs.reading.mounted import mounted
from camera_ray_caster.core.records import InputError

from .test_contract import SAMPLES

UNIT = [1, 0, 0, 0, 1, 0, 0, 0, 1]
QUARTER = [0, -1, 0, 1, 0, 0, 0, 0, 1]
PLACE = [1.0, 2.0, 3.0]
TO_OPENCV = np.diag((1.0, -1.0, -1.0, 1.0))
"""A pose by which the world is the camera's frame, x right, y down, z ahead."""


def matrix(name, rows, numbers, space=" "):
    data = ", ".join(map(str, numbers))
    columns = len(numbers) // rows
    return f"{name}: !!opencv-matrix\n   rows: {rows}\n   cols: {columns}\n   dt: d\n   data:{space}[ {data} ]\n"


def settings(lens, *names):
    return [lens.settings.get(name, 0.0) for name in names]


def written(folder, name, content):
    path = folder / name
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return str(path)


def rig(path):
    return mounted(path, "", (640, 480), 24.0)


def K(f, cx, cy):
    return [f, 0, cx, 0, f, cy, 0, 0, 1]


def opensfm(**camera):
    shot = {"rotation": [0, 0, 0], "translation": [-1, -2, -3], "camera": "a"}
    return {"cameras": {"a": {"width": 400, "height": 300, "focal": 0.8} | camera}, "shots": {"x.jpg": shot}}


def meshroom(**entries):
    camera = {"intrinsicId": "1", "width": "400", "height": "300", "sensorWidth": "36", "focalLength": "27",
              "type": "pinhole", "principalPoint": ["1", "-2"]} | entries  # fmt: skip
    transform = {"rotation": [*map(str, UNIT)], "center": [*map(str, PLACE)]}
    return {"version": ["1", "2", "11"], "intrinsics": [camera],
            "views": [{"viewId": "1", "poseId": "1", "intrinsicId": "1", "path": "a.jpg"}],
            "poses": [{"poseId": "1", "pose": {"transform": transform}}]}  # fmt: skip


PHOTOSCAN = """<document version="0.9.1"><chunk><sensors><sensor id="0" label="A"><calibration type="frame">
<resolution width="400" height="300"/><fx>310</fx><fy>300</fy><cx>201</cx><cy>148</cy><skew>0.5</skew><k1>-0.05</k1>
<p1>0.001</p1><p2>0.002</p2></calibration></sensor></sensors><cameras><camera id="0" label="a" sensor_id="0">
<transform>1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1</transform></camera></cameras></chunk></document>"""
XMP = """<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description xmlns:xcr="http://www.capturingreality.com/ns/xcr/1.1#" xcr:DistortionModel="{1}"
xcr:FocalLength35mm="36"><xcr:Rotation>1 0 0 0 1 0 0 0 1</xcr:Rotation><xcr:Position>1 2 3</xcr:Position>
<xcr:DistortionCoeficients>{0}</xcr:DistortionCoeficients></rdf:Description></rdf:RDF></x:xmpmeta>"""
SPLAT = {"img_name": "a", "width": 400, "height": 300, "position": PLACE, "rotation": np.eye(3).tolist(),
         "fx": 310, "fy": 300, "cx": 190.5, "cy": 160.5}  # fmt: skip
ORB = "Camera.fx: 300\nCamera.fy: 301\nCamera.cx: 200\nCamera.cy: 150\n"
FILES = {
    "splat.json": ([SPLAT], {"fx": 310, "fy": 300, "cx": 190, "cy": 160}),
    "fractions.json": ([SPLAT | {"cx": 0.475, "cy": 0.535}], {"fx": 310, "fy": 300, "cx": 189.5, "cy": 160}),
    "photoscan.xml": (
        PHOTOSCAN, {"fx": 310, "fy": 300, "cx": 200.5, "cy": 147.5, "skew": 0.5, "k1": -0.05, "p1": 0.001, "p2": 0.002}
    ),
    "radialk3pt.sfm": (
        meshroom(distortionType="radialk3pt", distortionParams=["0.25", "0", "-0.05"]),
        {"fx": 300 / 1.2, "fy": 300 / 1.2, "cx": 201, "cy": 148, "k1": 0.25, "k3": -0.05},
    ),
    "alone.json": (opensfm(k1=0.01), {"fx": 320, "cx": 199.5, "k1": 0.01}),
    "fisheye624.json": (
        [opensfm(projection_type="fisheye624", k1=0.01, k4=0.02, p1=0.003, p2=0.004, s0=0.005, s2=0.006)],
        {"fx": 320, "k1": 0.01, "k4": 0.02, "p1": 0.003, "p2": 0.004, "s1": 0.005, "s3": 0.006},
    ),
    "turned.nvm": (
        f"NVM_V3_R9T\n\n1\na.jpg 300 {' '.join(map(str, QUARTER))} 2 -1 -3 0 0\n", {"fx": 300, "cx": 319.5}
    ),
    "no_distortion.xmp": (XMP.format("0 0 0 0 0 0", "division"), {"fx": 640, "k1": 0}),
    "semicolons.csv": ("#name;x;y;alt;heading;pitch;roll;f\na.jpg;1;2;3;0;0;0;36\n", {"fx": 640}),
    "body.yaml": (ORB + matrix("IMU.T_b_c1", 4, [1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1]), {"fx": 300}),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_lens_and_place_are_those_of_the_file(name, tmp_path):
    content, wanted = FILES[name]
    (camera,) = rig(written(tmp_path, name, content))
    assert settings(camera.lenses[0], *wanted) == pytest.approx([*wanted.values()], rel=1e-14)
    assert camera.poses[0][:3, 3] == pytest.approx(PLACE, abs=1e-15)


REFUSED = {
    "k5.json": ([opensfm(projection_type="fisheye62", k5=0.1, p1=0.1)], "its k5 of a fisheye62 is not 0"),
    "s3.json": ([opensfm(projection_type="fisheye624", k1=0.1, s3=0.1)], "its s3 of a fisheye624 is not 0"),
    "fractions.json": ([SPLAT | {"fx": 0.8, "fy": 0.8, "cx": 0.5, "cy": 0.5}], "fx of a is 0.8: it must be in pixels"),
    "sum.sfm": (meshroom(distortionType="radialk3pt", distortionParams=["-1", "0", "0"]), "add up to 0"),
    "k4.xmp": (XMP.format("0.1 0 0 0.2 0 0", "brown3"), "DistortionModel is brown3, but its k4 is not 0"),
    "t1.xmp": (XMP.format("0.1 0 0 0.2 0.01 0", "brown4"), "DistortionModel is brown4, but its t1 is not 0"),
    "both.xmp": (XMP.format("0.1 0 0 0.2 0.01 0", "brown4t2"), "k4, t1 and t2 of the picture are not 0"),
    "division.xmp": (XMP.format("0.1 0 0 0 0 0", "division"), "DistortionModel is division, which is not read"),
    "no_f.csv": ("#name,x,y,alt,heading,pitch,roll\na.jpg,1,2,3,0,0,0\n", "no f of a.jpg"),
    "crop.pto": ('i w400 h400 f2 v180 r0 p0 y0 C10,390,10,390 n"a.jpg"\n', "a.jpg is cropped (C)"),
    "board.json": ({"K": K(300, 200, 150), "calib_size": [9, 6]}, "9 x 6, but its center 200, 150: is the size"),
    "left.json": ({"K": K(300, 200, 150), "left_D": [0.1, 0, 0, 0]}, "left_D may be its distortion"),
    "right.json": ({"K": K(300, 200, 150), "right_K": K(310, 200, 150)}, "two cameras, one of them named right"),
    "fusion.yaml": ('%YAML:1.0\ncam0_calib: "cam0_mei.yaml"\nnum_of_cam: 1\n', "give cam0_mei.yaml"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_read_is_named(name, tmp_path):
    content, says = REFUSED[name]
    path = written(tmp_path, name, content)
    try:
        refusal = lenses_of(path, "", (640, 480))[0].refusal
    except InputError as raised:
        refusal = raised
    assert says in str(refusal)
    assert "\n" not in str(refusal)


@pytest.mark.parametrize("terms", [
    {"k1": 0.1, "k4": 0.02, "k5": -0.01, "k6": 0.005}, {"p1": 0.01, "p2": -0.02, "s0": 0.03, "s1": 0.01, "s3": -0.02},
    {"k1": 0.1, "k4": 0.02, "p1": 0.01, "p2": -0.02, "s0": 0.03, "s2": 0.01},
], ids=["radial", "across", "both"])  # fmt: skip
def test_fisheyes_of_opensfm_by_its_formula(terms, tmp_path):
    """x (1 + k1 r2 + ...) + 2 p1 x y + p2 (r2 + 2 x2) + s0 r2 + s1 r4, and so on, where r is the angle."""
    path = written(tmp_path, "a.json", [opensfm(projection_type="fisheye624", **terms)])
    point = np.array((0.3, -0.4, 1.0))
    angle, k = np.arctan(0.5), {name: terms.get(name, 0.0) for name in ("p1", "p2", "s0", "s1", "s2", "s3")}
    x, y, r2 = angle * 0.6, angle * -0.8, angle**2
    gain = 1 + sum(terms.get(f"k{n}", 0.0) * r2**n for n in range(1, 7))
    u = x * gain + 2 * k["p1"] * x * y + k["p2"] * (r2 + 2 * x * x) + k["s0"] * r2 + k["s1"] * r2**2
    v = y * gain + 2 * k["p2"] * x * y + k["p1"] * (r2 + 2 * y * y) + k["s2"] * r2 + k["s3"] * r2**2
    pixel = crc.load_calibration(path, pose=TO_OPENCV).project(point, rows="top")
    assert pixel == pytest.approx((320 * u + 199.5, 320 * v + 149.5), abs=1e-9)


def test_tangential_terms_of_realitycapture(tmp_path):
    """Those of x are t1 (r2 + 2 x2) + 2 t2 x y, as in Brown's formula: t1 and t2 are p2 and p1 of OpenCV."""
    path = written(tmp_path, "a.xmp", XMP.format("0.1 -0.02 0.01 0 0.003 -0.002", "brown3t2"))
    x, y, r2 = 0.3, -0.4, 0.25
    gain = 1 + 0.1 * r2 - 0.02 * r2**2 + 0.01 * r2**3
    u = x * gain + 0.003 * (r2 + 2 * x * x) - 0.002 * 2 * x * y
    v = y * gain - 0.002 * (r2 + 2 * y * y) + 0.003 * 2 * x * y
    pixel = crc.load_calibration(path, size=(640, 480), pose=TO_OPENCV).project((x, y, 1.0), rows="top")
    assert pixel == pytest.approx((640 * u + 319.5, 640 * v + 239.5), abs=1e-9)


def test_a_place_that_vins_does_not_use_is_not_read(tmp_path):
    lens = ("%YAML:1.0\nmodel_type: PINHOLE\nimage_width: 400\nimage_height: 300\n"
            "distortion_parameters:\n  k1: 0\n  k2: 0\n  p1: 0\n  p2: 0\n"
            "projection_parameters:\n  fx: 300\n  fy: 300\n  cx: 200\n  cy: 150\n")  # fmt: skip
    extrinsic = matrix("extrinsicRotation", 3, np.eye(3).ravel().tolist()) + matrix("extrinsicTranslation", 1, PLACE)
    (camera,) = rig(written(tmp_path, "used.yaml", f"{lens}estimate_extrinsic: 1\n{extrinsic}"))
    assert camera.poses[0][:3, 3].tolist() == PLACE
    with pytest.raises(InputError, match="it has no pose of a camera"):
        rig(written(tmp_path, "unused.yaml", f"{lens}estimate_extrinsic: 2\n{extrinsic}"))


def test_the_view_of_isaac_sim_is_its_pose():
    """A quarter turn about z; 3 m above (1, 2): its centimeters are 100, 200 and 300."""
    (camera,) = rig(str(SAMPLES / "nvidia.json"))
    assert camera.poses[0][:3] == pytest.approx(np.array([[0, 1, 0, 1], [-1, 0, 0, 2], [0, 0, 1, 3]]), abs=1e-15)


PAIR = [("left", [300, 200, 150]), ("right", [310, 201, 151])]
PLACES = matrix("R", 3, UNIT) + matrix("T", 3, [-0.12, 0, 0])


@pytest.mark.parametrize("files", [
    {"pair.yml": "".join(matrix(f"{side}_camera_matrix", 3, K(*numbers)) + matrix(f"{side}_distortion", 1, [0.1] * 5)
                         for side, numbers in PAIR) + PLACES},
    {"intrinsics.yml": "".join(matrix(f"M{i}", 3, K(*numbers)) + matrix(f"D{i}", 1, [0.1] * 5)
                               for i, (_, numbers) in enumerate(PAIR, 1)),
     "extrinsics.yml": PLACES + matrix("R1", 3, UNIT) + matrix("R2", 3, UNIT)},
], ids=["words before", "two files"])  # fmt: skip
def test_pairs_of_opencv(files, tmp_path):
    for path in [written(tmp_path, name, content) for name, content in files.items()]:
        first, second = rig(path)
        assert [camera.lens.settings["fx"] for camera in (first, second)] == [300, 310]
        assert [camera.lens.settings["k1"] for camera in (first, second)] == [0.1, 0.1]
        assert [camera.poses[0][0, 3] for camera in (first, second)] == pytest.approx([0, 0.12])


def test_the_matrices_that_rectified_a_pair_of_orbslam_are_not_its_camera(tmp_path):
    text = ORB + "LEFT.width: 400\n" + matrix("LEFT.K", 3, K(400, 210, 140), "") + matrix("LEFT.D", 1, [0.1] * 5, "")
    (lens,) = lenses_of(written(tmp_path, "stereo.yaml", text))
    assert settings(lens, "fx", "cx", "k1") == [300, 200, 0]


def test_of_echoed_messages_the_first_is_read(tmp_path):
    message = f"header:\n  seq: 1\nheight: 300\nwidth: 400\ndistortion_model: plumb_bob\nD: []\nK: {K(300, 200, 150)}\n"
    (lens,) = lenses_of(written(tmp_path, "echo.yaml", f"{message}---\n{message}---\n"))
    assert settings(lens, "fx", "calibration_width") == [300, 400]
    with pytest.raises(InputError, match="line 9 begins a second document"):
        lenses_of(written(tmp_path, "two.yaml", f"{message}---\nK: 1\n"))
    camera = message.split("seq: 1\n")[1]
    with pytest.raises(InputError, match="line 7 begins a second document"):
        lenses_of(written(tmp_path, "cameras.yaml", f"{camera}---\n{camera}"))


@pytest.mark.parametrize("size", [
    {"image_resolution": [400, 300]}, {"image_size_hw": [300, 400]}, {"resolution_x": 400, "resolution_y": 300},
    {"image_dims": [400, 300]}, {"width_px": 400, "height_px": 300}, {"calib_size": [400, 300]},
], ids=lambda size: next(iter(size)))  # fmt: skip
def test_sizes_by_other_names(size, tmp_path):
    (lens,) = lenses_of(written(tmp_path, "camera.json", {"K": K(300, 200, 150)} | size))
    assert lens.size == (400, 300)


BENT = "Kd", "ks", "extra_params", "fisheye_params", "poly", "lens_correction", "distortion_w"


@pytest.mark.parametrize("name", BENT)
def test_a_distortion_that_is_not_understood_is_named(name, tmp_path):
    content = {"K": K(300, 200, 150), name: 0.9 if name == "distortion_w" else [-0.2, 0.1]}
    with pytest.raises(InputError, match=f"{name} may be its distortion"):
        lenses_of(written(tmp_path, "camera.json", content))


def test_folders_name_cameras_with_lenses_of_their_own(tmp_path):
    pose = [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]
    frames = [
        {"file_path": f"{camera}/x_{number:04}.png", "fl_x": focal, "cx": 200, "cy": 150, "w": 400, "h": 300,
         "transform_matrix": pose}
        for camera, focal in (("cam0", 300), ("cam1", 310)) for number in (1, 2)
    ]  # fmt: skip
    cameras = rig(written(tmp_path, "transforms.json", {"frames": frames}))
    assert [(camera.name, camera.frames, camera.lens.settings["fx"]) for camera in cameras] == [
        ("cam0", [1, 2], 300), ("cam1", [1, 2], 310)
    ]  # fmt: skip


@pytest.mark.parametrize(("names", "wanted"), [
    (["image_00/data/0000000005.png", "image_01/data/0000000005.png"], {"image_00": [5], "image_01": [5]}),
    (["a/0.jpg", "a/1.jpg", "b/0.jpg", "b/1.jpg"], {"a": [1, 2], "b": [1, 2]}),
    (["x/a.jpg", "x/b.jpg"], {"Camera": [1, 2]}),
    (["x_0001_left.png", "x_0001_right.png", "x_0002_left.png"], {"x_left": [1, 2], "x_right": [1]}),
    (["000000_rgb.png", "000010_rgb.png"], {"rgb": [0, 10]}),
    (["frame-000007.color.jpg", "frame-000009.color.jpg"], {"frame_color": [7, 9]}),
    (["IMG_20230101_120000_HDR.jpg", "IMG_20230101_120005_HDR.jpg"], {"Camera": [1, 2]}),
    (["DJI_20240101120156_0001_D.JPG", "DJI_20240101120204_0002_D.JPG"], {"Camera": [1, 2]}),
    (["DJI_20240101120156_0001.JPG", "DJI_20240101120204_0002.JPG"], {"Camera": [1, 2]}),
    (["0001_kitchen.jpg", "0002_garden.jpg"], {"Camera": [1, 2]}),
    (["IMG_0001.jpg", "IMG_0002_HDR.jpg", "IMG_0003.jpg"], {"Camera": [1, 2, 3]}),
    (["A_0001.png", "B_0002.png"], {"A": [1], "B": [2]}),
])  # fmt: skip
def test_names_of_pictures_are_cameras_and_frames(names, wanted, tmp_path):
    pose = [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3]]
    frames = [{"file_path": name, "transform_matrix": pose} for name in names]
    content = {"fl_x": 300, "cx": 200, "cy": 150, "w": 400, "h": 300, "frames": frames}
    cameras = rig(written(tmp_path, "transforms.json", content))
    assert {camera.name: camera.frames for camera in cameras} == wanted


def test_cameras_of_depthai_that_lead_nowhere_are_not_placed(tmp_path):
    camera = {"cameraType": 0, "intrinsicMatrix": np.reshape(K(300, 200, 150), (3, 3)).tolist(), "width": 400,
              "height": 300, "extrinsics": {"toCameraSocket": -1}}  # fmt: skip
    path = written(tmp_path, "device.json", {"cameraData": [[0, camera], [1, camera]]})
    with pytest.raises(InputError, match="extrinsics of CAM_B lead to no camera, and so do those of CAM_A"):
        rig(path)


def test_rational_polynomials_as_gdal_tells_them(tmp_path):
    offsets = {"LINE": (500, 500), "SAMP": (600, 600), "LAT": (45, 0.05), "LONG": (7, 0.06), "HEIGHT": (200, 500)}
    text = "".join(f"{name}_OFF={offset}\n{name}_SCALE={scale}\n" for name, (offset, scale) in offsets.items())
    terms = {"LINE_NUM": {0: 0.001, 2: -1, 3: 0.02}, "SAMP_NUM": {1: 1, 3: -0.015}}
    terms |= {"LINE_DEN": {0: 1}, "SAMP_DEN": {0: 1}}

    def lines(one_by_one):
        for name, powers in terms.items():
            numbers = [powers.get(i, 0) for i in range(20)]
            if one_by_one:
                yield from (f"{name}_COEFF_{i}: {number}\n" for i, number in enumerate(numbers, 1))
            else:
                yield f"{name}_COEFF={' '.join(map(str, numbers))}\n"

    (listed,), (apart,) = (lenses_of(written(tmp_path, name, text + "".join(lines(name == "apart.txt"))))
                           for name in ("listed.txt", "apart.txt"))  # fmt: skip
    assert repr(listed) == repr(apart)
