"""The material and the world of a view layer, which stand in for all others, are those of Cycles."""

import numpy as np

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from ..read.scene_parts import plain
from .cycles import cycles_passes

WORLD = 0.25, 0.5, 0.75


def painted(data, index):
    material = data.materials.new(f"Material {index}")
    material.pass_index = index
    return material


def test_one_material_and_world_for_a_view_layer(blender):
    """Over a mesh of two materials, one without any and an exact sphere."""
    scene, ops = blender.context.scene, blender.ops.mesh
    ops.primitive_monkey_add(location=(-2, 0, 0))
    for index in (1, 2):
        blender.context.object.data.materials.append(painted(blender.data, index))
    blender.context.object.data.polygons.foreach_set("material_index", np.arange(500) % 2)
    ops.primitive_cube_add(location=(2, 0, 0))
    ops.primitive_ico_sphere_add(subdivisions=5, location=(0, 2, 0))
    blender.context.object.data.materials.append(painted(blender.data, 3))
    scene.camera = blender.data.objects.new("Camera", blender.data.cameras.new("Camera"))
    scene.collection.objects.link(scene.camera)
    scene.camera.location.z = 12
    scene.render.resolution_x, scene.render.resolution_y = 48, 32
    layer = blender.context.view_layer
    layer.material_override = plain("Override", (0.5, 0.25, 0.125, 1), 7)
    layer.world_override = blender.data.worlds.new("World")
    layer.world_override.color = WORLD
    if blender.app.version >= (5, 0):
        layer.world_override.node_tree.nodes["Background"].inputs["Color"].default_value[:3] = WORLD
    shapes = read_shapes(scene)
    assert shapes.slots is None
    np.testing.assert_array_equal(shapes.color, [(0.5, 0.25, 0.125, 1)] * 3)
    images = cast(read_camera(scene), shapes, passes=("combined", "material_index"))
    combined, index = cycles_passes(scene)
    np.testing.assert_array_equal(images["material_index"], index)
    assert set(np.unique(index)) == {0, 7}
    behind = index == 0
    np.testing.assert_array_equal(images["combined"][behind, :3], combined[behind])
