"""What is kept from one reading to the next, held against a fresh reading over random edits, with undo and redo."""

from dataclasses import fields
from random import Random

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read import read_shapes, scene_cache, shape_cache
from camera_ray_caster.core.motion.means import same

from .scene_parts import ADD, new_collection, new_object

EDITS = 60


def meshes(chance):
    return chance.choice([item for item in bpy.context.scene.objects if item.type == "MESH"])


def add(chance):
    getattr(ADD, f"primitive_{chance.choice(('cube', 'monkey', 'ico_sphere', 'grid', 'uv_sphere'))}_add")()
    bpy.context.object.location = [chance.uniform(-3, 3) for _ in range(3)]


def move(chance):
    item = chance.choice(list(bpy.context.scene.objects))
    setattr(item, chance.choice(("location", "rotation_euler", "scale")), [chance.uniform(0.2, 3) for _ in range(3)])


def move_a_vertex(chance):
    mesh = meshes(chance).data
    mesh.vertices[chance.randrange(len(mesh.vertices))].co.z += chance.uniform(-1, 1)
    mesh.update()


def move_a_map(chance):
    mesh = meshes(chance).data
    if not mesh.uv_layers or chance.random() < 0.3:
        mesh.uv_layers.new()
    layer = chance.choice(list(mesh.uv_layers))
    layer.active_render = True
    layer.data[chance.randrange(len(layer.data))].uv.x += 0.5  # before 5.2, by ``layer.uv`` copies would move, too
    mesh.update()


def smooth(chance):
    meshes(chance).data.shade_smooth() if chance.random() < 0.5 else meshes(chance).data.shade_flat()


def materials(chance):
    item = meshes(chance)
    if chance.random() < 0.5 or not item.data.materials:
        item.data.materials.append(bpy.data.materials.new("Material"))
    face = chance.choice(list(item.data.polygons))
    face.material_index = chance.randrange(3)
    chance.choice(list(item.data.materials)).pass_index = chance.randrange(9)
    item.pass_index, item.material_slots[0].link = chance.randrange(9), chance.choice(("DATA", "OBJECT"))
    item.data.update()


def modifiers(chance):
    item = meshes(chance)
    if item.modifiers and chance.random() < 0.6:
        modifier = chance.choice(list(item.modifiers))
        if chance.random() < 0.5:
            item.modifiers.remove(modifier)
        else:
            modifier.show_viewport = not modifier.show_viewport
    else:
        item.modifiers.new("Modifier", chance.choice(("BEVEL", "ARRAY", "MIRROR", "SOLIDIFY")))


def duplicate(chance):
    item = meshes(chance)
    copy = item.copy()
    if chance.random() < 0.5:
        copy.data = item.data.copy()
    copy.location.x += 2
    bpy.context.scene.collection.objects.link(copy)


def swap(chance):
    item, other = meshes(chance), meshes(chance)
    item.data = other.data


def remove(chance):
    if len([item for item in bpy.context.scene.objects if item.type == "MESH"]) > 2:
        bpy.data.objects.remove(meshes(chance))


def layers(chance):
    collection = bpy.data.collections["Collection"]
    layer = bpy.context.view_layer.layer_collection.children["Collection"]
    item = meshes(chance)
    way = chance.randrange(5)
    if way == 0:
        layer.exclude = not layer.exclude
    elif way == 1:
        collection.hide_render = not collection.hide_render
    elif way == 2:
        collection.hide_viewport = not collection.hide_viewport
    elif way == 3:
        item.hide_render = not item.hide_render
    elif item.name in collection.objects:
        collection.objects.unlink(item)
    else:
        collection.objects.link(item)


def cast_as(chance):
    meshes(chance).camera_ray_caster.primitive = chance.choice(("AUTOMATIC", "MESH", "SPHERE", "IGNORE"))


def exactness(chance):
    settings = bpy.context.scene.camera_ray_caster
    settings.exact_shapes = not settings.exact_shapes


def edit_mode(chance):
    bpy.context.view_layer.objects.active = item = meshes(chance)
    if item.visible_get():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.translate(value=(0, 0, 0.5))
        read_shapes(bpy.context.scene)
        bpy.ops.object.mode_set(mode="OBJECT")


def undo(chance):
    for step in range(chance.randrange(1, 4)):
        way = bpy.ops.ed.undo if step < 2 or chance.random() < 0.5 else bpy.ops.ed.redo
        if way.poll():
            way()


WAYS = (add, move, move_a_vertex, move_a_map, smooth, materials, modifiers, duplicate, swap, remove, layers, cast_as,
        exactness, edit_mode, undo, undo)  # fmt: skip


def fresh(depsgraph):
    """The shapes as if nothing were kept; what is kept stays."""
    before = dict(shape_cache._entries)
    shape_cache._entries.clear()
    try:
        return scene_cache.shapes_record(depsgraph)
    finally:
        shape_cache._entries.clear()
        shape_cache._entries.update(before)


def differing(left, right):
    """The names of the fields in which two records differ."""
    names = []
    for name in (field.name for field in fields(left)):
        first, second = getattr(left, name), getattr(right, name)
        if name == "meshes":
            equal = len(first) == len(second) and all(map(same, first, second))
        elif isinstance(first, np.ndarray):
            equal = np.array_equal(first, second, equal_nan=first.dtype.kind == "f")
        elif hasattr(first, "__dataclass_fields__"):
            equal = not differing(first, second)
        else:
            equal = first == second
        if not equal:
            names.append(name)
    return names


@pytest.mark.full
@pytest.mark.parametrize("seed", range(12))
def test_what_is_kept_is_what_is_read_afresh(camera_scene, seed):
    """In the window, which draws ``cached_scene``, and for ``read_shapes``; the exact order of edits is the message."""
    chance, done = Random(seed), []
    camera_scene.collection.children.link(new_collection("Collection"))
    empty = new_object("Empty")
    empty.instance_type, empty.instance_collection = "COLLECTION", bpy.data.collections["Collection"]
    for _ in range(3):
        add(chance)
    bpy.ops.ed.undo_push(message="begin")
    for _ in range(EDITS):
        way = chance.choice(WAYS)
        way(chance)
        done.append(way.__name__)
        if way is not undo:
            bpy.ops.ed.undo_push(message=way.__name__)
        bpy.context.view_layer.update()
        if chance.random() < 0.3:
            continue  # several edits at once
        shown = scene_cache.cached_scene(bpy.context).shapes
        shapes = read_shapes(bpy.context.scene)
        expected = fresh(bpy.context.evaluated_depsgraph_get())
        assert differing(shapes, expected) == [], done
        assert differing(shown, expected) == [], done
