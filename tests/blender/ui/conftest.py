"""The scene whose panels and buttons are tested."""

import pytest

WIDTH, HEIGHT = 24, 16


@pytest.fixture
def scene(blender):
    """A sphere and a monkey that is left out before a camera."""
    bpy = blender
    bpy.ops.mesh.primitive_monkey_add(location=(3, 0, 0))
    bpy.context.object.camera_ray_caster.primitive = "IGNORE"
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1)
    bpy.ops.object.camera_add(location=(0, 0, 6))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    return scene
