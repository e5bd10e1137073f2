"""The record of a mesh: triangles, normals, uv and materials, against what Blender itself says of each of them."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read import mesh_reading
from camera_ray_caster.blender.read.scene_reader import read_shapes

from .scene_parts import ADD, geometry_nodes, new_object, plain


@pytest.fixture
def scene():
    return bpy.context.scene


def monkey(levels=0):
    ADD.primitive_monkey_add()
    item = bpy.context.object
    if levels:
        item.modifiers.new("Subdivision", "SUBSURF").levels = levels
    return item


def evaluated(item):
    """The evaluated mesh of an object."""
    mesh = item.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    mesh.calc_loop_triangles()
    return mesh


def record(scene):
    (mesh,) = read_shapes(scene).meshes
    return mesh


def by_corner(values, mesh):
    """Values at the loops of the record, (l, m), as (triangles, corners, m)."""
    return values[mesh.loops].transpose(1, 0, 2)


@pytest.mark.parametrize("levels", [0, 2])
@pytest.mark.parametrize("triangulated", [False, True])
def test_triangles_and_polygons_are_blenders(scene, levels, triangulated):
    item = monkey(levels)
    if triangulated:
        item.modifiers.new("Triangulate", "TRIANGULATE")
    mesh, truth = record(scene), evaluated(item)
    np.testing.assert_array_equal(mesh.vertices.T, [vertex.co for vertex in truth.vertices])
    np.testing.assert_array_equal(mesh.triangles.T, [triangle.vertices for triangle in truth.loop_triangles])
    np.testing.assert_array_equal(mesh.polygon, [triangle.polygon_index for triangle in truth.loop_triangles])
    np.testing.assert_array_equal(mesh.loops.T, [triangle.loops for triangle in truth.loop_triangles])
    for array in (mesh.vertices, mesh.triangles, mesh.loops, mesh.uv):
        assert array.flags.c_contiguous
    assert (mesh.triangles.dtype, mesh.polygon.dtype) == (np.int32, np.int32)


@pytest.mark.parametrize("name", ["loop_start", "loop_total", "material_index"])
def test_what_is_copied_in_one_piece_is_what_blender_says_of_each(scene, name):
    """Also of a property that does not lie where its member does, which the last one's value tells."""
    truth = evaluated(monkey(1))
    expected = [getattr(polygon, name) for polygon in truth.polygons]
    np.testing.assert_array_equal(mesh_reading.copied(truth.polygons, name, np.int32), expected)


def smooth(item):
    item.data.shade_smooth()


def some_flat(item):
    item.data.shade_smooth()
    for polygon in list(item.data.polygons)[::3]:
        polygon.use_smooth = False


def sharp_edges(item):
    item.data.shade_smooth()
    for edge in list(item.data.edges)[::5]:
        edge.use_edge_sharp = True


def custom(item):
    item.data.shade_smooth()
    turned = [(corner.vector + corner.vector.yzx * 0.5).normalized() for corner in item.data.corner_normals]
    item.data.normals_split_custom_set(turned)


def custom_by_vertex(item):
    item.data.shade_smooth()
    turned = [(normal.vector + normal.vector.yzx * 0.5).normalized() for normal in item.data.vertex_normals]
    item.data.normals_split_custom_set_from_vertices(turned)


def custom_on_flat_faces(item):
    turned = [(corner.vector + corner.vector.yzx * 0.5).normalized() for corner in item.data.corner_normals]
    item.data.normals_split_custom_set(turned)


def free(domain):
    """Normals of any length, as geometry nodes may set them."""

    def shade(item):
        item.data.shade_smooth()

        def build(new, link, mesh):
            node, vectors = new("GeometryNodeSetMeshNormal"), new("FunctionNodeRandomValue")
            node.mode, node.domain, vectors.data_type = "FREE", domain, "FLOAT_VECTOR"
            vectors.inputs[0].default_value, vectors.inputs[1].default_value = (-3, -3, -3), (3, 3, 3)
            link(mesh, node.inputs[0])
            link(vectors.outputs[0], node.inputs["Custom Normal"])
            return node.outputs[0]

        geometry_nodes(item, build)

    shade.__name__ = f"free_{domain}"
    return shade


def free_among_flat_faces(item):
    free("POINT")(item)
    some_flat(item)


SHADINGS = (
    free_among_flat_faces,
    smooth,
    some_flat,
    sharp_edges,
    custom,
    custom_by_vertex,
    custom_on_flat_faces,
    free("POINT"),
    free("CORNER"),
)


def by_blender(mesh):
    """The unit normals of the loops, (l, 3); those that were set freely Blender 4.5 and 5.0 hand over after freeing."""
    free = mesh.attributes.get("custom_normal")
    if free is None or free.data_type != "FLOAT_VECTOR":
        return np.array([corner.vector for corner in mesh.corner_normals])
    normals = np.array([each.vector for each in free.data])
    normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    if free.domain == "CORNER":
        return normals
    return np.array([
        normals[mesh.loops[loop].vertex_index] if polygon.use_smooth else polygon.normal
        for polygon in mesh.polygons for loop in polygon.loop_indices
    ])  # fmt: skip


@pytest.mark.parametrize("with_uv", [True, False])
@pytest.mark.parametrize("shade", SHADINGS, ids=lambda shade: shade.__name__)
def test_normals_are_blenders_at_every_corner(scene, shade, with_uv):
    item = monkey()
    shade(item)
    if not with_uv:
        item.data.uv_layers.remove(item.data.uv_layers[0])
    mesh, truth = record(scene), evaluated(item)
    normals = by_blender(truth)
    loops = np.array([triangle.loops for triangle in truth.loop_triangles])
    np.testing.assert_allclose(by_corner(mesh.normals, mesh), normals[loops], atol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-6)
    assert (mesh.uv is None) != with_uv


