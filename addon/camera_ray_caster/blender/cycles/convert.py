"""From a camera to a custom one of Cycles with the same rays, and back."""

import numpy as np

from ...core.camera.camera import Camera
from ...core.camera.stereo import SIDES, eye_record
from ...core.cameras import find_model
from ...core.cameras.parts.settings import Line
from ...core.conventions import EPS32
from ...core.records import BlenderCamera, InputError
from ...core.shaders.camera_shader import CameraShader, camera_shader
from ..properties.declared import ENGINE
from ..read.camera import shader_mark
from ..read.evaluated import camera_at
from ..read.scene import evaluated_camera, go_to
from .animation import insert_keyframes, is_animated
from .device import said_of_device
from .rolling import check_time, set_up_time
from .shader import check_cycles, check_enabled, clear_shader, set_inputs, set_shader

MOST_FRAMES = 10_000
"""Almost seven minutes of a film, in about 20 s: each frame is evaluated for its keyframes."""

GRID = 5
"""Pixels a side at which an eye is compared with the camera."""


def to_cycles(scene, camera_object=None) -> list[str]:
    """Make a camera a custom one of Cycles, with a shader whose rays are those that ``read_camera`` gives.

    camera_object: default the scene's active camera. The shader is a text of the file, so that the file renders in a
    Blender without this add-on; what is animated in the scene's frame range becomes keyframes of its inputs. The model,
    its settings and its pose stay where they are, and ``read_camera`` gives the same camera afterwards; Cycles computes
    the rays in float32. A camera that is one already gets its shader and its keyframes anew.
    Rows that are exposed one after another from the top down are Cycles' own rolling shutter; a slit scan, which shows
    the same frames whatever the current one is, at one frame, to which the scene goes. ``picture_of`` renders others.
    Returns what follows only where the add-on is enabled, what was changed in the scene, and where the engine or the
    device will not show it, in lines.
    Raises InputError for what ``read_camera`` refuses, for a camera of a library, for spherical stereo, for pixel times
    in another order than Cycles', and where this Blender has no OSL. The camera is as it was then.
    """
    check_cycles()
    with evaluated_camera(scene, camera_object) as (active, depsgraph):
        raw, camera = camera_at(active, depsgraph)
        _check(raw, camera, active)
        now = scene.frame_current_final
        at_frames = {now: (raw, camera)}
        if _may_move(scene, active, raw):
            at_frames = {frame: camera_at(active, go_to(scene, frame)) for frame in (*_frames(scene), now)}
    places = frozenset().union(*(shader_of(*both).places for both in at_frames.values()))
    shaders = {frame: shader_of(*both, places) for frame, both in sorted(at_frames.items())}
    shader = shaders[now]
    set_shader(active.data, shader)
    if any(each.source != shader.source for each in shaders.values()):
        said = ["The formula itself changes over time: that follows only where the add-on is enabled"]
    else:
        insert_keyframes(active.data, shaders)
        said = _said_of_keyframes(active.data, shaders)
    set_inputs(active.data, shader)
    return said + set_up_time(scene, raw, camera) + _engine_said(scene) + said_of_device(scene)


def from_cycles(camera_object) -> None:
    """Give a camera that ``to_cycles`` has made a custom one its own type back.

    Raises InputError for any other, and for one of a library, and where Cycles is disabled.
    """
    check_enabled()
    camera = camera_object.data
    mark = shader_mark(camera)
    if mark is None:
        raise InputError(f"camera {camera_object.name!r} has no shader of this add-on: there is nothing to take back")
    _check_editable(camera_object)
    clear_shader(camera)
    camera.type = mark.blender_type


def shader_of(raw: BlenderCamera, camera: Camera, places: frozenset[int] = frozenset()) -> CameraShader:
    """Return the shader of a camera that was made of a record."""
    return camera_shader(camera, raw.type, (raw.shift_x, raw.shift_y), places)


def _frames(scene) -> range:
    """Return the frames that get keyframes. Raises InputError for too many."""
    frames = range(scene.frame_start, scene.frame_end + 1)
    if len(frames) > MOST_FRAMES:
        raise InputError(
            f"the camera may change in each of the scene's {len(frames)} frames, and at most {MOST_FRAMES} get "
            "keyframes: set a shorter frame range (Output properties)"
        )
    return frames


def _may_move(scene, camera_object, raw: BlenderCamera) -> bool:
    """Whether the shader may be another one at another frame: settings are animated, or objects count for it."""
    lines = any(isinstance(setting, Line) for setting in find_model(raw).SETTINGS)
    focused = bool(raw.settings["use_dof"]) and raw.settings["focus_position"] is not None
    return lines or focused or is_animated(camera_object.data) or is_animated(scene)


def _said_of_keyframes(camera, shaders) -> list[str]:
    moves = len({tuple(shader.values.items()) for shader in shaders.values()}) > 1
    return [
        f"Its inputs have keyframes at the frames {min(shaders):.9g} to {max(shaders):.9g}: other frames, and what is "
        "changed from now on, follow only where the add-on is enabled"
    ] * moves


def _engine_said(scene) -> list[str]:
    """Return what other engines show of a custom camera; the add-on's own and Cycles know what it is."""
    engine = scene.render.engine
    if engine in ("CYCLES", ENGINE):
        return []
    return [f"The render engine is {engine}, which shows a perspective camera: choose Cycles"]


def _check(raw: BlenderCamera, camera: Camera, camera_object) -> None:
    """Raise InputError for a camera that cannot be a custom one."""
    _check_editable(camera_object)
    if raw.settings["use_spherical_stereo"] and raw.type in ("PERSP", "PANO") and not raw.model:
        raise InputError(
            f"camera {raw.name!r} has Spherical Stereo, which Cycles has for its own cameras only: leave it as it is, "
            "and Cycles renders it"
        )
    check_time(raw, camera)
    if raw.settings["use_multiview"] and raw.settings["views_format"] == "STEREO_3D":
        for view in SIDES:
            _check_eye(raw, camera, eye_record(raw, view))


def _check_editable(camera_object) -> None:
    if not camera_object.data.is_editable:
        raise InputError(
            f"camera {camera_object.name!r} is linked from a library: make it local first (Object > Relations)"
        )


def _check_eye(raw: BlenderCamera, camera: Camera, eye: BlenderCamera) -> None:
    """Raise InputError for an eye of Stereo 3D that is more than the camera moved, turned and shifted as Cycles does.

    Cycles shifts an eye by fractions of the frame's width, whatever the sensor is fitted to.
    """
    width, height = camera.raster.size
    x, y = np.linspace(0, width, GRID)[None, :], np.linspace(0, height, GRID)[:, None]
    own = find_model(eye).from_blender(eye, camera.raster).rays(x, y)
    moved = camera.model.rays(x + (eye.shift_x - raw.shift_x) * width, y)
    for part, other in zip(own, moved, strict=True):
        one, two = (np.stack(np.broadcast_arrays(*vector)) for vector in (part, other))
        if not np.allclose(one, two, rtol=EPS32, atol=EPS32 * np.nanmax(np.abs(two)), equal_nan=True):
            raise InputError(
                f"the eyes of camera {raw.name!r} are not those that Cycles makes of a custom camera: switch "
                "Stereoscopy off and render one eye at a time, or for Off-Axis set Sensor Fit to the frame's width"
            )
