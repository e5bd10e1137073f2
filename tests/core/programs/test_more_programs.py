"""Calibrations of further programs, against each format's own formula, written down here once more."""

import json
from contextlib import suppress
from itertools import pairwise

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.records import InputError

SIZE = 640, 480
POINTS = np.random.default_rng(3).uniform((-0.6, -0.5, 0.8), (0.6, 0.5, 1.6), (40, 3))
"""x right, y down, z ahead."""
K1 = -0.1, 0.02, 1e-3, -2e-3


def radtan(x, y, k, p):
    """Brown's distortion with p1 and p2 as in OpenCV."""
    s = x * x + y * y
    gain = 1 + sum(term * s ** (i + 1) for i, term in enumerate(k))
    return (x * gain + 2 * p[0] * x * y + p[1] * (s + 2 * x * x), y * gain + p[0] * (s + 2 * y * y) + 2 * p[1] * x * y)


def plane(points):
    return points[:, 0] / points[:, 2], points[:, 1] / points[:, 2]


def angles(points):
    """x and y whose length is the angle from the axis."""
    across = np.hypot(points[:, 0], points[:, 1])
    scale = np.arctan2(across, points[:, 2]) / across
    return points[:, 0] * scale, points[:, 1] * scale


def equidistant(points, k):
    x, y = angles(points)
    s = x * x + y * y
    gain = 1 + sum(term * s ** (i + 1) for i, term in enumerate(k))
    return x * gain, y * gain


def xml(root, entries, **attributes):
    named = "".join(f' {name}="{value}"' for name, value in attributes.items())
    return f"<{root}{named}>" + "".join(f"<{name}>{value}</{name}>" for name, value in entries.items()) + f"</{root}>"


F, CX, CY = 300.0, 6.5, -3.25
METASHAPE = {
    "f": F, "cx": CX, "cy": CY, "b1": 2.0, "b2": -1.5, "k1": -0.1, "k2": 0.02, "k3": 1e-3, "p1": 1e-3, "p2": -2e-3,
}  # fmt: skip


def metashape(points, of=plane, **more):
    entries = METASHAPE | more
    k, p = [entries.get(f"k{i}", 0.0) for i in (1, 2, 3, 4)], (entries["p2"], entries["p1"])
    x, y = radtan(*of(points), k, p)
    return 320 + CX + x * F + x * 2.0 + y * -1.5 - 0.5, 240 + CY + y * F - 0.5


PROJECT = "<document><chunk><sensors>" + "".join(
    f'<sensor id="{i}" label="{name}" type="frame"><resolution width="640" height="480"/>'
    + xml("calibration", {"resolution": "", "f": 1.0}, type="frame", **{"class": "initial"}).replace(
        "<resolution></resolution>", '<resolution width="640" height="480"/>')
    + xml("calibration", {"resolution": "", **METASHAPE}, type="frame", **{"class": "adjusted"}).replace(
        "<resolution></resolution>", '<resolution width="640" height="480"/>')
    + "</sensor>" for i, name in enumerate(("left", "right"))
) + "</sensors></chunk></document>"  # fmt: skip


def standalone(kind, **more):
    return xml("calibration", {"projection": kind, "width": 640, "height": 480, **METASHAPE, **more})


def sfm(version=("1", "2", "1"), **more):
    intrinsics = {"intrinsicId": "7", "width": "640", "height": "480", "sensorWidth": "36", "sensorHeight": "27",
           "type": "radial3", "pxFocalLength": ["300", "301"], "principalPoint": ["6.5", "-3.25"],
           "distortionParams": ["-0.1", "0.02", "0.001"]}  # fmt: skip
    return json.dumps({"version": version, "views": [], "intrinsics": [intrinsics | more]})


def by_k(x, y, fx=F, fy=301.0, cx=326.5, cy=236.75):
    return fx * x + cx, fy * y + cy


