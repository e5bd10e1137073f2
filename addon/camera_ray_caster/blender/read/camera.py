"""A camera and its render settings as Blender has them: tables of names, copied, nothing computed."""

from types import MappingProxyType

import bpy
import numpy as np

from ...core.camera.stereo import camera_name
from ...core.records import BlenderCamera, InputError
from ..properties.central import COPIED as CENTRAL
from ..properties.multiperspective import COPIED, RAYS
from .lines import lines_record

CAMERA = (
    "type", "lens", "sensor_fit", "sensor_width", "sensor_height", "shift_x", "shift_y", "ortho_scale",
    "clip_start", "clip_end",
)  # fmt: skip
RENDER = (
    "resolution_x", "resolution_y", "resolution_percentage", "pixel_aspect_x", "pixel_aspect_y",
    "use_border", "border_min_x", "border_max_x", "border_min_y", "border_max_y",
)  # fmt: skip
PANORAMA = (
    "panorama_type", "fisheye_fov", "fisheye_lens", "latitude_min", "latitude_max", "longitude_min", "longitude_max",
    "fisheye_polynomial_k0", "fisheye_polynomial_k1", "fisheye_polynomial_k2", "fisheye_polynomial_k3",
    "fisheye_polynomial_k4", "central_cylindrical_range_u_min", "central_cylindrical_range_u_max",
    "central_cylindrical_range_v_min", "central_cylindrical_range_v_max", "central_cylindrical_radius",
)  # fmt: skip
DEPTH_OF_FIELD = (
    "use_dof", "focus_distance", "aperture_fstop", "aperture_blades", "aperture_rotation", "aperture_ratio",
)  # fmt: skip
STEREO = (
    "convergence_mode", "pivot", "interocular_distance", "convergence_distance", "use_spherical_stereo",
    "use_pole_merge", "pole_merge_angle_from", "pole_merge_angle_to",
)  # fmt: skip
OWN = (
    "obscura_depth", "obscura_width", "obscura_hole",
    "time_mode", "time_start", "time_end", "time_tolerance", "time_evaluations",
)  # fmt: skip
SHUTTER = ("motion_blur_shutter", "motion_blur_position")
MULTIVIEW = ("use_multiview", "views_format")


def camera_record(scene, camera_object, depsgraph) -> BlenderCamera:
    """Return the record of a camera object as the depsgraph evaluated it, with the scene's render settings.

    ``settings`` holds the values of PANORAMA, DEPTH_OF_FIELD, STEREO and MULTIVIEW by Blender's names, those of the
    camera's own properties, ``focus_position``, the focus object's place in the world (3,) or None, and what
    ``lines_record`` returns. Raises InputError where there is no camera or the object is none.
    """
    check_camera(scene, camera_object)
    evaluated = camera_object.evaluated_get(depsgraph)
    data = evaluated.data
    own = data.camera_ray_caster
    settings = {
        **copied(data, PANORAMA),
        **copied(data.dof, DEPTH_OF_FIELD),
        **copied(data.stereo, STEREO),
        **copied(scene.render, MULTIVIEW),
        **copied(scene.render, SHUTTER),
        **copied(own, OWN),
        **copied(own, CENTRAL),
        **copied(own, COPIED),
        "calibration_file": bpy.path.abspath(own.calibration_file, library=data.library),
        **{name: tuple(getattr(own, name)) for name in RAYS},
        **lines_record(own, depsgraph),
        "frame": scene.frame_current_final,
        "rolling_shutter_duration": scene.cycles.rolling_shutter_duration if hasattr(scene, "cycles") else 0.0,
        "time_image": _gray(own.time_image),
        "focus_position": _focus_position(data.dof, depsgraph),
    }
    return BlenderCamera(
        name=camera_object.name,
        model="" if own.model == "BLENDER" else own.model,
        matrix_world=np.array(evaluated.matrix_world, dtype=np.float64),
        settings=MappingProxyType(settings),
        **copied(data, CAMERA),
        **copied(scene.render, RENDER),
    )


def copied(source, names) -> dict[str, object]:
    """Return the named properties of a Blender struct."""
    return {name: getattr(source, name) for name in names}


def find_camera(scene, name):
    """Return the scene's camera object of that name. Raises InputError that says which cameras there are."""
    cameras = {item.name: item for item in scene.objects if item.type == "CAMERA"}
    if name not in cameras:
        known = ", ".join(repr(known) for known in sorted(cameras)) or "none at all"
        raise InputError(f"scene {scene.name!r} has no camera {name!r}; its cameras are: {known}")
    return cameras[name]


def eye_object(scene, view: str):
    """Return the object that stands for the active camera in a view: another one only in the Multi-View format."""
    camera, views = scene.camera, scene.render.views
    if not view or scene.render.views_format != "MULTIVIEW" or camera is None:
        return camera
    if view not in views:
        raise InputError(f"scene {scene.name!r} has no view {view!r}: its views are {', '.join(views.keys())}")
    name = camera_name(camera.name, views[view].camera_suffix, [one.camera_suffix for one in views])
    return scene.objects.get(name, camera)


def check_camera(scene, camera_object) -> None:
    """Raise InputError unless the object is a camera. Blender itself takes any object for one."""
    if camera_object is None:
        raise InputError(f"scene {scene.name!r} has no active camera: add one, or set one in the Scene properties")
    if not isinstance(camera_object, bpy.types.Object):
        raise InputError(f"{camera_object!r} is no object: give one, such as scene.objects['Camera']")
    if camera_object.type != "CAMERA":
        kind = camera_object.type.replace("_", " ").lower()
        raise InputError(f"{camera_object.name!r} is of type {kind}, not a camera: set one in the Scene properties")


def _focus_position(dof, depsgraph):
    """Return where the focus object, or its bone, is in the world; None without one."""
    if dof.focus_object is None:
        return None
    matrix = dof.focus_object.evaluated_get(depsgraph).matrix_world
    if dof.focus_object.pose is not None and dof.focus_subtarget in dof.focus_object.pose.bones:
        matrix = matrix @ dof.focus_object.evaluated_get(depsgraph).pose.bones[dof.focus_subtarget].matrix
    return np.array(matrix.translation, dtype=np.float64)


def _gray(image):
    """Return the mean of an image's red, green and blue, (rows, columns) from the bottom; None without an image."""
    if image is None or not image.size[0]:
        return None
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(height, width, image.channels)[..., :3].mean(axis=-1)