def test_flat_faces_among_smooth_ones_have_their_own_normal(scene):
    """Blender 5.2's rule, by the faces themselves."""
    item = monkey()
    some_flat(item)
    mesh, truth = record(scene), evaluated(item)
    corners = by_corner(mesh.normals, mesh)
    flat = np.array([not polygon.use_smooth for polygon in truth.polygons])[mesh.polygon]
    faces = np.array([polygon.normal for polygon in truth.polygons])[mesh.polygon]
    assert 0 < flat.sum() < len(flat)
    np.testing.assert_allclose(corners[flat], np.repeat(faces[flat][:, None], 3, axis=1), atol=1e-6)
    assert np.abs(corners[~flat] - faces[~flat][:, None]).max() > 0.1


def test_a_mesh_of_flat_faces_has_no_normals_by_corner(scene):
    item = monkey()
    assert record(scene).normals is None
    item.data.uv_layers.remove(item.data.uv_layers[0])
    item.data.update()  # of which Blender tells nobody by itself
    assert record(scene).loops is None


@pytest.mark.parametrize("domain", ["POINT", "FACE"])
def test_normals_that_are_set_freely_count_for_nothing_on_flat_faces(scene, domain):
    item = monkey()
    free(domain)(item)
    item.data.shade_flat()
    assert record(scene).normals is None


def test_uv_is_the_map_that_renders_use(scene):
    item = monkey()
    layers = item.data.uv_layers
    other = layers.new(name="Other")
    rng = np.random.default_rng(3)
    other.uv.foreach_set("vector", rng.random(2 * len(item.data.loops)).astype(np.float32))
    layers.active = layers[0]
    other.active_render = True
    mesh, truth = record(scene), evaluated(item)
    uv = np.array([tuple(corner.vector) for corner in truth.uv_layers["Other"].uv], np.float32)
    np.testing.assert_array_equal(mesh.uv, uv)
    layers[0].active_render = True
    assert not np.array_equal(record(scene).uv, uv)


def materials(count):
    return [plain(f"Material {k}", (k / 8, 0.5, 0.25, 1), 10 + k) for k in range(count)]


def looks(shapes, row):
    """Pass index and color of each triangle of a row, as the record says."""
    mesh = shapes.meshes[shapes.mesh[row]]
    first = -1 if shapes.slots is None else shapes.slots.first[row]
    if first < 0 or mesh.slot is None:
        return [shapes.material_index[row]] * len(mesh), [tuple(shapes.color[row])] * len(mesh)
    at = first + mesh.slot
    return shapes.slots.material_index[at].tolist(), list(map(tuple, shapes.slots.color[at]))


def test_each_face_has_the_material_of_its_slot(scene):
    """Empty slots, slots linked to the object, faces of a slot that is not there; another object shares the mesh."""
    first, second, third = materials(3)
    item = monkey()
    for material in (first, None, second):
        item.data.materials.append(material)
    chosen = np.random.default_rng(4).integers(0, 5, len(item.data.polygons))
    item.data.attributes.new("material_index", "INT", "FACE").data.foreach_set("value", chosen.astype(np.int32))
    other = new_object("Other", item.data)
    other.material_slots[2].link = "OBJECT"
    other.material_slots[2].material = third
    shapes = read_shapes(scene)
    assert len(shapes.meshes) == 1
    polygon = shapes.meshes[0].polygon
    for row in range(2):
        last = third if shapes.names[shapes.name_index[row]] == "Other" else second
        expected = [(10, tuple(first.diffuse_color)), (0, (0.8, 0.8, 0.8, 1))]
        expected += [(last.pass_index, tuple(last.diffuse_color))] * 3
        indices, colors = looks(shapes, row)
        assert indices == [expected[k][0] for k in chosen[polygon]]
        np.testing.assert_allclose(colors, [expected[k][1] for k in chosen[polygon]], atol=1e-7)


def test_a_mesh_of_one_material_needs_no_slots(scene):
    first, second = materials(2)
    monkey().data.materials.append(first)
    many = monkey()
    for material in (first, second):
        many.data.materials.append(material)
    many.name = "Many"
    shapes = read_shapes(scene)
    assert shapes.slots is None  # no face uses the second one
    assert list(shapes.material_index) == [10, 10]
    many.data.polygons[0].material_index = 1
    shapes = read_shapes(scene)
    names = [shapes.names[k] for k in shapes.name_index]
    assert [first >= 0 for first in shapes.slots.first] == [name == "Many" for name in names]
    assert sorted(set(looks(shapes, names.index("Many"))[0])) == [10, 11]


def test_materials_that_geometry_nodes_set(scene):
    (paint,) = materials(1)

    def build(new, link, mesh):
        cube, node = new("GeometryNodeMeshCube"), new("GeometryNodeSetMaterial")
        node.inputs["Material"].default_value = paint
        link(cube.outputs[0], node.inputs[0])
        return node.outputs[0]

    geometry_nodes(monkey(), build)
    shapes = read_shapes(scene)
    assert looks(shapes, 0)[0] == [10] * 12


def test_a_holdout_is_a_hole_in_every_slot(scene):
    item = monkey()
    for material in materials(2):
        item.data.materials.append(material)
    item.data.polygons[0].material_index = 1
    item.is_holdout = True
    shapes = read_shapes(scene)
    assert not shapes.slots.color.any()
    assert not shapes.color.any()
    assert list(shapes.slots.material_index) == [10, 11]
