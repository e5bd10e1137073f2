"""A camera and its render settings, copied from Blender under Blender's own names."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import product

import bpy
import numpy as np

from ...core.arguments import shown
from ...core.camera import pixel_time
from ...core.camera.stereo import camera_name
from ...core.cameras import find_model
from ...core.cameras.behind_port import takes_port
from ...core.cameras.parts import aperture
from ...core.cameras.parts.port_settings import PORT
from ...core.cameras.parts.settings import OWN, RECORD_FIELDS, Setting
from ...core.records import BlenderCamera, InputError
from ...core.shaders.camera_shader import Mark, read_mark
from ...core.units import UNIT_SCALE
from ..properties.declared import BLENDERS_OWN, MODEL, files
from ..properties.owners import owner_of
from .frames import frame_of
from .lengths import meters_of
from .slits_and_paths import line_record
from .stored import own_value
from .texels import pixels_of
from .unique import by_name, named, unique_name

CAMERA = (
    "type", "lens", "sensor_fit", "sensor_width", "sensor_height", "shift_x", "shift_y", "ortho_scale",
    "clip_start", "clip_end",
)  # fmt: skip
RENDER = (
    "resolution_x", "resolution_y", "resolution_percentage", "pixel_aspect_x", "pixel_aspect_y",
    "use_border", "border_min_x", "border_max_x", "border_min_y", "border_max_y", "use_crop_to_border",
)  # fmt: skip
DEPTH_OF_FIELD = tuple(setting.name for setting in aperture.DEPTH_OF_FIELD)
STEREO = (
    "convergence_mode", "pivot", "interocular_distance", "convergence_distance", "use_spherical_stereo",
    "use_pole_merge", "pole_merge_angle_from", "pole_merge_angle_to",
)  # fmt: skip
MULTIVIEW = ("use_multiview", "views_format")


def camera_record(camera_object, depsgraph) -> BlenderCamera:
    """Return the record of a camera object as the depsgraph evaluated it, with its scene's render settings.

    ``settings`` holds, by name, the settings that the camera's model and the mode of its pixel times declare, and for
    every camera ``time_mode``, ``panorama_type``, DEPTH_OF_FIELD, STEREO, MULTIVIEW, ``frame``, UNIT_SCALE and
    ``focus_position``, the focus object's place in the world (3,) or None. Raises InputError if there is no camera, if
    the object is not a camera, and if there is no model for it.
    """
    scene = depsgraph.scene_eval
    check_camera(scene, camera_object)
    evaluated = camera_object.evaluated_get(depsgraph)
    data = evaluated.data
    raw = BlenderCamera(
        name=unique_name(camera_object.original, bpy.data.objects),
        model=own_value(data, MODEL),
        matrix_world=np.array(evaluated.matrix_world, dtype=np.float64),
        settings={
            pixel_time.MODE.name: own_value(data, pixel_time.MODE),
            **copied(data, ["panorama_type"]),
            **copied(data.dof, DEPTH_OF_FIELD),
            **copied(data.stereo, STEREO),
            **copied(scene.render, MULTIVIEW),
            "frame": frame_of(scene),
            UNIT_SCALE: meters_of(scene),
            "focus_position": _focus_position(data.dof, depsgraph),
        },
        **copied(data, CAMERA),
        **copied(scene.render, RENDER),
    )
    mark = shader_mark(data)
    raw = raw if mark is None else replace(raw, type=mark.blender_type)
    chosen, mode = MODEL.read(raw), pixel_time.MODE.read(raw)
    raw = replace(raw, model="" if chosen == BLENDERS_OWN else chosen)
    if takes_port(find_model(raw)) and own_value(data, PORT) != PORT.default:
        raw = replace(raw, settings={**raw.settings, PORT.name: own_value(data, PORT)})
    read = (*find_model(raw).SETTINGS, *pixel_time.SETTINGS[mode])
    values = {setting.name: _value(setting, data, depsgraph) for setting in read if setting.name not in RECORD_FIELDS}
    return replace(raw, settings={**raw.settings, **values})


def shader_mark(camera) -> Mark | None:
    """Return the mark of a custom camera's shader, with the original camera type; None if it is not one of ours."""
    if camera.type != "CUSTOM" or camera.custom_mode != "INTERNAL" or camera.custom_shader is None:
        return None
    return read_mark(camera.custom_shader.as_string())


def has_pixel_times(camera_object, depsgraph) -> bool:
    """Return whether an object is a camera whose pixels have their own times."""
    if camera_object is None or camera_object.type != "CAMERA":
        return False
    return own_value(camera_object.evaluated_get(depsgraph).data, pixel_time.MODE) != pixel_time.NONE


def _value(setting: Setting, data, depsgraph):
    """Return the value of a setting of a camera's evaluated data, as records store it."""
    if setting.owner == OWN:
        value = own_value(data, setting)
    else:
        owner = owner_of(setting, data, depsgraph.scene_eval)
        value = setting.default if owner is None else getattr(owner, setting.name)
    return READERS[setting.kind](setting, value, data, depsgraph) if setting.kind in READERS else value


READERS = {
    "VECTOR": lambda setting, value, data, depsgraph: tuple(value),
    "FILE": lambda setting, value, data, depsgraph: bpy.path.abspath(value, library=data.library),
    "OBJECT": lambda setting, value, data, depsgraph: line_record(setting, value, depsgraph),
    "IMAGE": lambda setting, value, data, depsgraph: _gray(value),
}
"""Conversions of a setting's value from Blender to a record, by kind of setting; other kinds need no conversion."""


