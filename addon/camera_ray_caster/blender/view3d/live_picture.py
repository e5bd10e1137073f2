"""The picture of a live view in a region: its camera, the directions of its rays, its faces, what is around them."""

from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import gpu
import numpy as np
from gpu_extras.presets import draw_texture_2d
from mathutils import Matrix

from ...core.camera.camera import Camera
from ...core.camera.stereo import eye_record
from ...core.cameras.parts.port_settings import PORT
from ...core.faces.faces import Face, faces_of, refusal, turn_of
from ...core.maths.recording import NotRecordable
from ...core.shaders.ray_map import ray_map
from ..read.evaluated import camera_or_reason
from ..read.scene_cache import differences
from .live_programs import draw_map, draw_warp, map_texture
from .overlay import batch_of, draw_batch

LARGEST_FACE = 2048
"""Largest side of a face in texels."""
LINE = 1.0
"""Width of the frame's outline in pixels."""


@dataclass
class LiveView:
    """The parts of a region's picture, each with the key of its inputs."""

    camera: tuple[Any, Camera | None, str] = (None, None, "")
    """Key, camera, and why it is not shown live."""
    differences: tuple[str, ...] = ()
    """Differences between a render and the window, in sentences."""
    lens: tuple[Any, Any] = (None, None)
    directions: tuple[Any, Any, Any] = (None, None, None)
    """Key, texture and its owner."""
    faces: tuple[Any, tuple[Face, ...]] = (None, ())
    buffers: list = field(default_factory=list)
    canvas: Any = None
    """Buffer in which Blender draws each face in turn: for each buffer that it draws EEVEE keeps about 1 GB."""
    drawn: Any = None
    changes: int = 0
    """How often something was evaluated."""
    count: int = 0
    """How often the faces have been drawn."""


def why_not(camera_object, depsgraph) -> str:
    """Return why the picture of a camera object cannot be live; "" if it can."""
    _, camera, reason = camera_or_reason(camera_object, depsgraph)
    return _reason(camera) if camera else reason


def _reason(camera: Camera) -> str:
    if camera.pixel_time is not None:
        return "each pixel has its own time"
    return "" if is_blenders(camera) else refusal(camera)


def draw_picture(context, view: LiveView, camera: Camera, frame, is_anew: bool = False) -> None:
    """Draw the picture in a region, if ``is_anew`` without what is around it."""
    lens = type(camera.model), repr(camera.settings), camera.raster.size, camera.pose.basis.tobytes(), view.camera[0][1]
    _draw_directions(camera, view, (lens, frame, context.region.width, context.region.height))
    draw_warp(
        view.directions[1], [buffer.texture_color for buffer in view.buffers], view.faces[1],
        turn_of(camera).T @ camera.pose.basis, _grounds(context), _inside(context, frame), is_anew,
    )  # fmt: skip
    _draw_frame(context, frame)


def draw_picture_anew(context, view: LiveView, camera: Camera, frame) -> bool:
    """Draw the faces of a region and its picture if something has changed; return whether it has."""
    region, (left, bottom, right, top) = context.region, frame
    x, y = camera.raster.width / (right - left), camera.raster.height / (top - bottom)
    region_seen = (
        max(0.0, -left * x), max(0.0, -bottom * y), min(camera.raster.width, (region.width - left) * x),
        min(camera.raster.height, (region.height - bottom) * y),
    )  # fmt: skip
    if not (region_seen[0] < region_seen[2] and region_seen[1] < region_seen[3]):
        return False
    key = view.directions[0], region_seen
    if view.faces[0] != key:
        view.faces = key, faces_of(camera, min(x, y), LARGEST_FACE, region_seen)
        view.buffers = [gpu.types.GPUOffScreen(*face.size, format="RGBA8") for face in view.faces[1]]
        size = tuple(max(sides) for sides in zip((1, 1), *(face.size for face in view.faces[1]), strict=True))
        if view.canvas is None or (view.canvas.width, view.canvas.height) != size:
            view.canvas = gpu.types.GPUOffScreen(*size, format="RGBA8")
        view.drawn = None
    seen = view.changes, camera.pose.eye.tobytes(), *_looks(context)
    if view.drawn == seen:
        return False
    for face, buffer in zip(view.faces[1], view.buffers, strict=True):
        _draw_face(context, camera, face, view.canvas, buffer)
    view.drawn, view.count = seen, view.count + 1
    draw_picture(context, view, camera, frame, is_anew=True)
    return True


