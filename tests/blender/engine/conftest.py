"""What the tests of the engine render."""

import pytest

from camera_ray_caster.core.casting.passes import PASSES

from ..pictures import HEIGHT, WIDTH, tick


@pytest.fixture
def scene(blender):
    """A sphere before a tilted plane that leaves the picture's left free, seen from 6 above."""
    bpy = blender
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1, location=(0.25, 0, 1))
    bpy.context.object.pass_index = 3
    material = bpy.data.materials.new("Clay")
    material.pass_index = 5
    bpy.context.object.data.materials.append(material)
    bpy.ops.mesh.primitive_plane_add(size=4, location=(2, 0, -1), rotation=(0, 0.3, 0))
    bpy.ops.object.camera_add(location=(0, 0, 6))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.render.resolution_x, scene.render.resolution_y = WIDTH, HEIGHT
    tick(scene, PASSES)
    return scene
