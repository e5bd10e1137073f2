"""Cycles' picture of a scene through its camera: float pixels that coincide with those of a cast.

The camera is a custom camera only while Cycles renders; the scene is restored afterwards. If pixels have their own
times, a rolling shutter is Cycles' own. So is a slit scan by rows or by columns, whose picture may be rendered turned.
The times of an image are rendered one by one, each only in the box of its pixels. A model's settings are those of the
current frame, or of each time of an image: Cycles' shutter moves poses and shapes, but not lenses. Adaptive
subdivision, which depends on the render engine, is left out, as in a cast.
"""

from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from time import perf_counter

import bpy
import numpy as np

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.camera.pixel_time import LinearTime, groups
from ...core.camera.stereo import blender_shift, eye_record
from ...core.camera.times import SweepTime
from ...core.casting.pass_needs import image_bytes
from ...core.memory import of_pixels, require
from ...core.records import BlenderCamera, InputError
from ...core.shaders.camera_shader import camera_shader
from ...core.shaders.turn import UPRIGHT, Turn, shutter_of
from ..process.signals import raise_if_stopping
from ..read.camera_fields import camera_record, shader_mark, view_names
from ..read.changes import changed
from ..read.scene_reader import evaluated, evaluated_camera
from .device import device_of
from .renderer import EnginePicture, Render, border, cycles_engine
from .rolling import blur_settings, is_shutter
from .shader import check_cycles, set_shader, texture_folder

DARK = 4e-3
"""Linear color up to which a picture is black: the denoiser makes up to 2.2e-3 of no light."""
BLACK = (
    "Cycles' picture is black: shapes hide the lamps and the world from what is seen, or there are none. Cycles "
    "has shadows, and casts have none: put a lamp where the camera is"
)


@dataclass(frozen=True)
class Eye:
    """A camera object for one view, at one frame."""

    camera_object: bpy.types.Object
    raw: BlenderCamera
    camera: Camera
    moved: bool
    """Whether it is an eye of Blender's Stereo 3D, for which Blender moves and shifts the camera object."""
    shift_x: float
    """Cycles' shift of the raster, in widths of the frame; not all models use the shift of an eye."""


def picture_of(scene) -> EnginePicture:
    """Render a scene's current frame with Cycles, with the file's settings and the rays of its camera.

    Raises InputError if Cycles is disabled or has no OSL, if ``read_camera`` refuses the camera, for a linked camera
    object, and if Blender cannot render; Cancelled if stopped between two renders.
    """
    check_cycles()
    started, pixels = perf_counter(), {}
    with cycles_engine(scene) as run:
        for view in view_names(scene):
            pixels |= {(layer, view): colors for layer, colors in _of_view(scene, view, run).items()}
    made_by = {"engine": "CYCLES", "device": device_of(scene), "samples": scene.cycles.samples}
    is_lit = any((colors[..., :3] > DARK).any() for colors in pixels.values())
    return EnginePicture("cycles", pixels, made_by, perf_counter() - started, () if is_lit else (BLACK,))


def _of_view(scene, view: str, render: Render) -> Mapping[str, np.ndarray]:
    eye = _eye(scene, view)
    shape = eye.camera.raster.shape
    require(2 * image_bytes(shape, ["combined"], np.float32), of_pixels("Cycles' picture", shape))
    time = eye.camera.pixel_time
    with _only(scene, eye, view):
        if isinstance(time, LinearTime):
            return _rolled(scene, eye, time, render)
        if isinstance(time, SweepTime):
            raise InputError(
                f"Cycles cannot move camera {eye.raw.name!r} from beam to beam: cast it, or set Time to One Time"
            )
        if time is not None:
            return _one_by_one(scene, eye, time, view, render)
        with _custom(eye):
            return render()


def _eye(scene, view: str, frame: float | None = None) -> Eye:
    with evaluated_camera(scene, frame=frame, view=view) as (active, depsgraph):
        plain = camera_record(active, depsgraph)
        raw = eye_record(plain, view)
        moved = raw.matrix_world is not plain.matrix_world
        shift = blender_shift(plain, view) if moved else raw.shift_x
        return Eye(active, raw, camera_from(raw), moved, shift)


def _rolled(scene, eye: Eye, time: LinearTime, render: Render) -> Mapping[str, np.ndarray]:
    """Render through Cycles' rolling shutter: with the scene's own settings, or set to the time of a slit scan."""
    with ExitStack() as stack:
        change = partial(changed, stack)
        for owner, values in blur_settings(scene, eye.raw, eye.camera, bpy.data.objects):
            change(owner, **values)
        turn = Turn.of(time)
        if turn.transposed:
            size = scene.render.resolution_y, scene.render.resolution_x
            change(scene.render, resolution_x=size[0], resolution_y=size[1])
        change(scene.render, **border(turn.raster(eye.camera.raster)))
        stack.enter_context(_custom(eye, turn))
        if not is_shutter(eye.raw):
            begin, _ = shutter_of(time, eye.camera.raster)
            stack.enter_context(evaluated(scene, begin))
        return {layer: turn.back(colors) for layer, colors in render().items()}


def _one_by_one(scene, eye: Eye, time, view: str, render: Render) -> Mapping[str, np.ndarray]:
    """Render each time separately, in the box of the pixels that have this time."""
    raster, pixels = eye.camera.raster, {}
    for frame, rows, columns, where in groups(time, raster.columns(), raster.rows()):
        raise_if_stopping()
        box = replace(raster, x0=raster.x0 + columns.start, x1=raster.x0 + columns.stop,
                      y0=raster.y0 + rows.start, y1=raster.y0 + rows.stop)  # fmt: skip
        with ExitStack() as stack:
            then = _eye(scene, view, frame)
            changed(stack, scene.render, **border(box))
            stack.enter_context(_custom(then))
            stack.enter_context(evaluated(scene, frame))
            for layer, colors in render().items():
                into = pixels.setdefault(layer, np.empty((*raster.shape, 4), np.float32))
                into[rows, columns][where] = colors[where]
    return pixels


@contextmanager
def _only(scene, eye: Eye, view: str) -> Iterator[None]:
    """Restrict a render to one view: an eye of Blender's Stereo 3D as such, any other as if multi-view were off."""
    with ExitStack() as stack:
        if eye.moved:
            for other in scene.render.views:
                changed(stack, other, use=other.name == view)
        else:
            changed(stack, scene, camera=eye.camera_object)
            changed(stack, scene.render, use_multiview=False)
        yield


@contextmanager
def _custom(eye: Eye, turn: Turn = UPRIGHT) -> Iterator[None]:
    """Make a camera object a custom camera temporarily, by a copy of its data with a shader that no handler updates."""
    shader = camera_shader(eye.camera, eye.raw.type, (eye.shift_x, eye.raw.shift_y), turn=turn, folder=texture_folder())
    item = eye.camera_object
    if not item.is_editable:
        raise InputError(f"camera {item.name!r} is linked from a library: make it local first (Object > Relations)")
    data, copy, text = item.data, item.data.copy(), None
    try:
        copy.animation_data_clear()
        if shader_mark(copy) is not None:
            copy.custom_shader, copy.type = None, "PERSP"
        set_shader(copy, replace(shader, source=shader.source.partition("\n")[2]))
        text, item.data = copy.custom_shader, copy
        yield
    finally:
        item.data = data
        bpy.data.cameras.remove(copy)
        if text is not None:
            bpy.data.texts.remove(text)
