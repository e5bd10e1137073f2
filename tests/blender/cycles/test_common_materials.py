"""The node trees that importers and people build most, beside Cycles: textures, masks, groups, muted nodes, bumps.

What a tree of one node gives is in ``material_examples``.
"""

import bpy as bpy_module
import numpy as np

from .test_albedo import CELL, CLOSE, grid
from .test_alpha import material, scene  # noqa: F401

MATERIALS = {}


def common(function):
    """Add a material; ``function`` gets a function that makes a node with inputs, one that links, and the object."""

    def make(item):
        new, link, out, _ = material(item)

        def node(kind, **inputs):
            shader_node = new(f"ShaderNode{kind}")
            for name, value in inputs.items():
                key = int(name[1:]) if name.startswith("_") else name.replace("_", " ")
                shader_node.inputs[key].default_value = value
            return shader_node

        link(function(node, link, item).outputs[0], out)

    MATERIALS[function.__name__] = make
    return function


def image_of(color, space="sRGB"):
    """An image of two colors. No pixel of the picture has its center on an edge of two texels."""
    image = bpy_module.data.images.new("Image", 2, 2, alpha=True)
    image.colorspace_settings.name = space
    texels = np.tile(np.float32(color), (2, 2, 1))
    texels[0, :, :3] *= 0.5
    image.pixels = texels.ravel().tolist()
    image.pack()
    return image


def painted(node, color, space="sRGB"):
    shader_node = node("TexImage")
    shader_node.image, shader_node.interpolation = image_of(color, space), "Closest"
    return shader_node


def principled(node, **inputs):
    """A Principled BSDF that reflects nothing, which would add to its color."""
    shader_node = node("BsdfPrincipled", **inputs)
    shader_node.inputs["Specular IOR Level"].default_value = 0.0
    return shader_node


@common
def principled_color(node, link, item):
    return principled(node, Base_Color=(0.2, 0.5, 0.7, 1))


@common
def texture_times_factor(node, link, item):
    """As glTF's importer multiplies a texture by a factor."""
    shader, mix = principled(node), node("Mix")
    mix.data_type, mix.blend_type = "RGBA", "MULTIPLY"
    mix.inputs[0].default_value, mix.inputs[7].default_value = 1, (0.9, 0.8, 0.5, 1)
    link(painted(node, (0.8, 0.3, 0.2, 1)).outputs["Color"], mix.inputs[6])
    link(mix.outputs[2], shader.inputs["Base Color"])
    return shader


@common
def texture_with_roughness_and_normals(node, link, item):
    """As importers connect a color, a packed roughness and metallic, and a normal map."""
    shader, split, normal = principled(node), node("SeparateColor"), node("NormalMap")
    link(painted(node, (0.7, 0.6, 0.2, 1)).outputs["Color"], shader.inputs["Base Color"])
    link(painted(node, (1, 0.5, 0, 1), "Non-Color").outputs["Color"], split.inputs[0])
    link(split.outputs[1], shader.inputs["Roughness"])
    link(split.outputs[2], shader.inputs["Metallic"])
    link(painted(node, (0.5, 0.5, 1, 1), "Non-Color").outputs["Color"], normal.inputs["Color"])
    link(normal.outputs[0], shader.inputs["Normal"])
    return shader


@common
def vertex_colors(node, link, item):
    colors = item.data.color_attributes.new("Color", "BYTE_COLOR", "CORNER")
    colors.data.foreach_set("color", [0.9, 0.2, 0.1, 1] * 4)
    shader, read = principled(node), node("VertexColor")
    read.layer_name = "Color"
    link(read.outputs[0], shader.inputs["Base Color"])
    return shader


@common
def shadeless(node, link, item):
    """As glTF's importer builds an unlit material: what the camera sees emits."""
    mix, emission = node("MixShader"), node("Emission", Color=(0.6, 0.4, 0.2, 1))
    link(node("LightPath").outputs["Is Camera Ray"], mix.inputs[0])
    link(node("BsdfTransparent").outputs[0], mix.inputs[1])
    link(emission.outputs[0], mix.inputs[2])
    return mix


