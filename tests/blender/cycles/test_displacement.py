"""True displacement moves the mesh as in Cycles, or the object is named: passes beside those of Cycles."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.records import MESH

from .sure import assert_as_cycles, cast_scene
from .test_same_scenes import added, linked, material


@pytest.fixture
def scene(camera_scene):
    camera_scene.camera.location = 0, 0, 7
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 128, 96
    return camera_scene


def moved(item, method="DISPLACEMENT", **inputs):
    """Give an object a material with a displacement, and return its tree and the node."""
    made, tree, output = material(item)
    linked(tree, "BsdfDiffuse", output.inputs["Surface"])
    made.displacement_method = method
    node = linked(tree, "Displacement", output.inputs["Displacement"])
    for name, value in inputs.items():
        node.inputs[name].default_value = value
    return tree, node


def grid(index, smooth=False, count=24, **options):
    item = added("grid", index, x_subdivisions=count, y_subdivisions=count, **options)
    item.data.polygons.foreach_set("use_smooth", np.full(len(item.data.polygons), smooth))
    return item


def waves(tree, socket):
    """Link an image of waves, as data, to a socket."""
    image = bpy.data.images.new("Waves", 16, 16, float_buffer=True)
    y, x = np.mgrid[:16, :16]
    texels = np.ones((16, 16, 4), np.float32)
    texels[..., :3] = (np.sin(x / 2) * np.cos(y / 3) / 2 + 0.5)[..., None]
    image.colorspace_settings.name = "Non-Color"  # before the texels, which it clears
    image.pixels.foreach_set(texels.ravel())
    image.pack()
    linked(tree, "TexImage", socket).image = image


def test_a_constant_moves_an_exact_plane(scene):
    """It is no exact plane then, nor where the engine would know one."""
    moved(grid(1, size=4), Height=1.0, Midlevel=0.0, Scale=1.0)
    shapes = read_shapes(scene)
    assert list(shapes.kind) == [MESH]
    assert shapes.left_out == ()
    ours = assert_as_cycles(scene)
    assert ours["depth"][48, 64] == pytest.approx(6)


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize("scale", [(1, 1, 1), (1, 0.6, 2)])
def test_an_image_moves_vertices_and_turns_normals(scene, smooth, scale):
    """Also of a mesh in its object's space, under an uneven scale; and of a round one, along its normals."""
    item = grid(1, smooth, size=3, location=(-1, 0, 0), rotation=(0.5, 0.2, 0.3))
    item.scale = scale
    tree, node = moved(item, Midlevel=0.3, Scale=0.7)
    waves(tree, node.inputs["Height"])
    ball = added("uv_sphere", 2, location=(2, 0, 0))
    ball.data.polygons.foreach_set("use_smooth", np.full(len(ball.data.polygons), smooth))
    tree, node = moved(ball, Midlevel=0.0, Scale=0.4)
    waves(tree, node.inputs["Height"])
    shapes = read_shapes(scene)
    flat = shapes.meshes[shapes.mesh[shapes.names.index(item.name)]]
    assert np.ptp(flat.vertices[2]) > 0.5
    ours = assert_as_cycles(scene)
    assert set(np.unique(ours["object_index"])) == {0, 1, 2}


def test_smooth_and_flat_faces_and_two_materials(scene):
    item = grid(1, size=5, count=12)
    moved(item, Midlevel=0.0, Height=0.5, Scale=1.0)
    still = bpy.data.materials.new("Still")
    still.pass_index = 4
    item.data.materials.append(still)
    for polygon in item.data.polygons:
        polygon.use_smooth = polygon.center.y > 0
        polygon.material_index = int(polygon.center.x > 0.3)
    ours = assert_as_cycles(scene, but=() if bpy.app.version >= (5, 2) else ("normal",))  # see core.shapes.displaced
    assert ours["depth"][np.isfinite(ours["depth"])].min() == pytest.approx(6.5)
    assert set(np.unique(ours["material_index"])) == {0, 4}


def test_vectors_move_vertices_any_way(scene):
    item = grid(1, True, size=4, rotation=(0.3, 0.2, 0.4))
    item.scale = 0.8, 1.1, 0.6
    tree, node = moved(item)
    vector = linked(tree, "VectorDisplacement", node.outputs[0].links[0].to_socket)
    vector.space = "OBJECT"
    vector.inputs["Midlevel"].default_value, vector.inputs["Scale"].default_value = 0.2, 0.5
    waves(tree, linked(tree, "CombineXYZ", vector.inputs["Vector"]).inputs["Z"])
    shapes = read_shapes(scene)
    assert shapes.left_out == ()
    assert np.ptp(shapes.meshes[0].vertices[2]) > 0.2
    assert_as_cycles(scene)


def test_both_keeps_the_normals_of_the_mesh(scene):
    """In Cycles the bump turns them, in the shader: the passes but the normal are the same."""
    tree, node = moved(grid(1, smooth=True, size=4), "BOTH", Scale=0.5)
    waves(tree, node.inputs["Height"])
    assert_as_cycles(scene, but=("normal",))
    normal = cast_scene(scene, ("normal", "depth"))
    hit = np.isfinite(normal["depth"])
    np.testing.assert_allclose(normal["normal"][hit][:, 2], 1, atol=1e-6)
    ((name, note),) = read_shapes(scene).notes
    assert name == "Material"
    assert "bump" in note


def noise(tree, node):
    linked(tree, "TexNoise", node.inputs["Height"])


def in_the_world(tree, node):
    node.space = "WORLD"


def tangents(tree, node):
    end = node.outputs[0].links[0].to_socket
    linked(tree, "VectorDisplacement", end).space = "TANGENT"


def turned(tree, node):
    linked(tree, "NewGeometry", node.inputs["Normal"], "Normal")


@pytest.mark.parametrize("change", [noise, in_the_world, tangents, turned])
def test_what_is_not_read_is_named_with_the_object(scene, change):
    item = grid(1, size=4)
    change(*moved(item))
    ((name, reason),) = read_shapes(scene).left_out
    assert name == item.name
    assert reason.startswith("the displacement of its material 'Material' is not read: ")


def test_bump_alone_moves_nothing(scene):
    moved(grid(1, size=4), "BUMP", Height=1.0, Midlevel=0.0)
    ours = assert_as_cycles(scene, but=("normal",))
    assert ours["depth"][48, 64] == pytest.approx(7)
