"""EEVEE's and Workbench's pictures through camera models, beside Cycles' of the same model by its shader in OSL."""

from contextlib import suppress

import bpy
import numpy as np
import pytest
from numpy.lib.stride_tricks import sliding_window_view

from camera_ray_caster import InputError, cast_rays, read_camera, read_shapes
from camera_ray_caster.blender.cycles.cycles_picture import picture_of as cycles_picture
from camera_ray_caster.blender.faces.driver import check_driver
from camera_ray_caster.blender.faces.engine_picture import EEVEE, WORKBENCH
from camera_ray_caster.blender.faces.engine_picture import picture_of as faces_picture
from camera_ray_caster.core.faces.faces import SIDES, faces_of, turn_of
from camera_ray_caster.core.faces.resample import FINER, resampled

from ..processes import ROOT

pytestmark = pytest.mark.full
MODELS = "DOME_MASTER", "OMNIMAX", "CYLINDRICAL", "FISHEYE_STEREOGRAPHIC", "FISHEYE_ORTHOGRAPHIC", "UCM"
SAMPLES = 16
"""Of Cycles in a pixel, which tell whether it shows a single object."""
LEVELS = np.linspace(0.0, 1.0, 6)
COLORS = np.stack(np.meshgrid(LEVELS, LEVELS, LEVELS), axis=-1).reshape(-1, 3)
"""Colors of objects; the first is that of nothing."""
PURE = 1e-3
SQUARES = 8
"""Of a checker along a quarter turn; with 100 pixels across 180 degrees as many pixels a square as 16 with 200."""
PARTS = 8
MIXED = -1


@pytest.fixture(autouse=True)
def engines(osl):
    """Cycles with OSL, and something that draws."""
    try:
        check_driver("Blender")
    except InputError as error:
        pytest.skip(str(error))


def only(picture):
    """The pixels of the only view layer and view."""
    return next(iter(picture.pixels.values()))


def nodes_of(block):
    """The empty node tree of a material, which each has from Blender 5.0 on."""
    if bpy.app.version < (5, 0):
        block.use_nodes = True
    block.node_tree.nodes.clear()
    return block.node_tree.nodes, block.node_tree.links


def emitting(name, color):
    """A material that emits a color, or what ``color`` makes of its nodes, and draws as the color in Workbench."""
    material = bpy.data.materials.new(name)
    nodes, links = nodes_of(material)
    shader, target = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    links.new(shader.outputs[0], target.inputs["Surface"])
    material.diffuse_color = shader.inputs["Color"].default_value = (*color, 1.0)
    return material


def flat(scene, kind):
    """Have Workbench draw the colors of materials, or their pictures, as they are; no light, world or denoising."""
    shading, cycles, render = scene.display.shading, scene.cycles, scene.render
    shading.light, shading.color_type = "FLAT", kind
    shading.show_cavity = shading.show_object_outline = shading.show_shadows = False
    scene.display.render_aa, render.filter_size = "OFF", 0.0  # the middle of each texel
    scene.world, render.film_transparent = None, True
    cycles.pixel_filter_type, cycles.samples, cycles.max_bounces = "BOX", SAMPLES, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False


def painted(name):
    """A scene of the gallery whose objects have one emitted color each."""
    bpy.ops.wm.open_mainfile(filepath=str(ROOT / "blend_scenes" / f"{name}.blend"))
    scene = bpy.context.scene
    flat(scene, "MATERIAL")
    items = [item for item in bpy.data.objects if hasattr(item.data, "materials")]
    for number, item in enumerate(items):
        material = emitting(item.name, COLORS[1 + number % (len(COLORS) - 1)])
        if not item.material_slots:
            item.data.materials.append(None)
        for slot in item.material_slots:
            with suppress(AttributeError):
                slot.link = "OBJECT"
            slot.material = material
    for item in scene.objects:
        item.hide_render |= item.type == "LIGHT"
    scene.render.resolution_x, scene.render.resolution_y = 160, 120
    return scene


def nearest(pixels):
    """The index of the color of each pixel."""
    return np.argmin([np.abs(pixels[..., :3] - color).max(axis=-1) for color in COLORS], axis=0)


def index_map(pixels):
    """The index of the color of each pixel, MIXED where it is none."""
    index = nearest(pixels)
    return np.where(np.abs(pixels[..., :3] - COLORS[index]).max(axis=-1) < PURE, index, MIXED)


def inside(index):
    """Where a pixel and the eight around it have the same color."""
    windows = sliding_window_view(np.pad(index, 1, constant_values=MIXED), (3, 3))
    low = windows.min(axis=(2, 3))
    return (low == windows.max(axis=(2, 3))) & (low > MIXED)


