"""Indices beside Cycles where it is not plain which material or object a face has: slots, and faces that coincide."""

import bpy
import numpy as np
import pytest

from .cycles import cycles_truth
from .sure import NEAR, assert_as_cycles, cast_scene


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


@pytest.mark.parametrize("instances", [False, pytest.param(True, marks=pytest.mark.full)])
@pytest.mark.parametrize("other", [0, *(pytest.param(k, marks=pytest.mark.full) for k in (1, 2, 3))])
def test_nodes_make_a_mesh_of_fewer_or_more_materials(scene, other, instances):
    """In Blender 5.2 the slots are those of the mesh that is seen; in earlier versions also those of the object."""
    looks = [bpy.data.materials.new(f"Material {k}") for k in range(7)]
    for index, material in enumerate(looks):
        material.pass_index = 10 + index
    bpy.ops.mesh.primitive_monkey_add(size=3, location=(0, 50, 0))
    source, item = bpy.context.object, bpy.data.objects.new("Nodes", bpy.data.meshes.new("Nodes"))
    scene.collection.objects.link(item)
    for face in source.data.polygons:
        face.material_index = face.index % 4
    for material in looks[:other]:
        source.data.materials.append(material)
    for slot, material in enumerate(looks[4:6]):
        item.data.materials.append(looks[6])
        item.material_slots[slot].link, item.material_slots[slot].material = "OBJECT", material
    group = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
    group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    info, end = group.nodes.new("GeometryNodeObjectInfo"), group.nodes.new("NodeGroupOutput")
    info.inputs["Object"].default_value = source
    made = info.outputs["Geometry"]
    if instances:
        instance = group.nodes.new("GeometryNodeGeometryToInstance")
        group.links.new(made, instance.inputs[0])
        made = instance.outputs[0]
    group.links.new(made, end.inputs[0])
    item.modifiers.new("Nodes", "NODES").node_group = group
    ours = assert_as_cycles(scene)
    expected = {14, 15} if bpy.app.version < (5, 2, 0) else {10 + 4 + slot for slot in range(min(other, 2))} or {0}
    assert expected <= set(np.unique(ours["material_index"]))


@pytest.mark.parametrize("first", [1, pytest.param(2, marks=pytest.mark.full)])
def test_of_faces_that_coincide_the_first_is_met(scene, first):
    """In Cycles it may be any of them: there the indices of pixels differ, and nothing else does."""
    for index in (first, 3 - first):
        bpy.ops.mesh.primitive_monkey_add(size=3)
        bpy.context.object.pass_index = index
        bpy.context.object.name = f"{'AB'[index == first]}{index}"  # the order of names is not that of rows
    ours, theirs = cast_scene(scene, ("object_index", "depth")), cycles_truth(scene)
    hit = np.isfinite(ours["depth"]) & (np.abs(ours["depth"] - theirs["depth"]) < NEAR)
    assert hit.sum() > 100
    assert set(np.unique(ours["object_index"][hit])) == {first}
    assert set(np.unique(theirs["object_index"][hit])) <= {1, 2}
