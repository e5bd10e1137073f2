"""The uv pass of exact shapes is the mesh's render UV map where they can have it: beside Cycles' UV pass."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_shapes
from camera_ray_caster.core.records import MESH, PLANE, SPHERE

from .sure import MAPPED, assert_as_cycles, cast_scene, unambiguous


@pytest.fixture
def scene(camera_scene):
    camera = camera_scene.camera
    camera.location, camera.rotation_euler = (0, -8, 3), (1.257, 0, 0)
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 160, 120
    return camera_scene


def added(make, name, **options):
    getattr(bpy.ops.mesh, f"primitive_{make}_add")(**options)
    bpy.context.object.name = name
    return bpy.context.object


def remap(item, change):
    for entry in item.data.uv_layers.active.data:
        entry.uv = change(*entry.uv)


def unmapped(item):
    item.data.uv_layers.remove(item.data.uv_layers[0])
    item.data.update_tag()  # Blender does not do it


def kinds(scene):
    shapes = read_shapes(scene)
    return {shapes.names[k]: kind for k, kind in zip(shapes.name_index, shapes.kind.tolist(), strict=True)}


def test_planes_have_the_map_of_the_mesh_or_none(scene):
    remap(added("plane", "Five times", size=4, location=(-2.2, 0, 0)), lambda u, v: (v * 5, u * 5))
    plain = added("plane", "No map", size=4, location=(2.2, 0, 0))
    unmapped(plain)
    several = added("grid", "Second map", x_subdivisions=3, y_subdivisions=2, size=3, location=(0, 4, 1))
    several.rotation_euler = 1, 0.3, 0.4
    several.data.uv_layers.new(name="Shown").active_render = True
    several.data.uv_layers.active = several.data.uv_layers["Shown"]
    remap(several, lambda u, v: (0.2 * u - 0.7 * v + 3, 0.4 * v - 2))
    bent = added("plane", "Bent map", size=2, location=(0, -4, 0))
    remap(bent, lambda u, v: (u * v, v))
    assert kinds(scene) == {"Five times": PLANE, "No map": PLANE, "Second map": PLANE, "Bent map": MESH}
    assert read_shapes(scene).notes == ()
    ours = assert_as_cycles(scene, mapped=5 / 4 * MAPPED)
    assert ours["uv"][..., 0].max() > 3.5
    assert ours["uv"][..., 1].min() < -1.5


@pytest.mark.full
def test_spheres_have_longitude_and_latitude_or_no_map(scene):
    """The map of Blender's UV sphere is longitude and latitude, that of its ico sphere is named."""
    known = added("uv_sphere", "Known", segments=256, ring_count=128, location=(-2.2, 0, 1))
    none = added("uv_sphere", "None", location=(0, 0, 1))
    unmapped(none)
    added("ico_sphere", "Other", subdivisions=4, location=(2.2, 0, 1))
    known.rotation_euler = known.scale = 1.2, 0.8, 0.7
    shapes = read_shapes(scene)
    assert set(shapes.kind) == {SPHERE}
    ((name, note),) = shapes.notes
    assert name == "Other"
    assert "UV map" in note
    for k, item in enumerate((known, none), 1):
        item.pass_index = k
    ours = cast_scene(scene, ("uv", "position", "object_index", "depth"))
    where = ours["object_index"]
    assert (ours["uv"][where == 2] == 0).all()
    scene.camera_ray_caster.exact_shapes = False
    sure = unambiguous(scene)
    faces = assert_as_cycles(scene, sure, but=("normal",))
    both = sure & (where == 1) & (faces["object_index"] == 1)
    far = np.abs(faces["uv"] - ours["uv"])[both]
    assert np.minimum(far, np.abs(far - 1)).max() < 2e-3  # a face is up to 1e-4 of the radius inside of the sphere
    other = np.isfinite(ours["depth"]) & (where == 0)
    x, y, z = np.moveaxis(ours["position"][other] - (2.2, 0, 1), -1, 0)
    expected = np.arctan2(y, x) / (2 * np.pi) + 0.5, np.arcsin(z) / np.pi + 0.5
    np.testing.assert_allclose(ours["uv"][other][:, :2], np.transpose(expected), atol=1e-5)


@pytest.mark.parametrize(("setting", "make"), [("SPHERE", "cube"), ("PLANE", "monkey"), ("INFINITE_PLANE", "plane")])
def test_a_shape_that_an_object_asks_for_has_a_map_too(scene, setting, make):
    item = added(make, "Asked")
    item.camera_ray_caster.primitive = setting
    assert [name for name, _ in read_shapes(scene).notes] == ([] if make == "plane" else ["Asked"])
    unmapped(item)
    assert read_shapes(scene).notes == ()
    assert (cast_scene(scene, ("uv",))["uv"] == 0).all()


@pytest.mark.parametrize("value", [np.nan, np.inf, 3e38])
def test_a_broken_map_is_named_or_cast_as_it_is(scene, value):
    added("uv_sphere", "Ball", location=(-2, 0, 1))
    added("plane", "Plane", location=(2, 0, 1))
    for name in ("Ball", "Plane"):
        bpy.data.objects[name].data.uv_layers.active.data[1].uv = value, 0
    assert kinds(scene) == {"Ball": SPHERE, "Plane": MESH}
    assert [name for name, _ in read_shapes(scene).notes] == ["Ball"]
