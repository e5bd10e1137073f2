"""Material slots beside Cycles: which material a face has where slots are linked to objects, empty or missing."""

import bpy
import numpy as np
import pytest

from .sure import assert_as_cycles


@pytest.fixture
def scene(camera_scene):
    camera = camera_scene.camera
    camera.location, camera.rotation_euler = (0, -5, 0), (1.5708, 0, 0)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 64, 48
    camera_scene.camera_ray_caster.exact_shapes = False
    return camera_scene


def test_an_empty_slot_of_the_object(scene):
    """In Blender 5.2 it has no material; in earlier versions the mesh's material."""
    bpy.ops.mesh.primitive_monkey_add(size=3)
    monkey = bpy.context.object
    for index in (12, 7):
        material = bpy.data.materials.new("Material")
        material.pass_index = index
        monkey.data.materials.append(material)
    for face in list(monkey.data.polygons)[::2]:
        face.material_index = 1
    monkey.material_slots[0].link = "OBJECT"
    ours = assert_as_cycles(scene)
    assert {0, 7} <= set(np.unique(ours["material_index"]))
    assert (12 in ours["material_index"]) == (bpy.app.version < (5, 2, 0))