def named_files() -> list[str]:
    """Return the sorted paths of the files that cameras in the open file name: calibrations, lenses."""
    paths = set()
    for data, file in product(bpy.data.cameras, files()):
        with suppress(InputError):  # a name that is no text: the camera is refused where it is cast
            paths.add(bpy.path.abspath(own_value(data, file), library=data.library))
    return sorted(paths)


def copied(source, names) -> dict[str, object]:
    """Return the named properties of a Blender struct."""
    return {name: getattr(source, name) for name in names}


def find_camera(scene, name):
    """Return the scene's camera object of that name. Raises InputError that lists the cameras for an unknown name."""
    cameras = [item for item in scene.objects if item.type == "CAMERA"]
    camera = named(name, cameras)
    if camera is None:
        known = ", ".join(map(repr, by_name(cameras))) or "none at all"
        raise InputError(f"scene {scene.name!r} has no camera {name!r}; its cameras are: {known}")
    return camera


ALL = "ALL"
"""Word that selects all cameras of a scene."""


def find_cameras(scene, names: Sequence[str]) -> list:
    """Return the scene's camera objects of these names, each once; for ALL, all of them sorted by name.

    Raises InputError for an unknown name, and if there is no camera.
    """
    names = dict.fromkeys(names)
    for name in names:
        if name != ALL:
            find_camera(scene, name)
    if ALL in names:
        names = by_name(item for item in scene.objects if item.type == "CAMERA") or [ALL]
    return list(dict.fromkeys(find_camera(scene, name) for name in names))


def check_markers(scene) -> None:
    """Raise InputError if markers of the timeline change the scene's camera from frame to frame."""
    bound = {marker.camera for marker in scene.timeline_markers if marker.camera} | {scene.camera}
    if len(bound) > 1:
        known = ", ".join(map(repr, by_name(bound)))
        raise InputError(f"markers change the camera of scene {scene.name!r} ({known}): name cameras with --cameras")


def views_of(scene) -> list:
    """Return the views that Blender renders of a scene; none if the scene is not multi-view."""
    render = scene.render
    views = render.stereo_views if render.views_format == "STEREO_3D" else render.views
    return [view for view in views if view.use and render.use_multiview]


def view_names(scene) -> list[str]:
    """Return the names of a scene's views; one empty name if the scene is not multi-view."""
    return [view.name for view in views_of(scene)] or [""]


def eye_object(scene, view: str, camera=None):
    """Return the camera object of a multi-view view: ``camera``, or in the Multi-View format the view's own in its
    place. The default is the active camera.

    Raises InputError in the Multi-View format for an unknown view.
    """
    camera, views = camera or scene.camera, scene.render.views
    if not view or scene.render.views_format != "MULTIVIEW" or camera is None:
        return camera
    if view not in views:
        raise InputError(f"scene {scene.name!r} has no view {shown(view)}: its views are {', '.join(views.keys())}")
    name = camera_name(camera.name, views[view].camera_suffix, [item.camera_suffix for item in views])
    return scene.objects.get(name, camera)


def is_removed(item) -> bool:
    """Whether Blender has freed the data of a Python object."""
    try:
        item.name  # noqa: B018 (asking is what raises)
    except ReferenceError:
        return True
    return False


def check_camera(scene, camera_object) -> None:
    """Raise InputError unless the object is a camera of this file. Blender itself accepts any object as a camera."""
    if camera_object is None:
        others = [other.name for other in bpy.data.scenes if other != scene and other.camera is not None]
        raise InputError(
            f"scene {scene.name!r} has no active camera: add a camera, or set a camera in the Scene properties, or "
            "name a camera (--camera NAME)" + (f"; scene {others[0]!r} has one (--scene)" if others else "")
        )
    if not isinstance(camera_object, bpy.types.Object):
        raise InputError(f"{shown(camera_object)} is not an object: give an object such as scene.objects['Camera']")
    if is_removed(camera_object):
        raise InputError("the camera object has been removed from the file: give an existing object")
    if camera_object.type != "CAMERA":
        kind = camera_object.type.replace("_", " ").lower()
        raise InputError(
            f"{camera_object.name!r} is of type {kind}, not a camera: set a camera in the Scene properties"
        )


def _focus_position(dof, depsgraph):
    """Return the world position of the focus object or its bone, (3,); None without a focus object."""
    if dof.focus_object is None:
        return None
    matrix = dof.focus_object.evaluated_get(depsgraph).matrix_world
    if dof.focus_object.pose is not None and dof.focus_subtarget in dof.focus_object.pose.bones:
        matrix = matrix @ dof.focus_object.evaluated_get(depsgraph).pose.bones[dof.focus_subtarget].matrix
    return np.array(matrix.translation, dtype=np.float64)


def _gray(image):
    """Return the mean of an image's red, green and blue, (rows, columns) from the bottom; None without an image.

    Raises InputError if Blender cannot load the pixels.
    """
    if not isinstance(image, bpy.types.Image):  # a file may store anything there
        return None
    if not (image.size[0] and image.size[1]):
        path = bpy.path.abspath(image.filepath, library=image.library)
        raise InputError(f"image {image.name!r} cannot be read from {path!r}: find its file, or choose another image")
    return pixels_of(image)[..., :3].mean(axis=-1, dtype=np.float64)
