"""Files of calibrations: deep, long, binary, cut off, of numbers that are none."""

import json
import random
import re

from .parts import Hostile

COUNT = 320

YAML = """%YAML:1.0
---
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 500., 0., 320., 0., 500., 240., 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 4
   dt: d
   data: [ -0.2, 0.1, 0.001, 0. ]
"""
PLAIN = {
    "image_width": 640,
    "image_height": 480,
    "camera_matrix": {"rows": 3, "cols": 3, "data": [500.0, 0, 320, 0, 500, 240, 0, 0, 1]},
    "distortion_coefficients": {"data": [-0.2, 0.1, 0.001, 0.0]},
}
NUMBERS = (
    "1e999", "-1e999", ".Nan", ".Inf", "-.Inf", "NaN", "1" * 5000, "1" * 400, "0x10", "1e-400", "1_000", "٣", "-0",
    "1e308", "1e30", "1e-30", "true", "null", '"5"', "[]", "{}", "0", "-1", "500.0.0", "1e", "",
)  # fmt: skip


F_THETA = {
    "resolution": [640, 480],
    "principal_point": [321.25, 238.5],
    "reference_poly": "ANGLE_TO_PIXELDIST",
    "pixeldist_to_angle_poly": [0.0, 0.0033, 1e-7],
    "angle_to_pixeldist_poly": [0.0, 301.5, 2.25, -7.5],
    "max_angle": 1.25,
    "linear_cde": [1.0005, 0.0002, -0.0001],
}
RIG = {
    "Model": "ftheta", "width": "640", "height": "480", "cx": "321.25", "cy": "238.5",
    "polynomial-type": "pixeldistance-to-angle", "polynomial": "0 0.0033 1e-7", "linear-c": "1.0005",
}  # fmt: skip
OCAM = """#polynomial coefficients for the DIRECT mapping function (ocam_model.ss in MATLAB)

5 -231.5226 0.0 0.0017 -2e-07 6e-09

#polynomial coefficients for the inverse mapping function

3 271.591627 73.232250 -23.495515

#center
238.5 321.25
#affine parameters
0.9991 0.0003 -0.0004
#image size
480 640
"""
CAMCHAIN = """cam0:
  camera_model: pinhole
  distortion_model: radtan
  distortion_coeffs: [-0.2, 0.1, 0.001, 0.002]
  intrinsics: [500.0, 501.0, 320.5, 240.5]
  resolution: [640, 480]
"""
MRCAL = """{
  'lensmodel': 'LENSMODEL_OPENCV4',
  'intrinsics': [500.0, 501.0, 320.5, 240.5, -0.2, 0.1, 0.001, 0.002],
  'imagersize': [640, 480],
}
"""
COLMAP = "# Camera list\n1 OPENCV 640 480 500.0 501.0 320.5 240.5 -0.2 0.1 0.001 0.002\n"
NERFSTUDIO = {
    "camera_model": "OPENCV", "w": 640, "h": 480, "fl_x": 500.0, "cx": 320.5, "k1": -0.2,
    "frames": [{"file_path": "a.png", "k2": 0.1}],
}  # fmt: skip
ARIA = {"CameraCalibrations": [
    {"Label": "rgb", "Projection": {"Name": "KannalaBrandtK3", "Params": [500.0, 501, 320.5, 240.5, 0.1, 0, 0, 0]}}
]}  # fmt: skip
XML = """<?xml version="1.0"?>
<opencv_storage>
<image_width>640</image_width> <image_height>480</image_height>
<K type_id="opencv-matrix"><rows>3</rows> <cols>3</cols> <data> 500. 0. 320. 0. 500. 240. 0. 0. 1.</data></K>
<D type_id="opencv-matrix"><rows>1</rows> <cols>5</cols> <data> -0.2 0.1 0.001 0. 0.</data></D>
</opencv_storage>
"""
VINS = """%YAML:1.0
---
model_type: PINHOLE
image_width: 640
image_height: 480
distortion_parameters:
   k1: -0.2
   k2: 0.1
   p1: 0.001
   p2: 0.002
projection_parameters:
   fx: 500.0
   fy: 501.0
   cx: 320.5
   cy: 240.5
"""
ORB_SLAM = "%YAML:1.0\nCamera.fx: 500.0\nCamera.fy: 501.0\nCamera.cx: 32.5\nCamera.cy: 24.5\nCamera.k1: -0.2\n"
BASALT = {"value0": {"intrinsics": [{"camera_type": "kb4", "intrinsics": {
    "fx": 500.0, "fy": 501.0, "cx": 320.5, "cy": 240.5, "k1": 0.1, "k2": 0.0, "k3": 0.0, "k4": 0.0,
}}], "resolution": [[640, 480]]}}  # fmt: skip
PLACES = [(i / 5, j / 4) for j in range(5) for i in range(6)]
RAYS = [(round(x - 0.5, 3), round(0.8 * y - 0.4, 3), 1.0) for x, y in PLACES]
GENERIC = (
    "type: CentralGenericModel\nwidth: 640\nheight: 480\ncalibration_min_x: 0\ncalibration_min_y: 0\n"
    "calibration_max_x: 639\ncalibration_max_y: 479\ngrid_width: 6\ngrid_height: 5\n"
    f"grid: {[number for ray in RAYS for number in ray]}\n"
)
MESH = "u,v,dx,dy,dz\n" + "".join(f"{x},{y},{a},{b},{-c}\n" for (x, y), (a, b, c) in zip(PLACES, RAYS, strict=True))
OPENCV = "OPENCV_PINHOLE", "OPENCV_FISHEYE"
FILES = (
    ("lens.yml", YAML, OPENCV),
    ("lens.json", json.dumps(PLAIN), OPENCV),
    ("ncore.json", json.dumps(F_THETA), ("FTHETA",)),
    ("rig.json", json.dumps({"rig": {"sensors": [{"name": "camera", "properties": RIG}]}}), ("FTHETA",)),
    ("calib_results.txt", OCAM, ("OCAM",)),
    ("camchain.yaml", CAMCHAIN, OPENCV),
    ("lens.cameramodel", MRCAL, OPENCV),
    ("cameras.txt", COLMAP, OPENCV),
    ("transforms.json", json.dumps(NERFSTUDIO), OPENCV),
    ("aria.json", json.dumps(ARIA), OPENCV),
    ("lens.xml", XML, OPENCV),
    ("vins.yaml", VINS, OPENCV),
    ("orb.yaml", ORB_SLAM, OPENCV),
    ("basalt.json", json.dumps(BASALT), OPENCV),
    ("generic.yaml", GENERIC, ("RAY_TABLE",)),
    ("mesh.csv", MESH, ("RAY_TABLE",)),
)


