"""EEVEE's or Workbench's picture of a scene through its camera: float pixels that coincide with those of a cast.

Blender renders a few perspective faces from the camera's eye, which the model's formula resamples (``core.faces``).
Each face has a camera of its own, a child of the scene's camera, so that motion blur follows it. EEVEE renders beyond
the edges of faces, so that screen-space effects have what lies there.
"""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from time import perf_counter

import bpy
import numpy as np
from mathutils import Matrix

from ...core.camera.build import camera_from
from ...core.camera.camera import Camera
from ...core.camera.stereo import eye_record
from ...core.casting.pass_needs import image_bytes
from ...core.faces.faces import Face, faces_of, refusal, turn_of
from ...core.faces.lens_points import LensPoint, blur_refusal, lens_points
from ...core.faces.resample import FINER, resampled
from ...core.memory import of_pixels, require
from ...core.records import InputError
from ..cycles.renderer import EnginePicture, only_engine
from ..process.opening import refused_as_input
from ..process.signals import raise_if_stopping
from ..read.camera_fields import camera_record, view_names
from ..read.changes import changed
from ..read.scene_reader import evaluated_camera
from ..read.texels import pixels_of_file
from .driver import check_driver

EEVEE, WORKBENCH = "EEVEE", "WORKBENCH"
NAMES = {EEVEE: ("BLENDER_EEVEE_NEXT", "BLENDER_EEVEE"), WORKBENCH: ("BLENDER_WORKBENCH",)}
"""Blender's names of the engines, which depend on its version."""
OVERSCAN = 10.0
"""Percent of a face by which EEVEE renders beyond its edges."""
SENSOR = 36.0
IMAGE = {
    "media_type": "IMAGE", "file_format": "OPEN_EXR", "color_mode": "RGBA", "color_depth": "32",
    "color_management": "FOLLOW_SCENE", "exr_codec": "NONE",
}  # fmt: skip
"""Settings of the files of faces, in the order in which they can be set; Blender before 5.0 has no media_type."""
FAILED = "{} did not render a face: "
MATCAP = "A MatCap turns with each face of the picture, so that brightness jumps: choose Studio or Flat lighting"
NO_BLUR = "Depth of field is left out: {}"
ONE_SAMPLE = "with 1 sample every ray passes through the center of the aperture; raise Samples of the Ray Caster"


def engine_name(engine: str) -> str:
    """Return Blender's name of an engine, EEVEE or WORKBENCH."""
    return NAMES[engine][-1 if bpy.app.version >= (5, 0) else 0]


def picture_of(scene, engine: str, samples: int = 0) -> EnginePicture:
    """Render a scene's current frame with EEVEE or WORKBENCH, with the file's settings and the rays of its camera.

    samples: of EEVEE for each texel; 0 for the file's. Raises InputError for a camera that cannot be cast or whose
    picture is no warp of faces, and if Blender cannot render; Cancelled if stopped between two faces.
    """
    check_driver(engine)
    started, pixels, sizes = perf_counter(), {}, []
    warnings: list[str] = []
    eyes = {view: _eye(scene, view, engine) for view in view_names(scene)}
    with _prepared(scene, engine, samples):
        for view, (active, camera) in eyes.items():
            points, why = _lens(scene, camera)
            if why:
                warnings.append(NO_BLUR.format(why))
            raster = camera.raster
            region = raster.x0, raster.y0, raster.x1, raster.y1
            every = [(faces_of(camera, 1 / FINER, region=region, lens=point), point) for point in points]
            sizes += [face.size for faces, _ in every for face in faces]
            require(image_bytes(raster.shape, ["combined"], np.float32), of_pixels("the picture", raster.shape))
            for layer in [layer for layer in scene.view_layers if layer.use]:
                picture = np.zeros((*raster.shape, 4), np.float32)
                for faces, point in every:
                    rendered = [_rendered(scene, active, camera, face, point, layer, engine) for face in faces]
                    picture += resampled(camera, faces, rendered, point) / len(points)
                pixels[layer.name, view] = picture
    if engine == WORKBENCH and scene.display.shading.light == "MATCAP":
        warnings.append(MATCAP)
    texels = sum(width * height for width, height in sizes)
    made_by: dict[str, object] = {"engine": engine, "faces": len(sizes), "texels": texels}
    if engine == EEVEE:
        made_by["samples"] = samples or scene.eevee.taa_render_samples
    return EnginePicture("faces", pixels, made_by, perf_counter() - started, tuple(dict.fromkeys(warnings)))


def _eye(scene, view: str, engine: str) -> tuple[bpy.types.Object, Camera]:
    """Return the camera object and the camera of a view. Raises InputError if the engine cannot render its picture."""
    with evaluated_camera(scene, view=view) as (active, depsgraph):
        camera = camera_from(eye_record(camera_record(active, depsgraph), view))
    reason = refusal(camera)
    if not reason and camera.pixel_time is not None:
        reason = f"each pixel of camera {camera.name!r} has its own time"
    if reason:
        raise InputError(f"{reason}: {engine} cannot render that. Cast it, or render with Cycles")
    return active, camera


