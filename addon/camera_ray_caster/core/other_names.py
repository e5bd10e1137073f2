"""Names from other libraries, and the names that they have here: they complete the messages on unknown names."""

from __future__ import annotations

FUNCTIONS = {
    "load_mesh": "mesh(vertices, faces), or mesh(object of trimesh)",
    "from_trimesh": "mesh(object of trimesh)",
    "load_camera": "load_calibration(path)",
    "load_cameras": "load_rig(path)",
    "from_opencv": 'camera("OPENCV_PINHOLE", size, fx=..., k1=...)',
    "project": "camera(...).project(points)",
    "unproject": "camera(...).rays_at(x, y)",
    "undistort": 'export(camera, path, format="stmap")',
    "render": "cast(camera, shapes)",
    "raycast": "cast(camera, shapes), or cast_rays(origins, directions, shapes)",
    "trace": "cast(camera, shapes), or cast_rays(origins, directions, shapes)",
    "sphere": "spheres(centers, radii)",
    "plane": "planes(centers, axes)",
    "box": "mesh(vertices, faces)",
    "cube": "mesh(vertices, faces)",
    "flip": "top_down(images)",
    "save": "export(cameras, path), or save_points(cloud, path)",
    "lidar": 'scan(camera("SCANNER", size), shapes)',
}
"""What to use in place of a function that this package does not have."""

ATTRIBUTES = {
    "unproject": "rays_at(x, y)",
    "pixel_to_ray": "rays_at(x, y)",
    "get_rays": "rays()",
    "world_to_pixel": "project(points)",
    "undistort": 'crc.export(camera, path, format="stmap")',
    "distort": "project(points)",
    "render": "crc.cast(camera, shapes)",
    "cast": "crc.cast(camera, shapes)",
    "fov": "settings, or rays() for the angles",
    "near": "clip_start",
    "far": "clip_end",
    "k": "K",
    "intrinsics": "K and settings",
    "intrinsic_matrix": "K",
    "camera_matrix": "K",
    "extrinsics": "opencv_from_world",
    "world_to_camera": "opencv_from_world",
    "camera_from_world": "opencv_from_world",
    "camera_to_world": "world_from_camera",
    "matrix_world": "world_from_camera",
    "position": "pose.eye",
    "center": "pose.eye",
    "rotation": "pose.basis",
    "dist": "settings",
    "distortion": "settings",
    "dist_coeffs": "settings",
    "size": "width and height",
    "resolution": "width and height",
    "fx": 'settings["fx"], or K',
    "fy": 'settings["fy"], or K',
    "cx": 'settings["cx"], or K',
    "cy": 'settings["cy"], or K',
    "save": "crc.export(camera, path)",
}
"""What to use in place of an attribute that a camera does not have."""

WORDS: dict[str, tuple[tuple[str, ...], ...]] = {
    "fov": (("fisheye_fov",), ("fx",), ("lens", "sensor_width")),
    "hfov": (("fov",), ("fisheye_fov",), ("fx",), ("lens", "sensor_width")),
    "vfov": (("fov",), ("fisheye_fov",), ("fy",), ("lens", "sensor_width")),
    "near": (("clip_start",),),
    "far": (("clip_end",),),
    "k": (("fx", "fy", "cx", "cy"), ("lens", "sensor_width")),
    "intrinsics": (("fx", "fy", "cx", "cy"), ("lens", "sensor_width")),
    "camera_matrix": (("fx", "fy", "cx", "cy"), ("lens", "sensor_width")),
    "dist": (("k1", "k2", "p1", "p2", "k3"), ("k1", "k2", "k3", "k4")),
    "distortion": (("k1", "k2", "p1", "p2", "k3"), ("k1", "k2", "k3", "k4")),
    "dist_coeffs": (("k1", "k2", "p1", "p2", "k3"), ("k1", "k2", "k3", "k4")),
    "focal_length": (("fx", "fy"), ("lens",)),
    "focal": (("fx", "fy"), ("lens",)),
    "f": (("fx", "fy"), ("lens",)),
    "f_stop": (("aperture_fstop",),),
    "fstop": (("aperture_fstop",),),
    "xi": (("unified_xi",),),
    "alpha": (("unified_alpha",),),
    "beta": (("unified_beta",),),
    "omega": (("fov_omega",),),
    **dict.fromkeys(("kb", "kb3", "kb4", "kb8", "kannala_brandt", "kannalabrandt", "kannala_brandt4", "fisheye",
                     "equidistant"), (("OPENCV_FISHEYE",),)),
    **dict.fromkeys(("pinhole", "simple_pinhole", "radtan", "brown", "brown_conrady", "opencv", "full_opencv",
                     "plumb_bob", "rational_polynomial"), (("OPENCV_PINHOLE",),)),
    **dict.fromkeys(("mei", "omni", "unified", "cata"), (("UCM",),)),
    **dict.fromkeys(("erp", "panorama", "pano", "spherical", "equirect", "360"), (("EQUIRECTANGULAR",),)),
    **dict.fromkeys(("lidar", "laser"), (("SCANNER",),)),
    **dict.fromkeys(("scaramuzza", "omnidirectional"), (("OCAM",),)),
    **dict.fromkeys(("rgb", "color", "image", "beauty"), (("combined",),)),
    **dict.fromkeys(("z", "range"), (("depth",),)),
    **dict.fromkeys(("normals",), (("normal",),)),
    **dict.fromkeys(("points", "xyz"), (("position",),)),
    **dict.fromkeys(("mask", "segmentation", "instance"), (("shape_index",),)),
    **dict.fromkeys(("flow", "optical_flow"), (("flow_forward",),)),
}  # fmt: skip
"""Words for models, passes and settings in lower case; the first of the choices that is known is meant."""


def meant(word: str, known) -> str:
    """Return what is meant by a word of another library, one or several words of ``known``; "" if it is not listed."""
    choices = WORDS.get(word.lower(), ())
    return next((", ".join(choice) for choice in choices if all(name in known for name in choice)), "")
