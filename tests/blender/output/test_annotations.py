"""Categories of objects in annotations."""

import bpy
import pytest

from camera_ray_caster.blender.output.annotations import category_of


@pytest.mark.parametrize(("custom", "category"), [(None, "Data"), ("", "Data"), ("ball", "ball"), (0, "0"), (7, "7")])
def test_a_category_is_the_custom_property_or_else_the_name_of_the_data(custom, category):
    item = bpy.data.objects.new("Item", bpy.data.meshes.new("Data"))
    if custom is not None:
        item["category"] = custom
    assert category_of(item.name) == category