def camera_of(context, view: LiveView) -> Camera | None:
    """Return the camera of the view's eye; None if there is none, or if it cannot be live."""
    scene = context.scene
    key = view.changes, _eye(context), scene.camera.as_pointer()
    if view.camera[0] != key:
        eye = partial(eye_record, view=key[1])
        _, camera, reason = camera_or_reason(scene.camera, context.evaluated_depsgraph_get(), eye)
        view.differences = tuple(differences(camera, scene))
        reason = _reason(camera) if camera else reason
        view.camera = key, None if reason else replace(camera, pixel_time=None), reason
    return view.camera[1]


def _eye(context) -> str:
    """Return the name of the eye that a view shows; "" for the camera itself."""
    render, shown = context.scene.render, context.space_data.stereo_3d_camera
    if not render.use_multiview or render.views_format != "STEREO_3D":
        return ""
    return {"LEFT": "left", "RIGHT": "right"}.get(shown, "")


def is_blenders(camera: Camera) -> bool:
    """Return whether Blender's own drawing is the camera's picture."""
    record = camera.record
    return not record.model and record.type in ("PERSP", "ORTHO") and PORT.name not in record.settings


def _draw_directions(camera: Camera, view: LiveView, key) -> None:
    """Draw the directions of the region's pixels, unless they are those of the key; where GLSL cannot have the formula,
    from numpy.
    """
    if view.directions[0] == key:
        return
    lens, frame, width, height = key
    if view.lens[0] != lens:
        try:
            view.lens = lens, ray_map(camera.model)
        except NotRecordable:
            view.lens = lens, None
    if view.lens[1] is None:
        view.directions = key, map_texture(_directions(camera, frame, width, height)), None
        return
    buffer = view.directions[2]
    if buffer is None or (buffer.width, buffer.height) != (width, height):
        buffer = gpu.types.GPUOffScreen(width, height, format="RGBA32F")
    draw_map(buffer, view.lens[1], frame, camera.raster.size)
    view.directions = key, buffer.texture_color, buffer


def _directions(camera: Camera, frame, width: int, height: int) -> np.ndarray:
    """Return what ``draw_map`` draws, (height, width, 4), from numpy."""
    (left, bottom, right, top), (w, h) = frame, camera.raster.size
    x = (np.arange(width) + 0.5 - left) / (right - left) * w
    y = (np.arange(height) + 0.5 - bottom) / (top - bottom) * h
    columns, rows = np.flatnonzero(abs(2 * x / w - 1) <= 1), np.flatnonzero(abs(2 * y / h - 1) <= 1)
    rays = camera.rays_at(x[columns], y[rows, None])
    vectors = np.zeros((height, width, 4), np.float32)
    local = np.append(rays.directions @ np.linalg.inv(camera.pose.basis).T, np.ones((*rays.valid.shape, 1)), axis=-1)
    vectors[np.ix_(rows, columns)] = np.where(rays.valid[..., None], local, 0.0)
    return vectors


def _looks(context) -> tuple:
    """Return what of the window, besides evaluated data, the faces depend on."""
    space, scene, active = context.space_data, context.scene, context.view_layer.objects.active
    settings = [
        tuple(getattr(owner, prop.identifier)) if getattr(prop, "is_array", False) else getattr(owner, prop.identifier)
        for owner in (space.shading, space.overlay) for prop in owner.bl_rna.properties
        if prop.type in ("BOOLEAN", "INT", "FLOAT", "ENUM")
    ]  # fmt: skip
    view = scene.view_settings
    return (
        settings, [item.as_pointer() for item in context.selected_objects], context.mode,
        active and active.name_full, tuple(scene.cursor.location), scene.render.engine,
        space.local_view is not None, view.view_transform, view.exposure, view.gamma, view.look,
        [getattr(space, f"show_object_viewport_{kind}") for kind in ("mesh", "light", "camera", "empty", "curve")],
    )  # fmt: skip


