"""A scene whose pixels have each their own time; time_scene.py has what tests ask of it."""

import pytest

from camera_ray_caster.blender.read import geometry

from ..pictures import tick
from .scene_parts import ball, new_object
from .time_scene import PASSES, SIZE


@pytest.fixture
def scene(blender):
    """A slit scan over frames 1 to 25 of a sphere of radius 1, 4 pixels a unit, seen by parallel rays from above."""
    scene = blender.context.scene
    camera = new_object("Camera", blender.data.cameras.new("Camera"))
    camera.data.type, camera.data.ortho_scale, camera.location.z = "ORTHO", 12.0, 10.0
    camera.data.camera_ray_caster.time_mode = "ROWS"
    scene.camera = camera
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.frame_set(7)
    tick(scene, PASSES)
    return scene


@pytest.fixture
def sphere(scene):
    """The sphere that moves."""
    return ball("Ball", subdivisions=3)


@pytest.fixture
def read_meshes(monkeypatch):
    """The names of the evaluated meshes that are read, in order."""
    read, original = [], geometry.mesh_shapes
    monkeypatch.setattr(geometry, "mesh_shapes", lambda mesh, *more: read.append(mesh.name) or original(mesh, *more))
    return read


@pytest.fixture
def surface(blender):
    """The nodes, the function that links, the output and the material of a square with a UV map that is seen."""
    mesh = blender.data.meshes.new("Square")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new().uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
    new_object("Square", mesh)
    scene = blender.context.scene
    scene.camera = new_object("Camera", blender.data.cameras.new("Camera"))
    scene.camera.location.z = 3
    scene.render.resolution_x = scene.render.resolution_y = 16
    material = blender.data.materials.new("Paint")
    if blender.app.version < (5, 0):
        material.use_nodes = True
    material.diffuse_color = 0.25, 0.5, 0.75, 1
    material.node_tree.nodes.clear()
    mesh.materials.append(material)
    new, link = material.node_tree.nodes.new, material.node_tree.links.new
    return new, link, new("ShaderNodeOutputMaterial"), material
