"""What has not changed is not read again, and what has changed is: counted by the meshes that are read."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read import shape_cache
from camera_ray_caster.blender.read.scene_reader import read_shapes

from .scene_parts import ADD, geometry_nodes, in_a_render, mesh_of, new_collection, new_object, paint, plain
from .time_scene import drive, key


@pytest.fixture
def scene():
    return bpy.context.scene


@pytest.fixture
def handlers():
    """A function that adds a handler, until the test is over."""
    added = []

    def add(name, function):
        getattr(bpy.app.handlers, name).append(function)
        added.append((getattr(bpy.app.handlers, name), function))

    yield add
    for handlers, function in added:
        if function in handlers:
            handlers.remove(function)


def cube(name, **options):
    ADD.primitive_cube_add(**options)
    bpy.context.object.name = bpy.context.object.data.name = name
    return bpy.context.object


def height(shapes, name):
    """The largest z of the first row of an object, in its own space."""
    row = [shapes.names[k] for k in shapes.name_index].index(name)
    return shapes.meshes[shapes.mesh[row]].vertices[2].max()


@pytest.fixture
def objects(scene, read_meshes):
    """Of every kind; all are read once."""
    items = {name: cube(name) for name in ("Plain", "Modified", "Shaped")}
    items["Modified"].modifiers.new("Bevel", "BEVEL")
    items["Shaped"].shape_key_add()
    items["Shaped"].shape_key_add().data[0].co.z = 3
    bpy.ops.object.text_add()
    items["Text"] = bpy.context.object
    bpy.ops.object.metaball_add()
    items["Ball"] = bpy.context.object
    collection = new_collection("Collection")
    items["Inside"] = new_object("Inside", cube("Inner").data, collection)
    items["Empty"] = new_object("Empty")
    items["Empty"].instance_type, items["Empty"].instance_collection = "COLLECTION", collection

    def scatter(new, link, mesh):
        cone, scattered = new("GeometryNodeMeshCone"), new("GeometryNodeInstanceOnPoints")
        link(mesh, scattered.inputs["Points"])
        link(cone.outputs[0], scattered.inputs["Instance"])
        return scattered.outputs[0]

    items["Scattered"] = new_object("Scattered", mesh_of((40, 0, 0), (41, 0, 0)))
    geometry_nodes(items["Scattered"], scatter)
    read_shapes(scene)
    assert len(read_meshes) >= 8
    read_meshes.clear()
    return items


def test_what_moves_is_not_read_again(scene, objects, read_meshes):
    before = read_shapes(scene)
    for name in objects.keys() - {"Ball"}:  # a metaball's surface is another one wherever it goes
        objects[name].location.x += 1
        objects[name].rotation_euler.z += 1
    after = read_shapes(scene)
    assert read_meshes == []
    assert not np.array_equal(before.center, after.center)
    assert before.meshes == after.meshes  # the same records, one by one


def test_colors_materials_and_the_camera_are_nothing_to_a_mesh(scene, objects, read_meshes):
    material = plain("Material", (1, 0, 0, 1))
    objects["Plain"].data.materials.append(material)
    read_shapes(scene)
    read_meshes.clear()
    material.pass_index = 5
    paint(material, (0, 1, 0, 1))
    shapes = read_shapes(scene)
    assert read_meshes == []
    assert 5 in shapes.material_index
    assert (0, 1, 0, 1) in list(map(tuple, shapes.color))


CHANGES = {
    "a vertex": ("Plain", lambda item: setattr(item.data.vertices[0].co, "z", 9)),
    "vertices in bulk": ("Plain", lambda item: item.data.vertices.foreach_set("co", np.full(24, 9, np.float32))),
    "a modifier": ("Modified", lambda item: setattr(item.modifiers[0], "width", 0.3)),
    "a key's value": ("Shaped", lambda item: setattr(item.data.shape_keys.key_blocks[1], "value", 0.5)),
    "a text": ("Text", lambda item: setattr(item.data, "body", "other")),
    "a metaball": ("Ball", lambda item: setattr(item.data.elements[0], "radius", 3)),
    "what a collection shows": ("Inside", lambda item: setattr(item.data.vertices[0].co, "z", 9)),
    "nodes": (
        "Scattered",
        lambda item: setattr(item.modifiers[0].node_group.nodes["Cone"].inputs["Vertices"], "default_value", 5),
    ),
    "shading": ("Plain", lambda item: item.data.shade_smooth()),
    "the render UV map": ("Plain", lambda item: setattr(item.data.uv_layers.new(), "active_render", True)),
    "a face's material": ("Plain", lambda item: setattr(item.data.polygons[0], "material_index", 3)),
    "other data": ("Plain", lambda item: setattr(item, "data", item.data.copy())),
    "a setting": ("Plain", lambda item: setattr(item.camera_ray_caster, "primitive", "MESH")),
}


@pytest.mark.parametrize("change", CHANGES)
def test_what_changes_is_read_again_and_nothing_else(scene, objects, read_meshes, change):
    name, act = CHANGES[change]
    act(objects[name])
    read_shapes(scene)
    assert len(read_meshes) in (1, 2)  # an instancer has a mesh of its own
    read_meshes.clear()
    read_shapes(scene)
    assert read_meshes == []


def test_frames_have_read_again_what_they_deform(scene, objects, read_meshes):
    item = objects["Shaped"]
    drive(item.data.shape_keys.key_blocks[1], "value", -1, "(frame - 1) / 10")
    key(objects["Plain"], "location", (1, 0.0), (11, 5.0), index=0)
    scene.frame_set(1)
    read_shapes(scene)
    read_meshes.clear()
    for frame, z in ((9, 2.2), (11, 3), (1, 1)):
        scene.frame_set(frame)
        assert height(read_shapes(scene), "Shaped") == pytest.approx(z)
    assert set(read_meshes) == {"Shaped"}


@pytest.mark.parametrize("hide", ["hide_set", "hide_viewport", "exclude"])
def test_what_was_deformed_while_it_was_hidden(scene, objects, read_meshes, hide):
    item = objects["Shaped"]
    drive(item.data.shape_keys.key_blocks[1], "value", -1, "(frame - 1) / 10")
    scene.frame_set(1)

    def set_hidden(hidden):
        if hide == "hide_set":
            item.hide_set(hidden)
        elif hide == "hide_viewport":
            item.hide_viewport = hidden
        else:
            bpy.context.view_layer.layer_collection.children["Away"].exclude = hidden

    new_collection("Away", scene.collection).objects.link(item)
    scene.collection.objects.unlink(item)
    assert height(read_shapes(scene), "Shaped") == 1
    set_hidden(True)
    bpy.context.view_layer.update()
    scene.frame_set(11)
    set_hidden(False)
    assert height(read_shapes(scene), "Shaped") == 3


def test_undo_and_another_file(scene, objects, read_meshes, tmp_path):
    bpy.ops.ed.undo_push(message="before")
    objects["Plain"].data.vertices[7].co.z = 9
    bpy.ops.ed.undo_push(message="after")
    assert height(read_shapes(bpy.context.scene), "Plain") == 9
    bpy.ops.ed.undo()
    assert height(read_shapes(bpy.context.scene), "Plain") == 1
    bpy.ops.ed.redo()
    assert height(read_shapes(bpy.context.scene), "Plain") == 9
    path = str(tmp_path / "file.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    read_meshes.clear()
    assert height(read_shapes(bpy.context.scene), "Plain") == 9
    assert len(read_meshes) >= 8


def test_what_is_edited_is_read_each_time_and_its_neighbors_are_not(scene, objects, read_meshes):
    for item in bpy.context.selected_objects:
        item.select_set(False)
    bpy.context.view_layer.objects.active = objects["Plain"]
    bpy.ops.object.mode_set(mode="EDIT")
    read_shapes(scene)
    for z in (2, 3):
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.transform.translate(value=(0, 0, 1))
        read_meshes.clear()
        assert height(read_shapes(scene), "Plain") == z
        assert len(read_meshes) == 1
    bpy.ops.object.mode_set(mode="OBJECT")
    assert height(read_shapes(scene), "Plain") == 3


def test_while_an_object_is_sculpted_all_is_read_each_time(scene, objects, read_meshes):
    bpy.context.view_layer.objects.active = objects["Plain"]
    bpy.ops.object.mode_set(mode="SCULPT")
    for _ in range(2):
        read_meshes.clear()
        read_shapes(scene)
        assert len(read_meshes) >= 8
    bpy.ops.object.mode_set(mode="OBJECT")


@pytest.mark.parametrize("event", ["depsgraph_update_post", "frame_change_post"])
def test_what_a_handler_changes_after_all_were_told_is_read(scene, objects, read_meshes, handlers, event):
    """Blender evaluates once more then, and tells nobody."""

    def change(*_):
        objects["Plain"].data.vertices[7].co.z = objects["Modified"].location.x

    handlers(event, change)
    for x in (5, 7):
        objects["Modified"].location.x = x
        bpy.context.view_layer.update() if event.startswith("depsgraph") else scene.frame_set(x)
        assert height(read_shapes(scene), "Plain") == x


def test_a_handler_that_takes_itself_away_again(scene, objects, read_meshes, handlers):
    def change(*_):
        bpy.app.handlers.depsgraph_update_post.remove(change)
        objects["Plain"].data.vertices[7].co.z = 4

    bpy.app.handlers.depsgraph_update_post.insert(0, change)
    objects["Modified"].location.x = 1
    bpy.context.view_layer.update()
    assert change not in bpy.app.handlers.depsgraph_update_post
    assert height(read_shapes(scene), "Plain") == 4


def test_where_handlers_were_cleared_all_is_read(scene, objects, read_meshes):
    before = list(bpy.app.handlers.depsgraph_update_post)
    bpy.app.handlers.depsgraph_update_post.clear()
    try:
        objects["Plain"].data.vertices[7].co.z = 4
        assert height(read_shapes(scene), "Plain") == 4
    finally:
        bpy.app.handlers.depsgraph_update_post.extend(before)
    assert height(read_shapes(scene), "Plain") == 4


def test_without_registration_all_is_read_and_the_same_triangles_are_the_same_record(
    scene, objects, read_meshes, unregister
):
    unregister()
    first = read_shapes(scene)
    read_meshes.clear()
    second = read_shapes(scene)
    assert len(read_meshes) >= 8
    assert first.meshes == second.meshes


def test_a_render_reads_its_own_and_shares_nothing_stale_with_the_window(scene, objects, read_meshes):
    modifier = objects["Modified"].modifiers[0]
    modifier.show_render = False
    for z in (2, 3):
        objects["Plain"].data.vertices[7].co.z = z
        rendered = in_a_render(scene)
        assert height(rendered, "Plain") == height(read_shapes(scene), "Plain") == z
        rows = [rendered.names[k] for k in rendered.name_index]
        assert len(rendered.meshes[rendered.mesh[rows.index("Modified")]]) == 12
    read_meshes.clear()
    in_a_render(scene)
    assert len(read_meshes) >= 8


def test_a_render_of_several_times_has_read_again_what_deforms(scene, objects, read_meshes):
    """As for a camera whose pixels have each their own time."""
    drive(objects["Shaped"].data.shape_keys.key_blocks[1], "value", -1, "(frame - 1) / 10")
    scene.frame_set(1)
    in_a_render(scene)
    once = len(read_meshes)
    rendered = in_a_render(scene, (9, 10, 11))
    assert height(rendered, "Shaped") == 3
    assert read_meshes[2 * once :] == ["Shaped"] * 3


def test_memory_holds_what_the_last_reading_has_used(scene, objects):
    for name in ("Plain", "Text", "Scattered"):
        bpy.data.objects.remove(objects[name])
    shapes = read_shapes(scene)
    held = {entry.mesh for entries in shape_cache._entries.values() for entry in entries.values()} - {None}
    assert held == set(shapes.meshes)
