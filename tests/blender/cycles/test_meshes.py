"""What our rays hit of meshes, curves, texts, metaballs and instances is what Cycles hits: position, normal and map."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.conventions import EPS32

from .cycles import cycles_surface
from .sure import cast_scene, unambiguous

REACH = 16.0
"""More than any coordinate in the scene."""

TEXT = 4
WITH_MAP = 1, 2, 3, 7

POSITION = 128 * EPS32
"""As of spheres and planes: see test_hits."""

THIN = 5e-4
"""A hundredth of a pixel at the distance of 8: what Cycles is off by at most on long thin triangles, as a text's.
"""

TURNED = 2e-4
"""Radians. Blender 5.2 packs normals, to 1e-4; and what moves the point by 2e-5 on triangles of 0.1 that turn by 0.3
moves a smooth normal by 6e-5.
"""

MAPPED = 5e-5
"""Of a map that grows by less than 1 on 0.5, where the point is off by 2e-5."""


def add(bpy, name, data, index, location, turn=(0, 0, 0), scale=(1, 1, 1)):
    item = bpy.data.objects.new(name, data)
    item.pass_index, item.location, item.rotation_euler, item.scale = index, location, turn, scale
    bpy.context.scene.collection.objects.link(item)
    return item


def shaded(mesh, smooth):
    mesh.polygons.foreach_set("use_smooth", np.full(len(mesh.polygons), smooth))
    mesh.update()
    return mesh


def primitive(bpy, name):
    """A mesh of Blender's own."""
    getattr(bpy.ops.mesh, f"primitive_{name}_add")()
    item = bpy.context.object
    mesh = item.data
    bpy.data.objects.remove(item)
    return mesh


@pytest.fixture
def scene(blender):
    scene = blender.context.scene
    data = blender.data
    monkey = add(blender, "Monkey", shaded(primitive(blender, "monkey"), True), 1, (0, 0, 0.4), (0.2, 0.1, 0.5))
    monkey.modifiers.new("Subdivision", "SUBSURF").levels = 1
    monkey.modifiers[0].render_levels = 1
    add(blender, "Cube", primitive(blender, "cube"), 2, (-2.2, 0.5, 0), (0.3, 0.4, 0.5), (0.7, 0.5, 0.9))
    torus = shaded(primitive(blender, "torus"), True)
    add(blender, "Torus", torus, 3, (2.2, 0.3, 0.3), (0.9, 0.2, 0), (0.6, 0.6, 0.6))
    add(blender, "Mirrored", torus, 3, (1.4, -1.6, 0.1), (0.3, 0.2, 0.1), (-0.5, 0.7, 0.4))
    text = data.curves.new("Text", "FONT")
    text.body, text.extrude, text.bevel_depth = "Ray", 0.1, 0.02
    add(blender, "Text", text, TEXT, (-2.6, -2, 0), (0.9, 0, 0.2))
    curve = data.curves.new("Curve", "CURVE")
    curve.dimensions, curve.bevel_depth = "3D", 0.2
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(2)
    for point, location in zip(spline.bezier_points, [(-1, 1, 1), (0, 2, 2), (2, 1, 1.4)], strict=True):
        point.co, point.handle_left_type, point.handle_right_type = location, "AUTO", "AUTO"
    add(blender, "Curve", curve, 5, (0, 0, 0))
    ball = data.metaballs.new("Ball")
    ball.resolution = ball.render_resolution  # what is read is the viewport's, what Cycles renders the render's
    ball.elements.new().co = (0, 0, 0)
    ball.elements.new().co = (0.7, 0, 0.2)
    add(blender, "Metaball", ball, 6, (-0.6, -1.9, -0.9), scale=(0.5, 0.5, 0.5))
    add(blender, "Floor", primitive(blender, "grid"), 7, (0, 0, -1.5), (0.05, 0.02, 0), (6, 6, 6))
    inner = data.collections.new("Inner")
    inner.objects.link(monkey)
    instance = add(blender, "Instances", None, 8, (1.8, 2.2, 0), (0, 0, 2), (0.6, 0.6, 0.9))
    instance.instance_type, instance.instance_collection = "COLLECTION", inner
    scene.camera = add(blender, "Camera", data.cameras.new("Camera"), 0, (4, -5, 4), (1.02, 0.1, 0.68))
    scene.camera.data.lens, scene.camera.data.ortho_scale = 40.0, 6.0
    scene.render.resolution_x, scene.render.resolution_y = 144, 96
    scene.camera_ray_caster.exact_shapes = False
    return scene


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_meshes_are_those_of_cycles(blender, scene, kind):
    scene.camera.data.type = kind
    sure = unambiguous(scene)
    ours = cast_scene(scene, ("position", "normal", "uv", "object_index", "ray_direction"))
    index = ours["object_index"]
    assert set(np.unique(index)) == {0, 1, 2, 3, 4, 5, 6, 7}
    assert sure.mean() > 0.9
    position = cycles_surface(scene, "Position", REACH)
    normal = cycles_surface(scene, "Normal", 1.0)
    uv = cycles_surface(scene, "UV", 1.0)
    np.testing.assert_array_equal((index != 0)[sure], ~np.isnan(position[..., 0])[sure])
    hit = sure & (index != 0)
    cosine = np.abs((ours["normal"] * ours["ray_direction"]).sum(axis=-1))
    away = np.linalg.norm(position - ours["position"], axis=-1)
    turned = np.linalg.norm(normal - ours["normal"], axis=-1)
    thin = index == TEXT
    assert (away * cosine)[hit & ~thin].max() <= POSITION
    assert away[hit & thin].max() <= THIN
    assert turned[hit].max() <= TURNED
    assert np.median(turned[hit]) <= TURNED / 10
    mapped = hit & np.isin(index, WITH_MAP)
    assert np.abs(uv - ours["uv"])[mapped].max() <= MAPPED


