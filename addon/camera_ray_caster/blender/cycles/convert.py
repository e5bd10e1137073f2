"""Conversion of a camera to a custom camera of Cycles with the same rays, and back."""

import numpy as np

from ...core.camera.camera import Camera
from ...core.camera.stereo import SIDES, blender_shift, eye_record
from ...core.cameras import find_model
from ...core.cameras.parts.settings import Line
from ...core.conventions import EPS32
from ...core.records import BlenderCamera, InputError
from ...core.shaders.camera_shader import CameraShader, camera_shader
from ..properties.declared import ENGINE
from ..read.camera_fields import shader_mark
from ..read.evaluated import camera_at
from ..read.frames import action_time, frame_of, go_to
from ..read.scene_reader import evaluated_camera
from .animation import insert_keyframes, is_animated
from .device import device_notes
from .rolling import check_time, set_up_time
from .shader import check_cycles, check_enabled, clear_shader, set_inputs, set_shader, texture_folder

MOST_FRAMES = 10_000
"""Maximum number of frames with keyframes: almost seven minutes of film. Evaluating them takes about 20 s."""

FIT, BACK = "use Fit Blender's Lens", "go Back to Blender's Camera"
"""What to do, by the buttons that are drawn then, where Cycles runs no shader."""

GRID = 5
"""Number of pixels per side at which an eye is compared with the camera."""


def to_cycles(scene, camera_object=None) -> list[str]:
    """Make a camera a custom camera of Cycles, with a shader that gives the rays of ``read_camera`` in float32.

    camera_object: default the scene's active camera. The shader is a text in the file, so that the file renders in a
    Blender without this add-on. Animation within the scene's frame range becomes keyframes of the shader's inputs. The
    model, its settings and its pose are not changed, and ``read_camera`` still returns the same camera. A camera that
    is already converted gets a new shader and new keyframes.
    Rows that are exposed one after another from the top down use Cycles' own rolling shutter. A slit scan, which shows
    the same frames whatever the current frame is, renders correctly at one frame only, to which the scene is set.
    ``picture_of`` renders other orders.
    Returns lines on changes that are followed only while the add-on is enabled, on changes made to the scene, and on an
    engine or device that cannot show the camera.
    Raises InputError for cameras that ``read_camera`` refuses, for linked cameras, for spherical stereo, for pixel
    times in another order than Cycles', and if this Blender has no OSL. The camera is then unchanged.
    """
    check_enabled()
    with evaluated_camera(scene, camera_object) as (active, depsgraph):
        raw, camera = camera_at(active, depsgraph)
        check_cycles(f"{FIT}, or an official build" if raw.model else "Cycles renders this camera as it is")
        _check(raw, camera, active)
        now = frame_of(scene)
        at_frames = {now: (raw, camera)}
        if _may_move(scene, active, raw):
            at_frames = {frame: camera_at(active, go_to(scene, frame)) for frame in (*_frames(scene), now)}
    places = frozenset().union(*(shader_of(*eye_and_camera).places for eye_and_camera in at_frames.values()))
    shaders = {frame: shader_of(*eye_and_camera, places) for frame, eye_and_camera in sorted(at_frames.items())}
    shader = shaders[now]
    set_shader(active.data, shader)
    if any(each.source != shader.source for each in shaders.values()):
        remarks = [
            "The formula of the camera changes over time: Cycles follows this change only if the add-on is enabled"
        ]
    else:
        insert_keyframes(active.data, {action_time(scene, frame): each for frame, each in shaders.items()})
        remarks = _keyframe_notes(shaders)
    set_inputs(active.data, shader)
    remarks += [f"Cycles reads the rays from {path!r}, which has to stay there" for path in shader.textures]
    otherwise = f"{BACK} and {FIT}" if raw.model else BACK
    return remarks + set_up_time(scene, raw, camera) + _engine_notes(scene) + device_notes(scene, otherwise)


def from_cycles(camera_object) -> None:
    """Restore the type of a camera that ``to_cycles`` has converted.

    Raises InputError for any other camera, for a linked camera, and if Cycles is disabled.
    """
    check_enabled()
    camera = camera_object.data
    mark = shader_mark(camera)
    if mark is None:
        raise InputError(f"camera {camera_object.name!r} has no shader of this add-on: there is nothing to undo")
    _check_editable(camera_object)
    clear_shader(camera)
    camera.type = mark.blender_type


