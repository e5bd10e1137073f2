"""Cycles as an independent reference for any model: the points where a camera's shader rays hit a box around it.

A separate scene has a custom camera with the shader, and a box whose faces emit the position of the hit as a color.
Each pixel of its picture takes one sample in its middle. The picture is larger or smaller than the render, so that its
rays lie between the render's pixels as well as on them.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import bpy
import numpy as np
from mathutils import Matrix

from ...core.camera.camera import Camera
from ...core.conventions import EPS32
from ...core.records import Finding, InputError
from ...core.report.sample import angles_between, finding, length_of, not_compared
from ...core.shaders.camera_shader import CameraShader, camera_shader
from ...core.shaders.shader_accuracy import ray_bounds
from ..cycles.shader import check_cycles, set_shader, texture_folder
from ..read.texels import pixels_of_file

CYCLES = "Cycles"

LONGER_SIDE = 288
"""Size of the picture's longer side in pixels."""

ROOM = 64.0
"""Half the side of the box in Blender units, times the largest offset of a ray's origin from the eye if over 1."""

STORED = 4 * EPS32
"""Error of a stored place, as a fraction of half the box's side: it is stored in 24 bits of four times half the side,
after two computations and one rounding.
"""

STEP = 2.0**-4
"""Distance in pixels between neighboring rays, whose angle converts an error in radians to pixels."""


def cycles_finding(camera: Camera) -> Finding:
    """Return the finding on the rays of a camera's shader in Cycles, over the full frame, at one time.

    Pixels for which float32 leaves open whether there is a ray are not compared. Any other pixel fails (NaN) if only
    one of camera and Cycles has a ray. If pixels exceed their own bounds, only the worst pixel is reported. Raises
    InputError if this Blender has no Cycles or no OSL.
    """
    camera = replace(camera, pixel_time=None, aperture=None)
    shift = tuple(float(camera.settings.get(name, 0.0)) for name in ("shift_x", "shift_y"))
    shader = camera_shader(camera, "PERSP", shift, folder=texture_folder())
    shader = replace(shader, source=shader.source.partition("\n")[2])  # without its mark, so that it is not updated
    return compared(camera, shift, lambda center, half, size: _ends(camera, shader, shift, center, half, size))


def compared(camera: Camera, shift: tuple[float, float], ends_of) -> Finding:
    """Return the finding on a camera; ``ends_of(center, half, size)`` returns the points where rays hit the box."""
    full_size = np.array(camera.model.size)
    size = np.maximum(np.rint(full_size * (LONGER_SIDE / full_size.max())), 1).astype(int)
    x, y = ((np.arange(count) + 0.5) * (side / count) for count, side in zip(size, full_size, strict=True))
    x, y = x[None, :], y[:, None]
    rays, bounds = camera.rays_at(x, y), ray_bounds(camera, x, y, shift)
    eye = camera.pose.eye
    half = ROOM * max(1.0, float(np.nanmax(np.abs(rays.origins - eye))))
    ends = ends_of(eye, half, size.tolist())
    decided = ~np.isinf(bounds.direction)
    if not (decided & rays.valid).any():
        return not_compared(CYCLES, "float32 cannot represent these rays")
    differs = decided & (rays.valid == np.isnan(ends[..., 0]))
    is_compared = decided & (rays.valid | differs)
    pixels = np.stack(np.broadcast_arrays(x, y), axis=-1)[is_compared]
    path = (ends - rays.origins)[is_compared]
    distance = length_of(path)
    angles = angles_between(path / distance[:, None], rays.directions[is_compared])
    bound = bounds.direction[is_compared] + (bounds.origin[is_compared] + STORED * half) / distance
    turned = _turned(camera, pixels, rays.origins[is_compared], rays.directions[is_compared], distance)
    worst = np.argmax(np.where(np.isnan(angles), np.inf, angles / bound))
    selected = slice(None) if angles[worst] <= bound[worst] else [worst]  # each pixel has its own bound
    errors = np.stack((angles / turned, np.zeros_like(angles)), axis=1)[selected]
    return finding(CYCLES, errors, angles[selected], (bound / turned)[selected], bound[selected], (0.0, 0.0))