def modified(item, kind, **settings):
    modifier = item.modifiers.new(kind, kind)
    for name, value in settings.items():
        setattr(modifier, name, value)


def test_what_modifiers_and_keys_make_is_what_cycles_shows(blender):
    """Keys, an armature, a boolean, an array, a wireframe, a NURBS surface, a mirrored scale, instances on faces."""
    scene, data = blender.context.scene, blender.data
    kinds = "monkey", "cylinder", "cube", "cone", "ico_sphere", "monkey", "monkey"
    keyed, bent, cut, several, wires, mirrored, small = (
        add(
            blender,
            f"{kind} {k}",
            primitive(blender, kind),
            k + 1,
            (3 * (k % 4) - 4.5, 3 * (k // 4) - 1.5, 0),
            (0.5, 0.3, 0.2),
        )
        for k, kind in enumerate(kinds)
    )
    keyed.shape_key_add(name="Basis")
    key = keyed.shape_key_add(name="Wide")
    for point in key.data:
        point.co.x *= 1.5 + point.co.z
    key.value = 0.6
    blender.ops.object.armature_add(location=bent.location)
    bones = blender.context.object
    bones.pose.bones[0].rotation_mode, bones.pose.bones[0].rotation_euler = "XYZ", (0.5, 0.2, 0.3)
    bent.vertex_groups.new(name="Bone").add(range(0, 64, 2), 1, "ADD")
    modified(bent, "ARMATURE", object=bones)
    ball = add(blender, "Cutter", primitive(blender, "uv_sphere"), 0, cut.location, scale=(1.3, 1.3, 1.3))
    ball.hide_render = True
    modified(cut, "BOOLEAN", object=ball)
    several.scale = 0.4, 0.4, 0.4
    modified(several, "ARRAY", count=3, relative_offset_displace=(0.6, 0.5, 0.4))
    modified(wires, "WIREFRAME", thickness=0.1)
    mirrored.scale = -1, 1.2, 0.7
    shaded(mirrored.data, True)
    blender.ops.surface.primitive_nurbs_surface_torus_add(location=(1.5, 1.5, 0))
    blender.context.object.pass_index = 8
    faces = add(blender, "Faces", primitive(blender, "cube"), 9, (4.5, 1.5, 0), (0.2, 0.1, 0.6))
    small.parent, small.scale, faces.instance_type = faces, (0.6, 0.6, 0.6), "FACES"
    scene.camera = add(blender, "Camera", data.cameras.new("Camera"), 0, (0, -5, 12), (0.4, 0, 0))
    scene.camera.data.lens = 36
    scene.render.resolution_x, scene.render.resolution_y = 144, 80
    scene.camera_ray_caster.exact_shapes = False
    sure = unambiguous(scene)
    ours = cast_scene(scene, ("position", "normal", "object_index"))
    assert set(np.unique(ours["object_index"])) == set(range(10))
    position, normal = cycles_surface(scene, "Position", REACH), cycles_surface(scene, "Normal", 1.0)
    index = cycles_surface(scene, "Object Index", REACH)[..., 0]
    hit = sure & (ours["object_index"] != 0)
    np.testing.assert_array_equal(hit[sure], ~np.isnan(index)[sure])
    np.testing.assert_array_equal(np.rint(index)[hit], ours["object_index"][hit])
    away = np.linalg.norm(position - ours["position"], axis=-1)[hit]
    assert away.max() <= THIN
    assert np.median(away) <= POSITION
    assert np.linalg.norm(normal - ours["normal"], axis=-1)[hit].max() <= TURNED


def test_normals_are_interpolated_where_cycles_does(blender):
    """In the mesh's frame where objects share it; in the world where one alone shows it to any ray, or has a material
    slot of its own: under an uneven scale both differ by 0.1.
    """
    blender.ops.mesh.primitive_uv_sphere_add(segments=6, ring_count=4)
    scene, ball = blender.context.scene, shaded(blender.context.object.data, True)
    ball.materials.append(None)
    blender.data.objects.remove(blender.context.object)
    inner = blender.data.collections.new("Inner")
    users = {"Shared 1": ball, "Shared 2": ball, "Own slot": ball, "Unseen": ball.copy(), "Both": ball.copy()}
    users |= {"Alone": users["Unseen"], "Instanced": ball}
    turn, scale = (0.4, 0.3, 0.2), (1, 0.35, 1.6)
    for k, (name, mesh) in enumerate(users.items()):
        item = add(blender, name, mesh, 0, (2.5 * (k % 3) - 2.5, 2.5 * (k // 3) - 2.5, 0), turn, scale)
        if name in ("Own slot", "Instanced"):
            item.material_slots[0].link = "OBJECT"
        if name == "Unseen":
            for ray in ("camera", "diffuse", "glossy", "transmission", "volume_scatter", "shadow"):
                setattr(item, f"visible_{ray}", False)
        if name in ("Both", "Instanced"):
            inner.objects.link(item)
            scene.collection.objects.unlink(item)
    for y in (0, 2.5):
        instance = add(blender, "Instances", None, 0, (0, y, 0))
        instance.instance_type, instance.instance_collection = "COLLECTION", inner
    scene.camera = add(blender, "Camera", blender.data.cameras.new("Camera"), 0, (0, 0, 20))
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 10
    scene.render.resolution_x = scene.render.resolution_y = 96
    scene.camera_ray_caster.exact_shapes = False
    shapes = read_shapes(scene)
    shared = {name: set(shapes.shared[shapes.name_index == k].tolist()) for k, name in enumerate(shapes.names)}
    assert shared == {
        "Shared 1": {True}, "Shared 2": {True}, "Own slot": {False}, "Both": {True}, "Alone": {False},
        "Instanced": {True},
    }  # fmt: skip
    sure = unambiguous(scene)
    ours = cast_scene(scene, ("normal", "shape_index"))
    hit = sure & (ours["shape_index"] >= 0)
    assert len(np.unique(ours["shape_index"][hit])) == len(shapes)
    assert np.abs(cycles_surface(scene, "Normal", 1.0) - ours["normal"])[hit].max() <= TURNED
