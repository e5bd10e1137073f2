"""Files saved with version 0.1: each opens with the model and the settings that scripts/make/scenes gave it."""

from math import pi, radians

import numpy as np
import pytest

from .opening import FOLDER, opened

TIMES = {"time_tolerance": 0.1, "time_evaluations": 256}
CALIBRATED = {"calibration_file": "", "calibration_width": 448, "calibration_height": 280, "cx": 223.5, "cy": 139.5}
SMALL = {"calibration_width": 312, "calibration_height": 208, "cx": 155.5, "cy": 103.5}
K = "fisheye_polynomial_k"
BEHIND = (0, -5.2, 2.5)
STORED = {
    "spheres_and_planes": ("PERSP", {"lens": 42}),
    "portrait": ("PERSP", {"lens": 40, "sensor_height": 20, "shift_x": 0.11, "shift_y": -0.17}),
    "vertical_fit": ("PERSP", {"lens": 28, "sensor_fit": "VERTICAL", "sensor_width": 50, "sensor_height": 18}),
    "orthographic": ("ORTHO", {"ortho_scale": 6.5, "shift_x": 0.05, "shift_y": 0.08}),
    "isometric": ("ORTHO", {"ortho_scale": 9}),
    "toys": ("PERSP", {"lens": 43}),
    "toys_cross_slit": (
        "CROSS_SLIT", {"slit_1": ((0, 8.8, 0), (0, 8.8, 1)), "slit_2": ((0, -18, 8), (1, -18, 8)), "lens": 18 / 5.8},
    ),
    "real_lens": ("REAL_LENS", {"lens": 500, "sensor_width": 360, "aperture_fstop": 2, "focus_distance": 10}),
    "fish_tank": (
        "PERSP",
        {"lens": 14, "port": "FLAT", "port_distance": 600, "port_thickness": 100, "port_tilt_y": radians(20)},
    ),
    "living_room": ("PERSP", {"lens": 18.5}),
    "living_room_equirectangular": ("EQUIRECTANGULAR", {"longitude_min": -pi, "latitude_max": pi / 2}),
    "living_room_omnimax": ("OMNIMAX", {"tilt": radians(15)}),
    "rotunda_fisheye": ("FISHEYE_EQUIDISTANT", {"fisheye_fov": radians(190)}),
    "rotunda_panorama": (
        "CYLINDRICAL",
        {"pan_min": -pi, "pan_max": pi, "latitude_bottom": radians(-35), "latitude_top": radians(50)},
    ),
    "street": ("PERSP", {"lens": 21, "shift_y": 0.05}),
    "street_scanner": (
        "SCANNER", {"time_mode": "SWEEP", "scanner_device": "OS1_64", "scanner_rate": 10, "fps": 10, **TIMES},
    ),
    "street_pushbroom": (
        "PUSHBROOM", {"slit_1": ((0, -6.5, 3.2), (1, -6.5, 3.2)), "lens": 12.6, "ortho_scale": 30, "shift_y": 0.015},
    ),
    "sculpture_garden": ("PERSP", {"lens": 26}),
    "propeller": (
        "PERSP",
        {"time_mode": "ROLLING_SHUTTER", "motion_blur_shutter": 1, "rolling_shutter_duration": 0, **TIMES},
    ),
    "twisted_monkey": ("PERSP", {"time_mode": "ROWS", "time_start": 1, "time_end": 25, **TIMES}),
    "unrolled_monkey": ("STRIP", {"follow_path": True, "lens": 11, "shift_y": 0.045}),
    "pinhole": ("PERSP", {"lens": 22}),
    "thin_lens": ("PERSP", {"lens": 22}),
    "camera_obscura": ("CAMERA_OBSCURA", {"obscura_depth": 2, "obscura_width": 3.27, "obscura_hole": 0.03}),
    "fisheye_orthographic": ("FISHEYE_ORTHOGRAPHIC", {"fov": pi}),
    "fisheye_stereographic": ("FISHEYE_STEREOGRAPHIC", {"fov": radians(220)}),
    "opencv_pinhole": (
        "OPENCV_PINHOLE",
        {**CALIBRATED, "fx": 210, "fy": 210, "k1": -0.24, "k2": 0.045, "p1": 0.004, "p2": -0.006, "k3": 0, "s4": 0},
    ),
    "opencv_fisheye": (
        "OPENCV_FISHEYE", {**CALIBRATED, "fx": 110, "fy": 110, "k1": 0.03, "k2": -0.022, "k3": 0.0008, "k4": 0},
    ),
    "ucm": ("UCM", {**SMALL, "fx": 115, "unified_xi": 1.3, "k1": -0.05, "k2": 0.02, "p1": 0.003, "p2": -0.002}),
    "eucm": ("EUCM", {**SMALL, "fx": 75, "skew": 0, "unified_alpha": 0.62, "unified_beta": 1.08}),
    "double_sphere": ("DOUBLE_SPHERE", {**SMALL, "fx": 52, "unified_xi": -0.22, "unified_alpha": 0.57}),
    "fisheye624": ("FISHEYE624", {**SMALL, "fx": 95, "k1": 0.4, "k6": 0.6, "p1": 0.004, "s1": -0.006, "s4": 0.0001}),
    "thin_prism_fisheye": (
        "THIN_PRISM_FISHEYE", {**SMALL, "fx": 65, "k1": -0.02, "p1": 0.004, "p2": 0.006, "s1": 0.03, "s3": -0.02},
    ),
    "fov": ("FOV", {**SMALL, "fx": 138, "fov_omega": 1.1}),
    "radial_polynomial": ("RADIAL_POLYNOMIAL", {**SMALL, "fx": 150, "radial_polynomial": "0 1 0.1 -0.7 0.35"}),
    "division": ("DIVISION", {**SMALL, "fx": 75, "division_lambda": -0.28}),
    "ftheta": (
        "FTHETA",
        {**SMALL, "ftheta_reference": "RADIUS_TO_ANGLE", "ftheta_radius_to_angle": "0 0.0125 3e-6 -9e-8"},
    ),
    "ocam": ("OCAM", {**SMALL, "ocam_polynomial": "-68 0 0.0045 1e-6 2.5e-8", "ocam_c": 0.999, "ocam_d": 0.002}),
    "ray_table": ("RAY_TABLE", {
        "ray_axes": "BLENDER", "ray_interpolation": "CUBIC", "ray_block_columns": 0, "ray_block_rows": 0,
        "ray_slide": False,
    }),
    "omnimax": ("OMNIMAX", {"tilt": radians(20)}),
    "dome_master": ("DOME_MASTER", {"fov": pi, "tilt": radians(15)}),
    "equirectangular": ("EQUIRECTANGULAR", {"longitude_min": -pi, "latitude_max": pi / 2}),
    "cubemap_face": ("EQUIANGULAR_CUBEMAP_FACE", {"shift_x": 0}),
    "mirrorball": ("MIRRORBALL", {"shift_y": 0}),
    "fisheye_equidistant": ("FISHEYE_EQUIDISTANT", {"fisheye_fov": radians(250)}),
    "fisheye_equisolid": ("FISHEYE_EQUISOLID", {"fisheye_lens": 9.5, "fisheye_fov": pi, "sensor_width": 36}),
    "fisheye_polynomial": (
        "FISHEYE_LENS_POLYNOMIAL",
        {K + "0": 0, K + "1": -0.115, K + "2": 0, K + "3": 7e-5, K + "4": -4e-6, "fisheye_fov": radians(200)},
    ),
    "central_cylindrical": (
        "CENTRAL_CYLINDRICAL", {"central_cylindrical_range_v_min": -0.9, "central_cylindrical_range_v_max": 0.9},
    ),
    "cylindrical": (
        "CYLINDRICAL",
        {"pan_min": radians(-110), "pan_max": radians(110), "latitude_bottom": radians(-30), "latitude_top": pi / 4},
    ),
    "little_planet": ("STEREOGRAPHIC_PANORAMA", {"fov": radians(250), "elevation": -pi / 2}),
    "omnidirectional_stereo": ("OMNIDIRECTIONAL_STEREO", {"eye": "TOP_BOTTOM", "interocular_distance": 0.3}),
    "general_linear": (
        "GENERAL_LINEAR",
        {"ray_1": (-0.6, -0.9, -1.3, -1.2), "ray_2": (1.4, -0.3, 1.9, -0.9), "ray_3": (-1.4, 0.9, -1.8, 1.0)},
    ),
    "pushbroom": ("PUSHBROOM", {"slit_1": (BEHIND, (1, -5.2, 2.5)), "lens": 24, "ortho_scale": 11.6}),
    "cross_slit": (
        "CROSS_SLIT",
        {"slit_1": ((0, -16, 0), (0, -16, 1)), "slit_2": ((0, -8.4, 2.5), (1, -8.4, 2.5)), "lens": 5.6},
    ),
    "pencil": ("PENCIL", {"slit_1": (BEHIND, (1, -5.2, 2.5)), "pencil_slide": -4, "lens": 22}),
    "twisted_orthographic": (
        "TWISTED_ORTHOGRAPHIC", {"slit_1": ((0, 0, 2.5), (0, 0, 3.5)), "twist": 0.08, "ortho_scale": 7.5},
    ),
    "strip": ("STRIP", {"follow_path": True, "lens": 14}),
    "slit_scan_rows": ("PERSP", {"time_mode": "ROWS", "time_start": 1, "time_end": 37, **TIMES}),
    "slit_scan_columns": ("PERSP", {"time_mode": "COLUMNS", "time_start": 1, "time_end": 25, **TIMES}),
    "time_displacement": ("PERSP", {"time_mode": "IMAGE", "time_start": 1, "time_end": 7, **TIMES}),
    "rolling_shutter": (
        "PERSP",
        {"time_mode": "ROLLING_SHUTTER", "motion_blur_shutter": 1, "rolling_shutter_duration": 0, **TIMES},
    ),
}  # fmt: skip
"""Model and settings by file; of any other the model is PERSP."""
PRIMITIVES = {"Floor": "INFINITE_PLANE", "Cube": "SPHERE", "Monkey": "PLANE", "Nothing": "IGNORE"}