def gyroflow(model=None, k=K1, **more):
    K = [[F, 0.0, 326.5], [0.0, 301.0, 236.75], [0.0, 0.0, 1.0]]
    profile = {"camera_brand": "GoPro", "camera_model": "HERO", "calib_dimension": {"w": 640, "h": 480},
             "fisheye_params": {"camera_matrix": K, "distortion_coeffs": k}, "use_opencv_fisheye": True}  # fmt: skip
    return json.dumps(profile | ({"distortion_model": model} if model else {}) | more)


def ncamera(kind, bend, parameters, intrinsics=(F, 301.0, 326.5, 236.75)):
    return f"""label: rig
cameras:
- camera:
    label: front
    image_height: 480
    image_width: 640
    type: {kind}
    intrinsics:
      cols: 1
      rows: {len(intrinsics)}
      data: {list(intrinsics)}
    distortion:
      type: {bend}
      parameters:
        cols: 1
        rows: {len(parameters)}
        data: {list(parameters)}
  T_B_C:
    cols: 4
    rows: 4
    data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
"""


def unified(points, xi):
    length = np.linalg.norm(points, axis=1)
    return points[:, 0] / (points[:, 2] + xi * length), points[:, 1] / (points[:, 2] + xi * length)


def field_of_view(points, omega):
    x, y = plane(points)
    r = np.hypot(x, y)
    scale = np.arctan(2 * r * np.tan(omega / 2)) / omega / r
    return x * scale, y * scale


SIX, TWO, FOUR = (0.1, -0.02, 3e-3, 1e-3, -2e-4, 1e-5), (1e-3, -2e-3), (2e-3, -1e-3, 1e-3, 5e-4)


def hot3d(**more):
    numbers = [F, 326.5, 236.75, *SIX, *TWO, *FOUR]
    calibration = {"label": "camera-rgb", "image_width": 640, "image_height": 480,
           "projection_model_type": "CameraModelType.FISHEYE624", "projection_params": numbers}  # fmt: skip
    return json.dumps({"214-1": {"calibration": calibration | more, "T_world_from_camera": {}}})


def aria(points):
    """Project Aria's formula, with the tangential terms in its own order."""
    x, y = equidistant(points, SIX)
    s, (p0, p1) = x * x + y * y, TWO
    beside = x * p0 + y * p1
    return by_k(
        x + (2 * beside * x + p0 * s) + FOUR[0] * s + FOUR[1] * s * s,
        y + (2 * beside * y + p1 * s) + FOUR[2] * s + FOUR[3] * s * s, fy=F,
    )  # fmt: skip


POLYNOMIAL = -231.5, 0.0, 1.7e-3, -2e-6, 4e-9
AFFINE = {"ac": 1.02, "ad": 3e-3, "ae": -4e-3, "cx": 321.25, "cy": 238.5}
OCAM = "%YAML:1.0\n---\nmodel_type: SCARAMUZZA\ncamera_name: cam\nimage_width: 640\nimage_height: 480\n" + "".join(
    f"{entry}:\n" + "".join(f"   {name}: {value}\n" for name, value in numbers.items())
    for entry, numbers in {"poly_parameters": {f"p{i}": term for i, term in enumerate(POLYNOMIAL)},
                      "inv_poly_parameters": {f"p{i}": 1.0 for i in range(20)}, "affine_parameters": AFFINE}.items()
)  # fmt: skip


def scaramuzza(points):
    """The root of the polynomial's equation by bisection, then the affine map with x to the right."""
    x, y, z = points.T
    across, low, high = np.hypot(x, y), np.zeros(len(points)), np.full(len(points), 400.0)
    for _ in range(200):
        rho = (low + high) / 2
        ahead = -sum(term * rho**i for i, term in enumerate(POLYNOMIAL))
        less = rho * z < across * ahead
        low, high = np.where(less, rho, low), np.where(less, high, rho)
    u, v = x / across * rho, y / across * rho
    return AFFINE["ac"] * u + AFFINE["ad"] * v + AFFINE["cx"], AFFINE["ae"] * u + v + AFFINE["cy"]