def make(chance, number, folder):
    """Write one, and let the camera read it."""
    import bpy

    way = WAYS[number % len(WAYS)]
    name, text, models = chance.choice(FILES)
    change, content = way(chance, text, name.endswith((".yml", ".yaml")))
    path = folder / name
    path.write_bytes(content)
    group = bpy.context.scene.camera.data.camera_ray_caster
    group.model = chance.choice(models)
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = 64, 48
    group.calibration_file = str(path)
    return Hostile(f"{group.model}, {path.name}: {way.__name__[1:]} {change}")


def _number(chance, text, is_yaml):
    old = chance.choice(re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text))
    new = chance.choice(NUMBERS)
    return f"{new[:20]} for {old}", text.replace(old, new, chance.choice((1, 2))).encode()


def _kind(chance, text, is_yaml):
    old = chance.choice(re.findall(r"""(?<=[:,\[] )(?:-?\d[\d.e-]*|"[^"]*"|'[^']*'|[a-z]+)""", text) or ["0"])
    new = chance.choice(("[1]", '{"a": 1}', "null", "true", '"x"', "[[]]", "{}", "1e400", "-1", "0", "[[1], 2]", "{1}"))
    return f"{new} for {old[:20]}", text.replace(old, new, 1).encode()


def _deep(chance, text, is_yaml):
    depth = chance.choice((100, 10_000, 500_000))
    opening, closing = chance.choice((("[", "]"), ('{"a":', "}"), ("[", ""), ("- ", ""), ("a:\n ", "")))
    key = "deep: " if is_yaml else '{"deep": '
    end = "" if is_yaml else ', "x": 1}'
    return f"{depth} of {opening!r}", (key + opening * depth + "1" + closing * depth + end).encode()[: 1 << 20]


def _long(chance, text, is_yaml):
    piece, times = chance.choice((" ", "\n", "a", "- ", "'", '"', "\\", "# ", "[,", "!!a ", "&a ", ": ", "0")), 1 << 19
    where = chance.choice((0, len(text) // 2, len(text)))
    return f"{piece!r} many times at {where}", (text[:where] + piece * times + text[where:]).encode()


def _binary(chance, text, is_yaml):
    return "bytes", random.Random(chance.random()).randbytes(chance.choice((0, 1, 100, 100_000)))


def _cut(chance, text, is_yaml):
    where = chance.randrange(len(text))
    return f"at {where}", text[:where].encode()


def _mutated(chance, text, is_yaml):
    data = bytearray(text.encode())
    for _ in range(chance.choice((1, 2, 5, 20))):
        where = chance.randrange(len(data))
        how = chance.randrange(3)
        if how == 0:
            data[where] = chance.randrange(256)
        elif how == 1:
            del data[where]
        else:
            data.insert(where, ord(chance.choice("[]{}:,-'\"!&*#|>%@`\\\n\t \0.e9")))
    return "bytes", bytes(data)


def _other(chance, text, is_yaml):
    encoding = chance.choice(("utf-16", "utf-32", "utf-8-sig", "utf-7"))
    return encoding, text.encode(encoding)


WAYS = (*[_number] * 4, *[_kind] * 3, _deep, _long, _binary, _cut, *[_mutated] * 4, _other)
