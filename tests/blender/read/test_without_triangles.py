"""What is left out where meshes are not cast as triangles."""

import bpy
import pytest

from camera_ray_caster.blender.read import geometry
from camera_ray_caster.blender.read.scene import read_shapes

from .scene_parts import ADD, ball, counts, new_object


@pytest.fixture
def scene(monkeypatch):
    monkeypatch.setattr(geometry, "CAST_MESHES", False)
    return bpy.context.scene


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("cube", "cut deep"),
        ("cylinder", "cut deep"),
        ("cone", "cut deep"),
        ("torus", "not on one sphere"),
        ("monkey", "not on one sphere"),
    ],
)
def test_blenders_other_primitives_are_named_with_the_reason(scene, name, reason):
    getattr(ADD, f"primitive_{name}_add")()
    bpy.context.object.name = "Thing"
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert [item for item, _ in shapes.left_out] == ["Thing"]
    assert reason in shapes.left_out[0][1]


def test_a_disc_is_flat_with_the_wrong_outline(scene):
    ADD.primitive_circle_add(fill_type="NGON")
    assert "outline has 32 corners" in read_shapes(scene).left_out[0][1]


@pytest.mark.parametrize("add", ["curve.primitive_bezier_circle_add", "object.text_add", "object.metaball_add"])
def test_surfaces_that_are_no_mesh_are_named_once(scene, add):
    group, operator = add.split(".")
    getattr(getattr(bpy.ops, group), operator)()
    bpy.context.object.name = "Thing"
    if "curve" in add:
        bpy.context.object.data.bevel_depth = 0.1
    shapes = read_shapes(scene)
    assert len(shapes) == 0
    assert [item for item, _ in shapes.left_out] == ["Thing"]


def test_modifiers_are_applied(scene):
    item = ball()
    modifier = item.modifiers.new("Array", "ARRAY")
    modifier.count = 2
    assert "not on one sphere" in read_shapes(scene).left_out[0][1]
    modifier.count = 1
    assert len(read_shapes(scene)) == 1


@pytest.mark.parametrize("scale", [(0, 0, 0), (1, 0, 1)])
def test_a_matrix_without_size_is_named(scene, scale):
    ball("Good")
    bad = ball("Bad")
    bad.parent = new_object("Parent")
    bad.scale = bad.parent.scale = scale
    shapes = read_shapes(scene)
    assert counts(shapes) == {"Good": 1}
    assert [name for name, _ in shapes.left_out] == ["Bad"]
    assert "size is zero" in shapes.left_out[0][1]