@common
def masked(node, link, item):
    """A texture whose alpha above a half decides between it and a hole; all of this one is above."""
    mix, shader, above, image = node("MixShader"), node("BsdfDiffuse"), node("Math"), painted(node, (0.3, 0.8, 0.2, 1))
    above.operation, above.inputs[1].default_value = "GREATER_THAN", 0.5
    link(image.outputs["Alpha"], above.inputs[0])
    link(above.outputs[0], mix.inputs[0])
    link(node("BsdfTransparent").outputs[0], mix.inputs[1])
    link(image.outputs["Color"], shader.inputs["Color"])
    link(shader.outputs[0], mix.inputs[2])
    return mix


@common
def group_in_a_group(node, link, item):
    inner, outer = (bpy_module.data.node_groups.new(name, "ShaderNodeTree") for name in ("Inner", "Outer"))
    inner.interface.new_socket("Color", in_out="INPUT", socket_type="NodeSocketColor")
    for tree in (inner, outer):
        tree.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    shader = inner.nodes.new("ShaderNodeBsdfDiffuse")
    inner.links.new(inner.nodes.new("NodeGroupInput").outputs[0], shader.inputs["Color"])
    inner.links.new(shader.outputs[0], inner.nodes.new("NodeGroupOutput").inputs[0])
    used = outer.nodes.new("ShaderNodeGroup")
    used.node_tree, used.inputs[0].default_value = inner, (0.7, 0.2, 0.6, 1)
    outer.links.new(used.outputs[0], outer.nodes.new("NodeGroupOutput").inputs[0])
    group = node("Group")
    group.node_tree = outer
    return group


@common
def muted_color_behind_a_reroute(node, link, item):
    shader, hue, color = node("BsdfDiffuse"), node("HueSaturation", Hue=0.2), node("RGB")
    hue.mute, color.outputs[0].default_value = True, (0.1, 0.6, 0.3, 1)
    reroute = item.active_material.node_tree.nodes.new("NodeReroute")
    link(color.outputs[0], hue.inputs["Color"])
    link(hue.outputs[0], reroute.inputs[0])
    link(reroute.outputs[0], shader.inputs["Color"])
    return shader


@common
def muted_mix(node, link, item):
    mix = node("MixShader")
    link(node("BsdfDiffuse", Color=(0.3, 0.3, 0.8, 1)).outputs[0], mix.inputs[1])
    link(node("Emission").outputs[0], mix.inputs[2])
    mix.mute = True
    return mix


@common
def mapped_texture(node, link, item):
    shader, mapping, image = node("BsdfDiffuse"), node("Mapping", Scale=(3, 3, 1)), painted(node, (0.9, 0.5, 0.3, 1))
    link(node("TexCoord").outputs["UV"], mapping.inputs["Vector"])
    link(mapping.outputs[0], image.inputs["Vector"])
    link(image.outputs["Color"], shader.inputs["Color"])
    return shader


@common
def bumpy(node, link, item):
    shader, bump = node("BsdfDiffuse", Color=(0.4, 0.4, 0.1, 1)), node("Bump")
    link(node("TexNoise").outputs[0], bump.inputs["Height"])
    link(bump.outputs[0], shader.inputs["Normal"])
    return shader


@common
def texture_at_the_surface(node, link, item):
    """It emits."""
    return painted(node, (0.8, 0.7, 0.4, 1))


@common
def glass(node, link, item):
    return node("BsdfGlass", Color=(0.9, 0.95, 1, 1))


def test_their_colors_are_those_of_cycles(scene):  # noqa: F811
    images, shapes, colors = grid(scene, MATERIALS.values())
    off = np.abs(images["albedo"] - sum(colors)).max(axis=-1)
    wrong = {}
    for number, name in enumerate(MATERIALS, 1):
        square = images["object_index"] == number
        assert square.sum() == CELL * CELL, name
        if off[square].max() > CLOSE:
            wrong[name] = off[square].max()
    assert not wrong
    assert not shapes.unread