def old_mrcal(kind, terms, key="'distortion_model'"):
    return f"{{ {key}: {kind}, 'intrinsics': [300., 301., 326.5, 236.75, {terms}], 'imagersize': [640, 480], }}"


FILES = {
    "Metashape": (standalone("frame"), metashape),
    "Metashape, fisheye": (standalone("fisheye", k4=-2e-4), lambda p: metashape(p, angles, k4=-2e-4)),
    "Metashape, project": (PROJECT, metashape),
    "Meshroom": (sfm(), lambda p: by_k(*radtan(*plane(p), K1[:3], (0, 0)))),
    "Meshroom, before": (sfm(("1", "0", "0"), principalPoint=["326.5", "236.75"]),
                         lambda p: by_k(*radtan(*plane(p), K1[:3], (0, 0)))),
    "Meshroom, millimeters": (
        json.dumps({**json.loads(sfm(("1", "2", "6"), focalLength="16.875", type="pinhole", distortionType="brown",
                                     distortionParams=["-0.1", "0.02", "0.001", "0.002", "-0.001"])),
                    }).replace('"pxFocalLength": ["300", "301"], ', ""),
        lambda p: by_k(*radtan(*plane(p), K1[:3], (2e-3, -1e-3)), fy=F)),
    "Meshroom, fisheye4": (sfm(type="fisheye4", distortionParams=list(map(str, K1))),
                           lambda p: by_k(*equidistant(p, K1))),
    "Meshroom, fisheye1": (sfm(type="fisheye1", distortionParams=["0.9"]), lambda p: by_k(*field_of_view(p, 0.9))),
    "Gyroflow": (gyroflow(), lambda p: by_k(*equidistant(p, K1))),
    "Gyroflow, standard": (gyroflow("opencv_standard"), lambda p: by_k(*radtan(*plane(p), K1[:2], K1[2:]))),
    "maplab": (ncamera("pinhole", "radial-tangential", K1), lambda p: by_k(*radtan(*plane(p), K1[:2], K1[2:]))),
    "maplab, equidistant": (ncamera("pinhole", "equidistant", K1), lambda p: by_k(*equidistant(p, K1))),
    "maplab, fisheye": (ncamera("pinhole", "fisheye", (0.9,)), lambda p: by_k(*field_of_view(p, 0.9))),
    "maplab, unified": (
        ncamera("unified-projection", "radial-tangential", K1, (0.7, F, 301.0, 326.5, 236.75)),
        lambda p: by_k(*radtan(*unified(p, 0.7), K1[:2], K1[2:]))),
    "HOT3D": (hot3d(), aria),
    "HOT3D, pinhole": (
        hot3d(projection_model_type="CameraModelType.PINHOLE", projection_params=[F, 301.0, 326.5, 236.75]),
        lambda p: by_k(*plane(p))),
    "camodocal, SCARAMUZZA": (OCAM, scaramuzza),
    "mrcal, old": (old_mrcal("b'DISTORTION_OPENCV4'", "-0.1, 0.02, 1e-3, -2e-3"),
                   lambda p: by_k(*radtan(*plane(p), K1[:2], K1[2:]))),
    "mrcal, lens_model": (old_mrcal("'LENSMODEL_OPENCV4'", "-0.1, 0.02, 1e-3, -2e-3", "'lens_model'"),
                          lambda p: by_k(*radtan(*plane(p), K1[:2], K1[2:]))),
    "mrcal, none": (old_mrcal("'DISTORTION_NONE'", ""), lambda p: by_k(*plane(p))),
    "Polycam": (json.dumps({"fx": F, "fy": 301.0, "cx": 326.5, "cy": 236.75, "width": 640, "height": 480,
                            "blur_score": 90.0, "t_00": 1.0, "t_01": 0.0}), lambda p: by_k(*plane(p))),
    "Record3D": (json.dumps({"K": [F, 0, 0, 0, 301.0, 0, 326.5, 236.75, 1], "w": 640, "h": 480, "fps": 60}),
                 lambda p: by_k(*plane(p))),
}  # fmt: skip
"""Content, and the formula from points to pixels whose first has its center at (0, 0)."""


