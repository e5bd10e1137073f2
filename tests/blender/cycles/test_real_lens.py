"""A picture of small lights out of focus through a real lens, beside Cycles' own by the recorded rays."""

import bpy
import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender.cycles import to_cycles
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes

from ...core.lenses.test_aperture import noise, passing
from .cycles import _colors, _nodes, _prepare

pytestmark = pytest.mark.full

WIDTH, HEIGHT, SAMPLES = 144, 96, 128
FAR = 10.0
SIDE = 0.08
"""Of the lights, squares in a wall at the distance FAR: some two pixels if they were sharp."""
PLACES = (-3.2, 0.0, 3.2), (-2.1, 0.0, 2.1)
"""Their columns and rows on the wall: the middle, the edges and the corners of the picture."""


@pytest.fixture
def wall(blender, osl, camera_scene):
    """A black wall with holes before a white sky."""
    edges = [np.concatenate(([-9.0], np.add.outer(side, (-SIDE / 2, SIDE / 2)).ravel(), [9.0])) for side in PLACES]
    columns, rows = (len(each) for each in edges)
    points = [(x, y, 0.0) for y in edges[1] for x in edges[0]]
    faces = [
        (k, k + 1, k + 1 + columns, k + columns)
        for k in (row * columns + column for row in range(rows - 1) for column in range(columns - 1)
                  if row % 2 == 0 or column % 2 == 0)
    ]  # fmt: skip
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata(points, [], faces)
    black = bpy.data.materials.new("Black")
    nodes = _nodes(black)
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (0, 0, 0, 1)
    black.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    mesh.materials.append(black)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Wall", mesh))
    _prepare(camera_scene)
    camera_scene.world = bpy.data.worlds.new("White")
    sky = next(node for node in _nodes(camera_scene.world) if node.type == "BACKGROUND")
    sky.inputs["Color"].default_value = (1, 1, 1, 1)
    camera, data = camera_scene.camera, camera_scene.camera.data
    camera.location, camera.rotation_euler = (0, 0, FAR), (0, 0, 0)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = WIDTH, HEIGHT
    data.camera_ray_caster.model, data.lens = "REAL_LENS", 50.0
    data.dof.use_dof, data.dof.aperture_fstop, data.dof.focus_distance = True, 2.03, 0.6
    return camera_scene


@pytest.mark.parametrize("color", [False, True])
def test_lights_out_of_focus_are_those_of_cycles_within_the_noise(wall, color):
    wall.camera.data.camera_ray_caster.lens_color = color
    camera = read_camera(wall)
    image = crc.cast(camera, read_shapes(wall), passes=("combined",), samples=SAMPLES)["combined"].astype(float)
    to_cycles(wall)
    wall.cycles.samples, wall.cycles.pixel_filter_type, wall.cycles.filter_width = SAMPLES, "BOX", 1.0
    assert (np.ptp(image[..., :3], axis=2).max() > 0) == color
    for ours, theirs in zip(np.moveaxis(image[..., :3], 2, 0), np.moveaxis(_colors(wall), 2, 0), strict=True):
        compare(ours, theirs, (3 if color else 1) / camera.aperture.passing[0])


def compare(ours, theirs, light):
    """A sample has at most this light: the mean v of n of them has at most the variance v light / n."""
    mean = np.maximum((ours + theirs) / 2, 1 / SAMPLES)
    variance = 2 * mean * light / SAMPLES
    lit = (ours > 0) | (theirs > 0)
    assert 250 < lit.sum() < 500  # a disc of 9 pixels in the middle, lenses of 5 x 9 at the edges
    assert np.sqrt(((ours - theirs) ** 2 / variance)[lit].mean()) < 1.1  # 1 for noise, to 1 / sqrt(2 lit.sum())
    for row in range(3):
        for column in range(3):
            tile = slice(32 * row, 32 * row + 32), slice(48 * column, 48 * column + 48)
            away = abs(ours[tile].sum() - theirs[tile].sum())
            assert away < 4 * np.sqrt(variance[tile][lit[tile]].sum()), (row, column)


def test_energy_on_the_axis_and_in_the_corner_is_that_of_the_rays_that_pass(wall):
    """An empty white sky: of each block of pixels, Cycles' light and ours beside a grid of rays through the glass."""
    bpy.data.objects.remove(bpy.data.objects["Wall"])
    wall.render.resolution_x, wall.render.resolution_y = 36, 24
    camera = read_camera(wall)
    model, optics = camera.model, camera.model.optics
    side = np.linspace(-15.0, 15.0, 201)
    target = side[:, None], side, optics.exit_pupil[0]

    def expected(x, y):
        a, b = (float(number) for number in model.window.plane_from_pixels(x, y))
        return passing(optics, (-a, -b, float(model.film)), target, True).sum()

    ours = crc.cast(camera, read_shapes(wall), passes=("combined",), samples=SAMPLES)["combined"][..., 0]
    to_cycles(wall)
    wall.cycles.samples, wall.cycles.pixel_filter_type, wall.cycles.filter_width = SAMPLES, "BOX", 1.0
    theirs = _colors(wall)[..., 0]
    middle = expected(18.0, 12.0)
    for rows, columns in ((slice(10, 14), slice(16, 20)), (slice(0, 4), slice(0, 4)), (slice(20, 24), slice(32, 36))):
        x, y = (np.arange(36)[columns] + 0.5), (np.arange(24)[rows] + 0.5)
        share = np.mean([expected(column, row) for row in y for column in x]) / middle
        for image in (ours, theirs):  # three standard errors of 16 pixels
            assert image[rows, columns].mean() == pytest.approx(share, rel=noise(0.87 * share, 16 * SAMPLES))
