"""Linked objects and materials with the names of local ones have names of their own: in indices and in annotations."""

import bpy
import pytest

from camera_ray_caster.blender.output.annotations import category_of
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.blender.read.unique import find_unique, unique_name
from camera_ray_caster.core.annotations.coco import Sheet, document
from camera_ray_caster.core.report.indices import indices_of

from .scene_parts import mesh_of, new_object


@pytest.fixture
def linked(camera_scene, tmp_path):
    """A local monkey, and monkeys of two libraries whose files have the same name; only the first has a cone."""
    camera_scene.camera.location.z = 10
    bpy.ops.mesh.primitive_monkey_add(size=2)
    monkey = bpy.context.object
    monkey.name, monkey.pass_index = "Monkey", 3
    monkey.data.materials.append(bpy.data.materials.new("Fur"))
    cone = new_object("Cone", mesh_of((0, 0, 0)))
    for name in ("one", "two"):
        path = tmp_path / name / "zoo.blend"
        path.parent.mkdir()
        monkey["category"] = name
        bpy.data.libraries.write(str(path), {monkey, cone} if name == "one" else {monkey})
    bpy.data.objects.remove(cone)
    monkey["category"] = "here"
    monkey.location.x = 3
    for name in ("one", "two"):
        with bpy.data.libraries.load(str(tmp_path / name / "zoo.blend"), link=True) as (there, here):
            here.objects = there.objects
        for item in here.objects:
            bpy.context.collection.objects.link(item)
    return camera_scene


NAMES = "Monkey", "Monkey [zoo.blend]", "Monkey [zoo.blend.001]"


def test_names_of_linked_objects_are_their_own(linked):
    assert {unique_name(item, bpy.data.objects) for item in bpy.data.objects} == {"Camera", "Cone", *NAMES}
    assert [find_unique(name, bpy.data.objects).name_full for name in NAMES] == [*NAMES]
    assert find_unique("Cone", bpy.data.objects).name_full == "Cone [zoo.blend]"
    assert find_unique("Cone [zoo.blend]", bpy.data.objects) is None
    assert [category_of(name) for name in NAMES] == ["here", "one", "two"]


def test_indices_and_annotations_have_them(linked):
    shapes = read_shapes(linked)
    indices = indices_of(shapes)
    assert sorted(indices["object_index"]["3"]) == sorted(NAMES)
    assert sorted(run["object"] for run in indices["shape_index"]) == sorted(NAMES)
    assert sorted(indices["material_index"]["0"]) == ["Fur", "Fur [zoo.blend.001]", "Fur [zoo.blend]"]
    coco = document({"file_name": "a.png"}, Sheet(8, 8), read_camera(linked), shapes, category_of)
    objects = {entry["object"]: entry["category_id"] for key in ("annotations", "hidden") for entry in coco[key]}
    names = {category["id"]: category["name"] for category in coco["categories"]}
    assert [names[objects[name]] for name in NAMES] == ["here", "one", "two"]
