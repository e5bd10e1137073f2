"""Blender's seven panorama types: our rays are those of Cycles, and so are the pixels that have none."""

from math import pi, radians

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.conventions import EPS32
from camera_ray_caster.core.records import InputError

from .cycles import cycles_directions

TYPES = (
    "EQUIRECTANGULAR", "EQUIANGULAR_CUBEMAP_FACE", "MIRRORBALL", "FISHEYE_EQUIDISTANT", "FISHEYE_EQUISOLID",
    "FISHEYE_LENS_POLYNOMIAL", "CENTRAL_CYLINDRICAL",
)  # fmt: skip
FRAMES = {
    "plain": {},
    "odd, shifted": {"resolution_x": 25, "resolution_y": 17, "shift_x": 0.13, "shift_y": -0.21},
    "wide pixels, border": {
        "pixel_aspect_x": 1.5, "use_border": True,
        "border_min_x": 0.3, "border_max_x": 0.9, "border_min_y": 0.1, "border_max_y": 0.7,
    },
    "portrait, vertical fit, percentage": {
        "resolution_x": 18, "resolution_y": 30, "sensor_fit": "VERTICAL", "sensor_height": 30.0,
        "resolution_percentage": 70, "pixel_aspect_y": 1.3,
    },
    "portrait, automatic fit": {"resolution_x": 15, "resolution_y": 27, "shift_x": 0.4},
    "horizontal fit, far shift": {"resolution_x": 12, "resolution_y": 16, "sensor_fit": "HORIZONTAL", "shift_y": 0.9},
}  # fmt: skip


def polynomial(*k, **more):
    coefficients = {f"fisheye_polynomial_k{i}": value for i, value in enumerate(k)}
    return {"panorama_type": "FISHEYE_LENS_POLYNOMIAL"} | more | coefficients


def fisheye(kind, degrees, **more):
    return {"panorama_type": f"FISHEYE_{kind}", "fisheye_fov": radians(degrees)} | more


ODD = {
    "equidistant 360": fisheye("EQUIDISTANT", 360),
    "equidistant 540": fisheye("EQUIDISTANT", 540),
    "equidistant 1800": fisheye("EQUIDISTANT", 1800),
    "equisolid 360": fisheye("EQUISOLID", 360, fisheye_lens=4.0),
    "equisolid 540": fisheye("EQUISOLID", 540, fisheye_lens=4.0),
    "equisolid 1000, nothing": fisheye("EQUISOLID", 1000, fisheye_lens=4.0),
    "polynomial 540": polynomial(0.0, -0.3, 0.0, 0.0, 0.0, fisheye_fov=3 * pi),
    "polynomial, k1 = 0": polynomial(0.0, 0.0, -3e-3, -1e-5, 0.0),
    "polynomial, upside down": polynomial(0.0, 0.06, 0.0, 0.0, 0.0),
    "polynomial, across the axis": polynomial(0.3, -0.06, 0.0, 0.0, 0.0),
    "polynomial, without the axis": polynomial(-0.3, -0.06, 0.0, 0.0, 0.0),
    "equirectangular, a part, mirrored": {
        "panorama_type": "EQUIRECTANGULAR", "latitude_min": -0.3, "latitude_max": 1.2,
        "longitude_min": 1.0, "longitude_max": -2.0,
    },
    "equirectangular, more than a turn": {"panorama_type": "EQUIRECTANGULAR", "longitude_min": -8, "longitude_max": 8},
    "cylinder, a part": {
        "panorama_type": "CENTRAL_CYLINDRICAL", "central_cylindrical_range_u_min": -1.0,
        "central_cylindrical_range_u_max": 5.0, "central_cylindrical_range_v_min": -3.0,
        "central_cylindrical_range_v_max": 0.5, "central_cylindrical_radius": 0.3,
    },
}  # fmt: skip
CASES = {
    **{f"{kind}, {name}": {"panorama_type": kind} | frame for kind in TYPES for name, frame in FRAMES.items()},
    **ODD,
}


def set_up(bpy, settings):
    scene = bpy.context.scene
    data = bpy.data.cameras.new("Camera")
    camera = bpy.data.objects.new("Camera", data)
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.rotation_euler = (0.9, 0.2, 0.7)
    scene.render.resolution_x, scene.render.resolution_y = 24, 18
    data.type = "PANO"
    for name, value in settings.items():
        setattr(scene.render if hasattr(scene.render, name) else data, name, value)
    return scene


@pytest.mark.parametrize("case", CASES)
def test_rays_and_pixels_without_one_are_those_of_cycles(blender, case):
    settings = CASES[case]
    scene = set_up(blender, settings)
    camera = read_camera(scene)
    rays, seen = camera.rays(), cycles_directions(scene)
    assert camera.model.key == settings["panorama_type"]
    np.testing.assert_array_equal(rays.valid, ~np.isnan(seen[..., 0]))
    error = np.linalg.norm(seen - rays.directions, axis=-1)
    wrong = rays.valid & (error > allowed(camera, settings)) & ~at_a_lens_s_tip(camera, settings)
    assert not wrong.any(), f"{error[wrong].max()} rad"


def allowed(camera, settings):
    """1e-5 rad, and beyond where the picture is so steep that Cycles' float32 has no more.

    There a relative place in the frame, right to 8 EPS32 of the place and the shift, is the error's larger part: the
    rim of the mirror ball, a fisheye of five turns, tangents near their pole. Differences of our rays tell how steep.
    """
    x, y, h = camera.raster.columns(), camera.raster.rows(), 1e-5
    here = camera.rays_at(x, y).directions
    steep = 0.0
    for side, dx, dy in ((camera.raster.width, h, 0), (camera.raster.height, 0, h)):
        change = np.linalg.norm(camera.rays_at(x + dx, y + dy).directions - here, axis=-1) / h
        steep = steep + side * np.nan_to_num(change, nan=np.inf)
    farthest = 1 + abs(settings.get("shift_x", 0)) + abs(settings.get("shift_y", 0))
    return np.maximum(1e-5, 8 * EPS32 * farthest * steep)


def at_a_lens_s_tip(camera, settings):
    """Where the azimuth is nobody's: r = 0 of a polynomial with k0 other than 0."""
    kind = settings["panorama_type"] == "FISHEYE_LENS_POLYNOMIAL" and settings.get("fisheye_polynomial_k0", 1) != 0
    a, b = camera.model.window.plane_from_pixels(camera.raster.columns(), camera.raster.rows())
    return kind & (np.hypot(a, b) < 1e-5)


def test_a_shader_for_a_camera_is_refused(blender):
    scene = set_up(blender, {})
    scene.camera.data.type = "CUSTOM"
    with pytest.raises(InputError, match="OSL"):
        read_camera(scene)