def shader_of(raw: BlenderCamera, camera: Camera, places: frozenset[int] = frozenset()) -> CameraShader:
    """Return the shader of a camera and the record that it was made from."""
    return camera_shader(camera, raw.type, (raw.shift_x, raw.shift_y), places, folder=texture_folder())


def _frames(scene) -> range:
    """Return the frames that get keyframes. Raises InputError for too many."""
    frames = range(scene.frame_start, scene.frame_end + 1)
    if len(frames) > MOST_FRAMES:
        raise InputError(
            f"the camera may change in each of the scene's {len(frames)} frames, but at most {MOST_FRAMES} frames can "
            "get keyframes: set a shorter frame range (Output properties)"
        )
    return frames


def _may_move(scene, camera_object, raw: BlenderCamera) -> bool:
    """Whether the shader may change between frames: settings are animated, or it depends on other objects."""
    lines = any(isinstance(setting, Line) for setting in find_model(raw).SETTINGS)
    focused = bool(raw.settings["use_dof"]) and raw.settings["focus_position"] is not None
    return lines or focused or is_animated(camera_object.data) or is_animated(scene)


def _keyframe_notes(shaders) -> list[str]:
    moves = len({tuple(shader.values.items()) for shader in shaders.values()}) > 1
    return [
        f"The shader's inputs have keyframes at frames {min(shaders):.9g} to {max(shaders):.9g}: Cycles follows other "
        "frames and later changes of the camera only if the add-on is enabled"
    ] * moves


def _engine_notes(scene) -> list[str]:
    """Return a line on an engine that cannot show a custom camera; none for Cycles and the add-on's engine."""
    engine = scene.render.engine
    if engine in ("CYCLES", ENGINE):
        return []
    return [f"The render engine is {engine}, which shows the camera as a perspective camera: choose Cycles"]


def _check(raw: BlenderCamera, camera: Camera, camera_object) -> None:
    """Raise InputError for a camera that cannot become a custom camera."""
    _check_editable(camera_object)
    if raw.settings["use_spherical_stereo"] and raw.type in ("PERSP", "PANO") and not raw.model:
        raise InputError(
            f"camera {raw.name!r} has Spherical Stereo, which Cycles supports for its own camera types only: keep the "
            "camera's type, and Cycles renders it"
        )
    check_time(raw, camera)
    if raw.settings["use_multiview"] and raw.settings["views_format"] == "STEREO_3D":
        for view in SIDES:
            _check_eye(raw, camera, view)


def _check_editable(camera_object) -> None:
    if not camera_object.data.is_editable:
        raise InputError(
            f"camera {camera_object.name!r} is linked from a library: make it local first (Object > Relations)"
        )


def _check_eye(raw: BlenderCamera, camera: Camera, view: str) -> None:
    """Raise InputError for a Stereo 3D eye that is not simply the camera, moved, turned and shifted as by Cycles.

    Cycles shifts an eye of any custom camera as Blender does, but by fractions of the frame's width, whatever Sensor
    Fit is.
    """
    shift = blender_shift(raw, view) - raw.shift_x
    width, height = camera.raster.size
    x, y = np.linspace(0, width, GRID)[None, :], np.linspace(0, height, GRID)[:, None]
    eye = eye_record(raw, view)
    rays = find_model(eye).from_blender(eye, camera.raster).rays(x, y)
    moved = camera.model.rays(x + shift * width, y)
    for vector, moved_vector in zip(rays, moved, strict=True):
        first, second = (np.stack(np.broadcast_arrays(*components)) for components in (vector, moved_vector))
        if not np.allclose(first, second, rtol=EPS32, atol=EPS32 * np.nanmax(np.abs(second)), equal_nan=True):
            raise InputError(
                f"the eyes of camera {raw.name!r} differ from the eyes that Cycles makes of a custom camera: disable "
                "Stereoscopy and render one eye at a time, or choose Parallel, or set Sensor Fit to the frame's width"
            )