def _turned(camera: Camera, pixels, origins, directions, distance) -> np.ndarray:
    """Return the smallest angle, (n,), in radians per pixel, by which a ray's end moves as seen from its origin."""
    moves = []
    for step in STEP * np.concatenate((np.eye(2), -np.eye(2))):
        near = camera.rays_at(*(pixels + step).T)
        moves.append(length_of((near.origins - origins) / distance[:, None] + (near.directions - directions)) / STEP)
    return np.fmin.reduce(moves)


def _ends(camera: Camera, shader: CameraShader, shift, center, half: float, size) -> np.ndarray:
    """Return the world points where the rays of a shader hit the box, an axis-aligned cube, (height, width, 3) float64.

    Pixels without a ray are NaN.
    """
    check_cycles()
    with _witness_scene(camera, shader, shift, center, half, size) as scene, TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "witness.exr")
        bpy.ops.render.render(write_still=True, scene=scene.name)
        path = Path(scene.render.filepath)
        if not path.exists():
            raise InputError("Cycles returned no pixels: render the scene with Cycles to see the reason")
        values = pixels_of_file(path)[..., :3].astype(np.float64)
    values[(values == 0).all(axis=-1)] = np.nan
    return center + (values - 0.5) * (4 * half)


@contextmanager
def _witness_scene(camera: Camera, shader: CameraShader, shift, center, half: float, size) -> Iterator:
    """Yield a scene with the camera and the box; remove all new data-blocks afterwards."""
    made = []

    def new(collection, *arguments):
        made.append((collection, item := collection.new(*arguments)))
        return item

    try:
        scene = new(bpy.data.scenes, "Camera Ray Caster Witness")
        data, parent = new(bpy.data.cameras, "Witness"), new(bpy.data.objects, "Witness", None)
        item = new(bpy.data.objects, "Witness", data)
        item.parent = parent
        item.matrix_parent_inverse = Matrix(camera.world_from_camera.tolist())  # the matrix may be sheared
        mesh, material = new(bpy.data.meshes, "Witness"), new(bpy.data.materials, "Witness")
        mesh.from_pydata((center + half * CORNERS).tolist(), [], FACES)
        mesh.materials.append(material)
        box = new(bpy.data.objects, "Witness", mesh)
        for linked in (item, parent, box):
            scene.collection.objects.link(linked)
        scene.camera, scene.world = item, None
        _emit_position(material, center, half)
        data.shift_x, data.shift_y = shift
        data.clip_start, data.clip_end = half / 1024, 8 * half
        set_shader(data, shader)
        made.insert(0, (bpy.data.texts, data.custom_shader))
        _set_up(scene, size)
        yield scene
    finally:
        for collection, item in reversed(made):
            collection.remove(item)


CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))


def _emit_position(material, center, half: float) -> None:
    """Make a material emit the position of the hit: its offset from the center / (4 half) + 0.5."""
    if bpy.app.version < (5, 0):
        material.use_nodes = True  # from 5.0 on every material has nodes
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    names = "ShaderNodeNewGeometry", "ShaderNodeVectorMath", "ShaderNodeVectorMath"
    geometry, beside, scaled = (nodes.new(name) for name in names)
    shader, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    beside.operation, scaled.operation = "SUBTRACT", "MULTIPLY_ADD"
    beside.inputs[1].default_value = center
    scaled.inputs[1].default_value, scaled.inputs[2].default_value = [0.25 / half] * 3, [0.5] * 3
    links.new(geometry.outputs["Position"], beside.inputs[0])
    links.new(beside.outputs[0], scaled.inputs[0])
    links.new(scaled.outputs[0], shader.inputs["Color"])
    links.new(shader.outputs[0], output.inputs["Surface"])


def _set_up(scene, size) -> None:
    """Set a scene to one sample in the middle of each pixel, written as float32."""
    render, cycles, image = scene.render, scene.cycles, scene.render.image_settings
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = size
    render.use_compositing = render.use_sequencer = False
    image.file_format, image.color_depth, image.color_mode, image.exr_codec = "OPEN_EXR", "32", "RGB", "ZIP"
    cycles.device = "CPU"
    cycles.samples, cycles.max_bounces, cycles.filter_width = 1, 0, 0.01
    cycles.use_adaptive_sampling = cycles.use_denoising = False