@pytest.fixture(params=["registered", "not registered"], autouse=True)
def is_registered(request, unregister):
    """With the add-on registered, and without, as in a script that only imports the package."""
    if request.param == "not registered":
        unregister()
    return request.param == "registered"


@pytest.mark.parametrize("name", sorted(path.stem for path in FOLDER.glob("*.blend")))
def test_a_file_opens_with_its_settings(blender, name):
    model, expected = STORED.get(name, ("PERSP", {}))
    opened = record(blender, name)
    settings = {**opened.camera.record.settings, **opened.camera.settings}
    key = opened.camera.model.key
    assert key == model, f"{name}.blend has {key}: STORED of test_stored_settings.py says {model}"
    assert (settings["time_mode"] != "NONE") == ("time_mode" in expected)
    for setting, value in expected.items():
        if isinstance(value, str | bool):
            assert settings[setting] == value
        else:
            np.testing.assert_allclose(settings[setting], value, rtol=1e-6, atol=1e-6, err_msg=setting)


def record(bpy, name):
    """What is read of a file at its frame; its motion would take long."""
    from camera_ray_caster.blender.read.evaluated import scene_at

    scene = opened(bpy, name)
    return scene_at(scene.camera, bpy.context.evaluated_depsgraph_get())


def test_objects_are_cast_as_they_were_told(blender, is_registered):
    opened = record(blender, "cast_as")
    shapes = opened.shapes
    kinds = {shapes.names[k]: int(kind) for k, kind in zip(shapes.name_index, shapes.kind, strict=True)}
    assert kinds == {"Floor": 2, "Cube": 0, "Monkey": 1}
    assert dict(shapes.left_out) == {"Nothing": "its Cast As setting is Ignore"}
    if is_registered:
        objects = blender.context.scene.objects
        assert {name: objects[name].camera_ray_caster.primitive for name in PRIMITIVES} == PRIMITIVES


def test_the_settings_of_the_scene_are_as_they_were_saved(blender, is_registered):
    if is_registered:
        settings = opened(blender, "thin_lens").camera_ray_caster
        assert (settings.shading, settings.samples) == ("GRID", 64)
        settings = opened(blender, "spheres_and_planes").camera_ray_caster
        assert (settings.shading, settings.samples) == ("MATERIAL", 1)