@contextmanager
def _prepared(scene, engine: str, samples: int) -> Iterator[None]:
    """Set the scene up for renders of faces until the context is left."""
    render = scene.render
    with ExitStack() as stack:
        only_engine(stack, scene)
        changed(stack, scene, camera=scene.camera)
        names = ("filepath", "use_border", "use_multiview", "use_single_layer", "resolution_percentage", "resolution_x")
        names += ("resolution_y", "pixel_aspect_x", "pixel_aspect_y", "use_overwrite", "use_placeholder")
        changed(stack, render, **{name: getattr(render, name) for name in names})
        changed(stack, render, use_border=False, use_multiview=False, resolution_percentage=100)
        image = {name: value for name, value in IMAGE.items() if hasattr(render.image_settings, name)}
        before = {name: getattr(render.image_settings, name) for name in image}
        stack.callback(lambda: [setattr(render.image_settings, name, value) for name, value in before.items()])
        for name, value in image.items():
            setattr(render.image_settings, name, value)
        for layer in scene.view_layers:
            changed(stack, layer, use=layer.use)
        if engine == EEVEE:
            eevee = scene.eevee
            changed(stack, eevee, use_overscan=True, overscan_size=max(eevee.overscan_size, OVERSCAN),
                    taa_render_samples=samples or eevee.taa_render_samples)  # fmt: skip
        changed(stack, render, engine=engine_name(engine))
        shading = scene.display.shading
        if engine == WORKBENCH and shading.light == "STUDIO":
            changed(stack, shading, use_world_space_lighting=True)
        yield


def _lens(scene, camera: Camera) -> tuple[tuple[LensPoint | None, ...], str]:
    """Return the points of the aperture that are rendered from, and why there is only its center; "" if it has no
    other.
    """
    samples = scene.camera_ray_caster.samples
    if camera.aperture is None:
        return (None,), ""
    why = blur_refusal(camera) or ("" if samples > 1 else ONE_SAMPLE)
    return ((None,), why) if why else (lens_points(camera, samples), "")


def _rendered(scene, active, camera: Camera, face: Face, point, layer, engine: str) -> np.ndarray:
    """Return the pixels of a face, (height, width, 4) float32, row 0 at the bottom."""
    raise_if_stopping()
    used = [other for other in scene.view_layers if other.use]
    path = Path(bpy.app.tempdir) / "face.exr"
    with ExitStack() as stack:
        item = _camera_of(stack, scene, active, camera, face, point)
        for other in used:
            changed(stack, other, use=other == layer)
        (left, right, bottom, top), (width, height) = face.window, face.size
        across, up = (right - left) / width, (top - bottom) / height
        scene.camera, scene.render.filepath = item, str(path)
        scene.render.resolution_x, scene.render.resolution_y = width, height
        scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = max(across / up, 1.0), max(up / across, 1.0)
        with refused_as_input(FAILED.format(engine)):
            bpy.ops.render.render(scene=scene.name, write_still=True)
    raise_if_stopping()
    return _read(path, face, engine)


def _camera_of(stack: ExitStack, scene, active, camera: Camera, face: Face, point: LensPoint | None):
    """Return a camera object that sees a face from a point of the aperture, a child of the scene's camera, until the
    stack is closed.
    """
    data = bpy.data.cameras.new("Face")
    stack.callback(bpy.data.cameras.remove, data)
    item = bpy.data.objects.new("Face", data)
    stack.callback(bpy.data.objects.remove, item)
    scene.collection.objects.link(item)
    stack.callback(setattr, scene, "camera", active)
    left, right, bottom, top = face.window
    width = right - left
    data.sensor_fit, data.sensor_width, data.lens = "HORIZONTAL", SENSOR, SENSOR / width
    data.shift_x, data.shift_y = (left + right) / 2 / width, (bottom + top) / 2 / width
    data.clip_start, data.clip_end = camera.clip_start / face.reach, camera.clip_end
    world = np.eye(4)
    turn = turn_of(camera)
    world[:3, :3], world[:3, 3] = turn @ face.axes.T, camera.pose.eye
    if point is not None:
        world[:3, 3] += turn @ np.array(point.position)
    item.parent = active
    item.matrix_basis = Matrix(np.linalg.inv(np.array(active.matrix_world)) @ world)
    return item


def _read(path: Path, face: Face, engine: str) -> np.ndarray:
    """Return the pixels of a file, which is removed."""
    if not path.is_file():
        raise InputError(FAILED.format(engine) + "see Blender's messages")
    try:
        pixels = pixels_of_file(path)
    finally:
        path.unlink()
    height, width, _ = pixels.shape
    if (width, height) != face.size:
        raise InputError(f"Blender rendered {width} x {height} pixels in place of {face.size}")
    return pixels
