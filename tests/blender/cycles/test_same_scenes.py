"""Small scenes of what people really have, whose passes are those of Cycles at every unambiguous pixel."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.records import MESH, SPHERE

from .cycles import cycles_truth
from .sure import NEAR, PASSES, assert_as_cycles, cast_scene


@pytest.fixture
def scene(camera_scene):
    camera = camera_scene.camera
    camera.location, camera.rotation_euler = (0, -8, 3), (1.257, 0, 0)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 160, 120
    camera_scene.camera_ray_caster.exact_shapes = False
    return camera_scene


def added(make, index=0, **options):
    getattr(bpy.ops.mesh, f"primitive_{make}_add")(**options)
    bpy.context.object.pass_index = index
    return bpy.context.object


def material(item, name="Material"):
    """Give an object a material without nodes but the output; return it, its tree and the output."""
    material_data = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0):
        material_data.use_nodes = True
    material_data.node_tree.nodes.clear()
    item.data.materials.append(material_data)
    return material_data, material_data.node_tree, material_data.node_tree.nodes.new("ShaderNodeOutputMaterial")


def linked(tree, kind, socket, output=0):
    """Return a new node whose output is linked to a socket."""
    node = tree.nodes.new(f"ShaderNode{kind}")
    tree.links.new(node.outputs[output], socket)
    return node


def ground():
    return added("plane", 9, size=20, location=(0, 0, -0.5))


@pytest.mark.parametrize("exact", [False, True])
@pytest.mark.parametrize("make", ["cube", "uv_sphere"])
def test_flat_instances_of_a_shared_mesh_are_not_shown(scene, make, exact):
    """But a mesh with one user is, and one that a rotated parent leaves almost flat."""
    scene.camera_ray_caster.exact_shapes = exact
    for name, x in (("Flat", -3), ("Whole", -1)):
        item = added(make, 1, location=(x, 0, 0.5))
        item.name = name
    flat = bpy.data.objects["Flat"]
    flat.data, flat.scale = item.data, (1, 1, 0)
    alone = added(make, 2, location=(1.5, 0, 0.5))
    alone.name, alone.scale, alone.rotation_euler = "Alone", (1, 0, 1), (0.3, 0.2, 0.4)
    if not exact:  # an exact plane's and sphere's depth is not that of the mesh to NEAR
        ground()
        ours = assert_as_cycles(scene, but=("uv",))  # the sides of the flat one coincide
        assert set(np.unique(ours["object_index"])) == {0, 1, 2, 9}
    shapes = read_shapes(scene)
    assert sorted(shapes.names) == ["Alone", *(["Plane"] if not exact else []), "Whole"]
    assert [name for name, _ in shapes.notes] == ["Flat"]
    assert shapes.left_out == ()


def test_an_object_that_only_a_render_shows_is_named(scene):
    hidden = added("monkey", size=2, location=(0, 0, 1))
    hidden.hide_viewport = True
    ground()
    shapes = read_shapes(scene)
    assert list(shapes.names) == ["Plane"]
    assert [name for name, _ in shapes.left_out] == [hidden.name]


def test_overlapping_duplicates(scene):
    """Where faces coincide either may be met; everything but the index is the same there."""
    for k, x in enumerate((0, 0.7), 1):
        added("cube", k, size=2, location=(x, 0, 1))
    assert_as_cycles(scene, but=("object_index", "uv"))


def fog(item):
    """Give an object a volume that absorbs. One that scatters ends some of Cycles' rays at random."""
    _, tree, output = material(item, "Fog")
    linked(tree, "VolumeAbsorption", output.inputs["Volume"])
    return tree, output


@pytest.mark.parametrize("exact", [False, True])
def test_a_box_of_fog_hides_nothing(scene, exact):
    scene.camera_ray_caster.exact_shapes = exact
    added("monkey", 1, size=2, location=(0, 0, 0.5))
    fog(added("cube", 2, size=6))
    fog(added("ico_sphere", 3, radius=4, subdivisions=4))
    ours = assert_as_cycles(scene)
    assert set(np.unique(ours["object_index"])) == {0, 1}
    assert dict(read_shapes(scene).left_out).keys() == {"Fog", "Fog.001"}


def empty_reroute(tree, output):
    tree.links.new(tree.nodes.new("NodeReroute").outputs[0], output.inputs["Surface"])


def muted_surface(tree, output):
    linked(tree, "BsdfDiffuse", output.inputs["Surface"]).mute = True


def muted_volume(tree, output):
    output.inputs["Volume"].links[0].from_node.mute = True