@pytest.mark.parametrize("name", FILES)
def test_points_are_where_the_formula_has_them(name, tmp_path):
    text, formula = FILES[name]
    file = tmp_path / "lens"
    file.write_text(text)
    camera = crc.load_calibration(file, camera="left" if name == "Metashape, project" else None, pose=np.eye(4))
    assert camera.raster.size == SIZE
    u, v = formula(POINTS)
    pixels = camera.project(POINTS * (1, -1, -1))
    np.testing.assert_allclose(pixels, np.stack((u + 0.5, 480 - (v + 0.5)), axis=-1), rtol=0, atol=1e-9)


REFUSED = {
    "Metashape, k4": (standalone("frame", k4=1e-3), "its k4 of a frame camera is not 0"),
    "Metashape, kind": (standalone("cylindrical"), "projection is 'cylindrical': it must be one of frame"),
    "Metashape, cut": (standalone("frame")[:80], "of no format that is read"),
    "Metashape, f": (standalone("frame", f="wide"), "f is 'wide': it must be 1 finite number"),
    "Meshroom, kind": (sfm(type="3deanamorphic4"), "type of 7 is '3deanamorphic4': it must be one of pinhole"),
    "Meshroom, pixels": (sfm(pixelRatio="0"), "pixelRatio of 7 is 0: it must be above 0"),
    "Meshroom, terms": (sfm(distortionParams=["1"]), "distortionParams of 7 has 1 numbers: radial3 has 3"),
    "Gyroflow, kind": (gyroflow("sony"), "distortion_model is 'sony': it must be one of opencv_fisheye"),
    "Gyroflow, stretch": (gyroflow(input_horizontal_stretch=1.33), "stretched pictures are not read"),
    "Gyroflow, terms": (gyroflow(k=[0.1] * 5), "distortion_coeffs has 5 numbers: opencv_fisheye has 4"),
    "maplab, kind": (ncamera("linescan", "radtan", K1), "type of front is 'linescan': it must be one of"),
    "maplab, bend": (ncamera("pinhole", "spline", K1), "distortion of front is 'spline': it must be one of"),
    "maplab, terms": (ncamera("pinhole", "equidistant", K1[:2]), "parameters of front is .*4 finite numbers"),
    "HOT3D, kind": (hot3d(projection_model_type="CameraModelType.SPLINE"), "projection_model_type is 'SPLINE'"),
    "HOT3D, terms": (hot3d(projection_params=[1.0, 2.0]), "projection_params is .*16 finite numbers"),
    "camodocal, gap": (OCAM.replace("p3:", "p7:", 1), "without a gap"),
    "camodocal, ac": (OCAM.replace("ac: 1.02", "ac: -1.02"), "ac is -1.02: it must be above 0"),
    "mrcal, old": (old_mrcal("'DISTORTION_SPLINED'", ""), "lensmodel is 'LENSMODEL_SPLINED': it must be one of"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_wrong_is_said_in_one_line(name, tmp_path):
    text, words = REFUSED[name]
    (tmp_path / "lens").write_text(text)
    with pytest.raises(InputError, match=words) as caught:
        crc.load_calibration(tmp_path / "lens")
    assert "\n" not in str(caught.value)


@pytest.mark.full
@pytest.mark.filterwarnings("ignore:the poses .*:UserWarning")
@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_cut_anywhere_ends_in_one_line(name, tmp_path):
    text = FILES[name][0]
    places = np.linspace(0, len(text), 40).astype(int).tolist()
    for (first, last), gone in zip(pairwise(places), places, strict=False):
        for cut in (text[:last], text[:first] + text[last:], text[:gone] + "1e400" + text[gone:]):
            (tmp_path / "lens").write_text(cut)
            with suppress(InputError):  # one line, whatever it says
                crc.load_calibration(tmp_path / "lens", size=SIZE)
