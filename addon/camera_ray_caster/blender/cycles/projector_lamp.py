"""A lamp for Cycles that shines a picture through a camera's model: a projector of structured light.

A point lamp at the camera's eye, whose nodes turn the direction of each ray into a place of the picture by a table of
the model's inverse (``core.faces.inverse_table``). It needs no OSL, so that it works on every device, and in a Blender
without this add-on.
"""

import bpy
import numpy as np
from mathutils import Matrix

from ...core.faces.faces import turn_of
from ...core.faces.inverse_table import InverseTable, inverse_table
from ..read.evaluated import camera_at
from ..read.scene_reader import evaluated_camera

POWER = 1000.0
"""Watts of the lamp, as if it shone white in every direction."""
KNOWN = 0.9999
"""Least share of the texels around a direction that must be known: all, within rounding."""


def add_projector(scene, camera_object=None, image=None) -> tuple[bpy.types.Object, float]:
    """Add a lamp that shines an image through a camera's model in Cycles; return its object and its error in pixels.

    camera_object: default the scene's camera; the lamp is its child. image: a ``bpy.types.Image`` that fills the
    camera's full frame, whatever its size; default a color grid of the frame's size. It can be exchanged in the lamp's
    nodes. The picture's value is radiant intensity: a surface that faces the lamp is lit by it divided by the square of
    the distance. The table of the inverse is packed into the file; it is that of the camera as it is now. The error is
    the largest between texels; at a picture's seam or pole, where it would exceed half a pixel, nothing is lit.
    Raises InputError for cameras that cannot be cast, and for those whose rays have many origins.
    """
    with evaluated_camera(scene, camera_object) as (active, depsgraph):
        camera = camera_at(active, depsgraph)[1]
    table = inverse_table(camera)
    name = f"{active.name} Projector"
    light = bpy.data.lights.new(name, "POINT")
    light.energy, light.shadow_soft_size = POWER, 0.0
    light.use_nodes = True
    _add_nodes(light.node_tree, table, _image_of(table, name), image or _grid(name, camera.raster.size))
    lamp = bpy.data.objects.new(name, light)
    (active.users_collection or [scene.collection])[0].objects.link(lamp)
    world = np.eye(4)
    world[:3, :3], world[:3, 3] = turn_of(camera), camera.pose.eye
    lamp.parent = active
    lamp.matrix_parent_inverse = active.matrix_world.inverted()
    lamp.matrix_basis = Matrix(world)
    return lamp, table.error


def _image_of(table: InverseTable, name: str):
    height, width = table.texels.shape[:2]
    image = bpy.data.images.new(f"{name} Inverse", width, height, float_buffer=True, is_data=True)
    image.pixels.foreach_set(np.dstack((table.texels, np.ones((height, width), np.float32))).ravel())
    image.file_format = "OPEN_EXR"
    image.pack()
    return image


def _grid(name: str, size):
    image = bpy.data.images.new(f"{name} Picture", *size)
    image.generated_type = "COLOR_GRID"
    return image


def _add_nodes(tree, table: InverseTable, inverse, picture) -> None:
    """Have a lamp's nodes emit the picture."""
    nodes, links = tree.nodes, tree.links

    def node(kind: str, *inputs, **settings):
        made = nodes.new(f"ShaderNode{kind}")
        made.location = 200 * len(nodes) - 1400, 0
        for name, value in settings.items():
            setattr(made, name, value)
        for socket, value in zip(made.inputs, inputs, strict=False):
            if isinstance(value, bpy.types.NodeSocket):
                links.new(value, socket)
            else:
                socket.default_value = value
        return made

    def math(operation: str, *inputs):
        return node("Math", *inputs, operation=operation).outputs[0]

    nodes.clear()
    direction = node("SeparateXYZ", node("TexCoord").outputs["Normal"])
    x, y, z = direction.outputs
    behind = math("GREATER_THAN", z, 0.0) if table.has_behind else 0.0
    # ahead of a camera without a second square, 1 - z grows on behind it, out of the square
    scale = math("MULTIPLY", math("ADD", 1.0, math("ABSOLUTE", z) if table.has_behind else math("MULTIPLY", z, -1.0)),
                 2 * table.reach)  # fmt: skip
    across = math("ADD", math("ADD", math("DIVIDE", x, scale), 0.5), behind)
    up = math("ADD", math("DIVIDE", y, scale), 0.5)
    at = node("CombineXYZ", math("DIVIDE", across, 1.0 + table.has_behind), up).outputs[0]
    places = node("TexImage", at, image=inverse, extension="CLIP", label="Inverse")
    u, v, known = node("SeparateColor", places.outputs["Color"]).outputs
    shown = node("TexImage", node("CombineXYZ", u, v).outputs[0], image=picture, extension="CLIP", label="Picture")
    emission = node("Emission", shown.outputs["Color"], math("GREATER_THAN", known, KNOWN))
    links.new(emission.outputs[0], node("OutputLight").inputs["Surface"])
