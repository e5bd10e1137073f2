"""Small scenes of what people really have, whose passes are those of Cycles at every unambiguous pixel."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene import read_shapes

from .sure import assert_as_cycles


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