@pytest.mark.parametrize(("name", "engine", "models"), [
    ("living_room", WORKBENCH, MODELS[::2]), ("toys", WORKBENCH, MODELS[1::2]),
    ("toys", EEVEE, MODELS[::3]), ("living_room", EEVEE, MODELS[1:2]),
])  # fmt: skip
def test_edges_are_within_a_pixel_of_those_of_cycles(blender, name, engine, models):
    scene = painted(name)
    for model in models:
        scene.camera.data.camera_ray_caster.model = model
        cycles, drawn = only(cycles_picture(scene)), only(faces_picture(scene, engine, samples=1))
        shown, drawn_index = index_map(cycles), index_map(drawn)
        assert inside(shown).mean() > 0.2
        assert (nearest(drawn) == shown)[inside(shown)].all(), model
        assert (nearest(drawn) == shown)[inside(drawn_index) & (shown != MIXED)].all(), model


def checker(scene):
    """A ball around the camera of 5 squares a radian, black and white."""
    at, sides = np.tan((np.arange(SQUARES + 1) / SQUARES - 0.5) * np.pi / 2), []
    for axes in SIDES:
        points = np.stack((*np.meshgrid(at, at), -np.ones((SQUARES + 1,) * 2)), axis=-1) @ axes
        sides.append(points / np.linalg.norm(points, axis=-1, keepdims=True))
    row, column, side = np.meshgrid(*(np.arange(count) for count in (SQUARES, SQUARES, len(SIDES))), indexing="ij")
    first = ((side * (SQUARES + 1) + row) * (SQUARES + 1) + column).ravel()
    mesh = bpy.data.meshes.new("Checker")
    corners = first[:, None] + (0, 1, SQUARES + 2, SQUARES + 1)
    mesh.from_pydata(4 * np.reshape(sides, (-1, 3)), [], corners.tolist())
    for index, color in enumerate(COLORS[[0, -1]]):
        mesh.materials.append(emitting(f"Square {index}", color))
        mesh.materials[index].pass_index = index
    mesh.polygons.foreach_set("material_index", ((row + column) % 2).ravel().astype(np.int32))
    mesh.update()
    item = bpy.data.objects.new("Checker", mesh)
    item.rotation_euler = 0.2, 0.3, 0.4
    scene.collection.objects.link(item)


def white(origin, directions, shapes):
    """How white the checker is in directions."""
    origins = np.broadcast_to(origin, directions.shape)
    return cast_rays(origins, directions, shapes, passes=("material_index",))["material_index"]


def of_the_filter(camera, shapes):
    """The picture that the resampling makes of faces whose texels are means of PARTS x PARTS places."""
    faces, turn, pictures = faces_of(camera, 1 / FINER), turn_of(camera), []
    for face in faces:
        left, right, bottom, top = face.window
        (width, height), inner = face.size, (np.arange(PARTS) + 0.5) / PARTS
        x, y = (np.add.outer(np.arange(count), inner).ravel() / count for count in face.size)
        x, y = np.meshgrid(left + x * (right - left), bottom + y * (top - bottom))
        directions = np.stack((x, y, -np.ones_like(x)), axis=-1) @ face.axes @ turn.T
        directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
        seen = white(camera.pose.eye, directions, shapes).reshape(height, PARTS, width, PARTS)
        pictures.append(seen.mean(axis=(1, 3), dtype=np.float32)[..., None])
    return resampled(camera, faces, pictures)[..., 0]


def test_a_checker_is_as_sharp_as_the_filter(blender, camera_scene):
    """Beside Cycles' mean over each pixel. A texel is a single sample in place of a mean, and the four that count most
    in a pixel weigh so that the error is twice that of the filter at most: 1.7 and 1.8 times were measured.
    """
    scene, render = camera_scene, camera_scene.render
    checker(scene)
    flat(scene, "MATERIAL")
    render.resolution_x = render.resolution_y = 100
    scene.camera.data.type, scene.camera.data.panorama_type = "PANO", "FISHEYE_EQUIDISTANT"
    scene.camera.data.fisheye_fov, scene.cycles.samples = np.pi, 256
    camera, shapes = read_camera(scene), read_shapes(scene)
    cycles, middle = only(cycles_picture(scene))[..., 0], np.arange(100) - 49.5
    inner = np.hypot(middle, middle[:, None]) < 49  # whole squares have rays

    def error(picture):
        off = np.abs(picture - cycles)[inner]
        return np.array((off.mean(), np.quantile(off, 0.99)))

    least = error(of_the_filter(camera, shapes))
    scene.render.filter_size = 1.5
    for engine, samples in ((WORKBENCH, 0), (EEVEE, 4)):
        off = error(only(faces_picture(scene, engine, samples=samples))[..., 0])
        print(f"{engine}: mean {off[0]:.4f}, 99th percentile {off[1]:.4f}; filter {least[0]:.4f}, {least[1]:.4f}")
        assert (off < 2 * least).all()
