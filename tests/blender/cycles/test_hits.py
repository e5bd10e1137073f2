"""What our rays hit is what Cycles hits: exact spheres, ellipsoids and planes, by position, normal and depth."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS32

from .cycles import cycles_surface

REACH = 16.0
"""More than any coordinate or depth in the scene."""

POSITION = 128 * EPS32
"""The witness stores three coordinates to 1 EPS32 of REACH each, and takes some 12 operations on the distance of 8 at
most. The error lies along the ray, and the more the more the surface is seen edge on: over the cosine."""

SMALLEST = 0.1
"""Radius: a sphere's normal is wrong by the position's error over it."""

FLAT_NORMAL = 8 * EPS32
"""Three edges, a cross product and a division in Cycles, and 1 to store."""

SPHERES, ELLIPSOIDS, PLANES = 1, 2, 3


def add(bpy, name, data, index, parent=None):
    item = bpy.data.objects.new(name, data)
    item.pass_index, item.parent = index, parent
    bpy.context.scene.collection.objects.link(item)
    return item


def add_points(bpy, name, index, rng, count):
    """Add a point cloud, made of a mesh: Blender 4.5 lets a script make no other."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(rng.uniform(-2.5, 2.5, (count, 3)).tolist(), [], [])
    cloud = add(bpy, name, mesh, index)
    with bpy.context.temp_override(object=cloud, active_object=cloud, selected_editable_objects=[cloud]):
        bpy.ops.object.convert(target="POINTCLOUD")
    attributes = cloud.data.attributes
    radius = attributes.get("radius") or attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", rng.uniform(SMALLEST, 0.8, count).astype(np.float32))
    return cloud


@pytest.fixture
def scene(blender):
    rng = np.random.default_rng(5)
    add_points(blender, "Spheres", SPHERES, rng, 14)
    parent = add(blender, "Parent", None, 0)
    parent.rotation_euler, parent.scale = (0.3, 0.8, -0.5), (1, 1.6, 0.7)
    ellipsoids = add_points(blender, "Ellipsoids", ELLIPSOIDS, rng, 8)
    ellipsoids.parent, ellipsoids.rotation_euler, ellipsoids.scale = parent, (0.7, 0.2, 1.1), (1.5, 0.6, 1)
    for turn in range(3):
        mesh = blender.data.meshes.new("Plane")
        mesh.from_pydata([(-2, -1, 0), (2, -1, 0), (2, 1, 0), (-2, 1, 0)], [], [range(4)])
        plane = add(blender, "Plane", mesh, PLANES, parent)
        plane.rotation_euler, plane.location = (turn, 2 * turn, 0.5), (turn - 1, 0.3, 1 - turn)
    scene = blender.context.scene
    scene.camera = add(blender, "Camera", blender.data.cameras.new("Camera"), 0)
    scene.camera.location, scene.camera.rotation_euler = (4, -5, 4), (1.02, 0.1, 0.68)
    scene.camera.data.lens, scene.camera.data.ortho_scale = 40.0, 6.0
    scene.render.resolution_x, scene.render.resolution_y = 96, 64
    return scene


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_hits_are_those_of_cycles(scene, kind):
    scene.camera.data.type = kind
    names = ("position", "normal", "depth", "object_index", "ray_direction")
    ours = cast(read_camera(scene), read_shapes(scene), passes=names, dtype=np.float64)
    position = cycles_surface(scene, "Position", REACH)
    depth = cycles_surface(scene, "View Z Depth", REACH)[..., 0]
    normal = cycles_surface(scene, "Normal", 1.0)
    index = ours["object_index"]
    np.testing.assert_array_equal(index != 0, ~np.isnan(depth))
    cosine = np.abs((ours["normal"] * ours["ray_direction"]).sum(axis=-1))
    away = np.linalg.norm(position - ours["position"], axis=-1) * cosine
    turned = np.linalg.norm(normal - ours["normal"], axis=-1)
    for kind_of_shape in (SPHERES, ELLIPSOIDS, PLANES):
        where = index == kind_of_shape
        assert where.sum() > 200
        assert away[where].max() <= POSITION
        assert (np.abs(depth - ours["depth"]) * cosine)[where].max() <= POSITION
    spheres, planes = index == SPHERES, index == PLANES  # of an ellipsoid Cycles has a wrong normal
    assert (turned * cosine)[spheres].max() <= POSITION / SMALLEST
    assert turned[planes].max() <= FLAT_NORMAL