def surface_too(tree, output):
    linked(tree, "BsdfDiffuse", output.inputs["Surface"])


def other_output(tree, output):
    output.target = "EEVEE"
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    end.target = "CYCLES"
    surface_too(tree, end)


@pytest.mark.parametrize(
    ("change", "is_seen"),
    [(empty_reroute, False), (other_output, True), (muted_volume, True), (surface_too, True), (muted_surface, False)],
)
def test_what_is_a_volume_without_a_surface(scene, change, is_seen):
    change(*fog(added("cube", 1, size=2)))
    added("cube", 2, size=3, location=(0, 2, 0))
    ours = assert_as_cycles(scene)
    assert (1 in ours["object_index"]) == is_seen


def test_some_faces_of_a_mesh_may_be_fog(scene):
    item = added("cube", 1, size=3)
    fog(item)
    material(item, "Solid")
    for polygon in item.data.polygons:
        polygon.material_index = int(polygon.normal.y > -0.5)
    ours = assert_as_cycles(scene)
    assert 1 in ours["object_index"]


def test_bumps_are_noted_and_the_normals_are_the_mesh_s(scene):
    for k, kind in enumerate(("Bump", "NormalMap", "Displacement"), 1):
        item = added("cube", k, location=(2.5 * k - 5, 0, 0))
        made, tree, output = material(item, kind)
        surface = linked(tree, "BsdfPrincipled", output.inputs["Surface"])
        node = linked(tree, kind, output.inputs["Displacement"] if kind == "Displacement" else surface.inputs["Normal"])
        linked(tree, "TexNoise", node.inputs["Color" if kind == "NormalMap" else "Height"])
        made.displacement_method = "BUMP"
    material(added("cube", 4, location=(5, 0, 0)), "Plain")
    assert_as_cycles(scene, but=("normal",))
    ours = cast_scene(scene, ("normal", "object_index"))
    assert np.abs(ours["normal"][ours["object_index"] > 0]).max(axis=-1).min() > 1 - 1e-6
    shapes = read_shapes(scene)
    assert {name for name, note in shapes.notes if "bump" in note} == {"Bump", "NormalMap", "Displacement"}


def test_a_holdout_is_noted_and_keeps_its_passes(scene):
    monkey = added("monkey", 1, size=2, location=(0, 0, 1))
    ground()
    before = cast_scene(scene, PASSES)
    monkey.is_holdout = True
    after = cast_scene(scene, (*PASSES, "combined"))
    for name in PASSES:
        np.testing.assert_array_equal(after[name], before[name])
    assert (after["combined"][after["object_index"] == 1] == 0).all()
    ((name, note),) = read_shapes(scene).notes
    assert name == monkey.name
    assert note.startswith("it is a holdout")


def test_hair_is_named(scene):
    item = added("uv_sphere", 1, location=(0, 0, 1))
    item.modifiers.new("Hair", "PARTICLE_SYSTEM").particle_system.settings.type = "HAIR"
    assert [name for name, _ in read_shapes(scene).left_out] == [item.name]


def test_a_texture_is_seen_through_the_map_of_the_mesh(scene):
    """An ico sphere's map is not that of an exact sphere: with a texture it is cast as its mesh."""
    scene.camera_ray_caster.exact_shapes = True
    texels = np.ones((8, 8, 4), np.float32)
    texels[::2, ::2, 3] = texels[1::2, 1::2, 3] = 0
    image = bpy.data.images.new("Holes", 8, 8, alpha=True)
    image.pixels.foreach_set(texels.ravel())
    image.pack()
    item = added("ico_sphere", 1, subdivisions=4, radius=2, location=(0, 0, 1))
    _, tree, output = material(item)
    surface = linked(tree, "BsdfPrincipled", output.inputs["Surface"])
    texture = linked(tree, "TexImage", surface.inputs["Alpha"], "Alpha")
    texture.image, texture.interpolation = image, "Closest"
    shapes = read_shapes(scene)
    assert list(shapes.kind) == [MESH]
    assert [name for name, note in shapes.notes if "cast as opaque" not in note] == []
    ours, theirs = cast_scene(scene, ("depth",))["depth"], cycles_truth(scene)["depth"]
    assert 0.1 < np.isfinite(ours).mean() < 0.5
    assert (np.abs(ours - theirs) > NEAR)[np.isfinite(ours)].mean() < 0.005  # at edges of texels
    texture.image = None
    surface.inputs["Alpha"].default_value = 1
    tree.links.clear()
    tree.links.new(surface.outputs[0], output.inputs["Surface"])
    assert list(read_shapes(scene).kind) == [SPHERE]