def _draw_face(context, camera: Camera, face: Face, canvas, buffer) -> None:
    """Have Blender draw a face at the bottom left of a canvas, and copy it into a buffer of the face's size."""
    world = np.eye(4)
    world[:3, :3], world[:3, 3] = turn_of(camera) @ face.axes.T, camera.pose.eye
    wider, higher = canvas.width / buffer.width, canvas.height / buffer.height
    left, right, bottom, top = face.window
    window = left, left + (right - left) * wider, bottom, bottom + (top - bottom) * higher
    matrix = projection(replace(face, window=window), camera.clip_start / face.reach, camera.clip_end)
    canvas.draw_view3d(
        context.scene, context.view_layer, context.space_data, context.region, Matrix(world).inverted(), matrix,
        do_color_management=True, draw_background=True,
    )  # fmt: skip
    with buffer.bind(), gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
        gpu.matrix.load_identity()
        gpu.matrix.load_projection_matrix(Matrix.Identity(4))
        gpu.state.blend_set("NONE")
        gpu.state.depth_test_set("NONE")
        draw_texture_2d(canvas.texture_color, (-1, -1), 2 * wider, 2 * higher)


def projection(face: Face, near: float, far: float) -> Matrix:
    """Return the matrix from a face's frame to clip space."""
    left, right, bottom, top = face.window
    return Matrix((
        (2 / (right - left), 0, (right + left) / (right - left), 0),
        (0, 2 / (top - bottom), (top + bottom) / (top - bottom), 0),
        (0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)),
        (0, 0, -1, 0),
    ))  # fmt: skip


def _grounds(context) -> tuple[np.ndarray, np.ndarray]:
    """Return the background color inside of the camera's frame, and that outside, under the passepartout, as sRGB."""
    shading, data = context.space_data.shading, context.scene.camera.data
    ground = np.array(context.preferences.themes[0].view_3d.space.gradients.high_gradient[:3])
    if shading.type == "SOLID" and shading.background_type == "VIEWPORT":
        linear = np.array(shading.background_color[:3])
        ground = np.where(linear < 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return ground, ground * (1 - data.passepartout_alpha if data.show_passepartout else 1.0)


def _inside(context, frame) -> tuple[float, float, float, float]:
    """Return left, bottom, right, top of what is shown: the frame, or where Blender renders it, its border."""
    left, bottom, right, top = frame
    render = context.scene.render
    if not (render.use_border and context.space_data.shading.type == "RENDERED"):
        return frame
    width, height = right - left, top - bottom
    return (left + render.border_min_x * width, bottom + render.border_min_y * height,
            left + render.border_max_x * width, bottom + render.border_max_y * height)  # fmt: skip


def _draw_frame(context, frame) -> None:
    """Draw the outline of the camera's frame, which the picture covers."""
    if not context.space_data.overlay.show_overlays:
        return
    left, bottom, right, top = frame
    corners = [(left, bottom), (right, bottom), (right, top), (left, top)]
    lines = [(corners[k], corners[(k + 1) % 4]) for k in range(4)]
    color = (*context.preferences.themes[0].view_3d.wire[:3], 1.0)
    with gpu.matrix.push_pop(), gpu.matrix.push_pop_projection():
        gpu.matrix.load_identity()
        gpu.matrix.load_projection_matrix(_pixels(context.region.width, context.region.height))
        gpu.state.blend_set("ALPHA")  # or Blender's own view shows through the line
        draw_batch(batch_of("POLYLINE", lines), "POLYLINE", color, LINE)


def _pixels(width: int, height: int) -> Matrix:
    return Matrix(((2 / width, 0, 0, -1), (0, 2 / height, 0, -1), (0, 0, -1, 0), (0, 0, 0, 1)))
