"""Materials whose colors are compared with those of Cycles, each a function that gives an object its material."""

import bpy as bpy_module

from .test_alpha import material, texture


def set_inputs(node, **values):
    for name, value in values.items():
        socket = node.inputs[name.replace("_", " ")]
        socket.default_value = (*value, 1) if isinstance(value, tuple) and len(socket.default_value) == 4 else value


def shader(kind, **values):
    """A material of one shader; values are of its inputs, whose spaces are underscores here."""

    def make(item):
        new, link, out, _ = material(item)
        node = new(f"ShaderNode{kind}")
        set_inputs(node, **values)
        link(node.outputs[0], out)

    return make


def colored(build):
    """A diffuse material whose color is a socket that ``build(new, link)`` returns."""

    def make(item):
        new, link, out, _ = material(item)
        node = new("ShaderNodeBsdfDiffuse")
        link(build(new, link, item), node.inputs["Color"])
        link(node.outputs[0], out)

    return make


def node_of(kind, attributes=None, output=0, **values):
    """The output of a node with these settings and inputs."""

    def build(new, link, item):
        node = new(f"ShaderNode{kind}")
        for name, value in (attributes or {}).items():
            setattr(node, name, value)
        set_inputs(node, **values)
        return node.outputs[output]

    return build


def mix_color(blend, factor=0.7, a=(0.2, 0.5, 0.9), b=(0.6, 0.3, 0.1)):
    def build(new, link, item):
        node = new("ShaderNodeMix")
        node.data_type, node.blend_type = "RGBA", blend
        for name, value in (("Factor_Float", factor), ("A_Color", (*a, 1)), ("B_Color", (*b, 1))):
            next(socket for socket in node.inputs if socket.identifier == name).default_value = value
        return next(socket for socket in node.outputs if socket.identifier == "Result_Color")

    return build


def ramp(interpolation):
    def build(new, link, item):
        node = new("ShaderNodeValToRGB")
        node.color_ramp.interpolation = interpolation
        node.color_ramp.elements[0].color, node.color_ramp.elements[1].color = (1, 0, 0, 1), (0, 0.5, 1, 1)
        node.color_ramp.elements.new(0.4).color = 0, 1, 0, 1
        node.inputs[0].default_value = 0.63
        return node.outputs[0]

    return build


def curve(new, link, item):
    node = new("ShaderNodeRGBCurve")
    node.mapping.curves[0].points.new(0.5, 0.8)
    node.mapping.curves[3].points.new(0.3, 0.2)
    node.mapping.update()
    node.inputs["Color"].default_value = 0.4, 0.6, 0.2, 1
    return node.outputs[0]


def curve_beyond(extend):
    def build(new, link, item):
        node = new("ShaderNodeRGBCurve")
        node.mapping.curves[1].points.new(0.4, 0.7)
        node.mapping.curves[3].points.new(0.3, 0.2)
        node.mapping.extend = extend
        node.mapping.update()
        node.inputs["Color"].default_value = 1.4, 1.1, 0.2, 1
        return node.outputs[0]

    return build


def two_shaders(kind, first, second, factor=0.3):
    def make(item):
        new, link, out, _ = material(item)
        mix = new(f"ShaderNode{kind}Shader")
        places = (1, 2) if kind == "Mix" else (0, 1)
        if kind == "Mix":
            mix.inputs[0].default_value = factor
        for socket, (name, color) in zip(places, (first, second), strict=True):
            node = new(f"ShaderNode{name}")
            node.inputs["Color"].default_value = (*color, 1)
            link(node.outputs[0], mix.inputs[socket])
        link(mix.outputs[0], out)

    return make


def painted(
    extension="REPEAT", interpolation="Linear", space="sRGB", scale=(1.0, 1.0, 1.0), coordinates="UV", mapped="POINT",
    turn=(0.0, 0.0, 0.0),
):  # fmt: skip
    """An image of four colors; the pixels that are compared are in the middles of its texels."""

    def build(new, link, item):
        image = bpy_module.data.images.new("four", 2, 2, alpha=True)
        image.colorspace_settings.name = space
        image.pixels.foreach_set([0.9, 0.2, 0.1, 1, 0.1, 0.8, 0.3, 1, 0.2, 0.3, 0.7, 1, 0.6, 0.6, 0.2, 1])
        image.pack()
        node, mapping, coordinate_node = texture(new, image), new("ShaderNodeMapping"), new("ShaderNodeTexCoord")
        node.extension, node.interpolation = extension, interpolation
        mapping.vector_type = mapped
        mapping.inputs["Rotation"].default_value, mapping.inputs["Scale"].default_value = turn, scale
        link(coordinate_node.outputs[coordinates], mapping.inputs[0])
        link(mapping.outputs[0], node.inputs[0])
        return node.outputs["Color"]

    return build


def half_seen(linked):
    """An image that is half transparent: its color is divided by alpha where the material uses its alpha, too."""

    def make(item):
        image = bpy_module.data.images.new("half", 4, 4, alpha=True)
        image.pixels.foreach_set([0.9, 0.5, 0.2, 0.75] * 16)
        image.pack()
        new, link, out, _ = material(item)
        node, shader = texture(new, image), new("ShaderNodeBsdfDiffuse")
        link(node.outputs["Color"], shader.inputs["Color"])
        if linked:
            link(node.outputs["Alpha"], shader.inputs["Roughness"])
        link(shader.outputs[0], out)

    return make


def layered(name, kind, domain):
    def build(new, link, item):
        attribute = item.data.color_attributes.new(name, kind, domain)
        attribute.data.foreach_set("color", [0.2, 0.6, 0.4, 1] * len(attribute.data))
        node = new("ShaderNodeVertexColor")
        node.layer_name = name
        return node.outputs["Color"]

    return build


def attribute(new, link, item):
    item.data.attributes.new("warmth", "FLOAT", "FACE").data.foreach_set("value", [0.35] * 1)
    node = new("ShaderNodeAttribute")
    node.attribute_name = "warmth"
    return node.outputs["Fac"]


def separated(new, link, item):
    """Channels of a color, exchanged."""
    parts, whole = new("ShaderNodeSeparateColor"), new("ShaderNodeCombineColor")
    parts.inputs[0].default_value = 0.1, 0.4, 0.8, 1
    for k in range(3):
        link(parts.outputs[k], whole.inputs[2 - k])
    return whole.outputs[0]


def ranged(new, link, item):
    node = new("ShaderNodeMapRange")
    for number, value in enumerate((0.4, 0.1, 0.7, 0.2, 0.9)):
        node.inputs[number].default_value = value
    return node.outputs[0]


def value_of(operation, *numbers):
    def build(new, link, item):
        node = new("ShaderNodeMath")
        node.operation = operation
        for socket, number in zip(node.inputs, numbers, strict=False):
            socket.default_value = number
        return node.outputs[0]

    return build


def missing(new, link, item):
    image = bpy_module.data.images.new("missing", 1, 1)
    image.source, image.filepath = "FILE", "//nowhere.png"
    return texture(new, image).outputs[0]


def empty(new, link, item):
    return new("ShaderNodeTexImage").outputs[0]


RED, BLUE = (0.8, 0.1, 0.2), (0.1, 0.3, 0.9)
LIT = {
    "diffuse": shader("BsdfDiffuse", Color=RED),
    "emission": shader("Emission", Color=RED, Strength=5.0),
    "glass": shader("BsdfGlass", Color=RED),
    "glossy": shader("BsdfAnisotropic", Color=RED),
    "translucent": shader("BsdfTranslucent", Color=RED),
    "toon": shader("BsdfToon", Color=RED),
    "refraction": shader("BsdfRefraction", Color=RED),
    "subsurface": shader("SubsurfaceScattering", Color=RED),
    "metallic": shader("BsdfMetallic", Base_Color=RED),
    "metal": shader("BsdfPrincipled", Base_Color=RED, Metallic=1.0),
    "without specular": shader("BsdfPrincipled", Base_Color=RED, Specular_IOR_Level=0.0),
    "as it was made": shader("BsdfPrincipled", Specular_IOR_Level=0.0),
    "mixed": two_shaders("Mix", ("BsdfDiffuse", RED), ("BsdfAnisotropic", BLUE)),
    "mixed with emission": two_shaders("Mix", ("Emission", RED), ("BsdfDiffuse", BLUE), 0.8),
    "added": two_shaders("Add", ("BsdfDiffuse", (0.3, 0.2, 0.1)), ("BsdfTranslucent", (0.1, 0.3, 0.5))),
    "rgb": colored(node_of("RGB")),
    "gamma": colored(node_of("Gamma", Color=RED, Gamma=2.2)),
    "invert": colored(node_of("Invert", Fac=0.7, Color=RED)),
    "bright": colored(node_of("BrightContrast", Color=RED, Bright=0.1, Contrast=0.3)),
    "hue": colored(node_of("HueSaturation", Hue=0.7, Saturation=0.6, Value=0.9, Fac=0.8, Color=RED)),
    "gray": colored(node_of("RGBToBW", Color=RED)),
    "clamp": colored(node_of("Clamp", Value=0.9, Min=0.1, Max=0.4)),
    "linear ramp": colored(ramp("LINEAR")),
    "constant ramp": colored(ramp("CONSTANT")),
    "eased ramp": colored(ramp("EASE")),
    "curve": colored(curve),
    "curve that goes on beyond 1": colored(curve_beyond("EXTRAPOLATED")),
    "curve that is constant beyond 1": colored(curve_beyond("HORIZONTAL")),
    "map range": colored(ranged),
    "channels": colored(separated),
    "attribute": colored(attribute),
    "missing": colored(missing),
    "without an image": colored(empty),
    "half transparent": half_seen(False),
    "half transparent, with alpha": half_seen(True),
    "checker": colored(node_of("TexChecker", Color1=RED, Color2=BLUE, Scale=0.9)),
    **{f"mix {blend}": colored(mix_color(blend)) for blend in (
        "MIX", "ADD", "SUBTRACT", "MULTIPLY", "DIVIDE", "SCREEN", "OVERLAY", "SOFT_LIGHT", "LINEAR_LIGHT",
        "DIFFERENCE", "EXCLUSION", "DARKEN", "LIGHTEN")},
    **{f"math {how}": colored(value_of(how, *numbers)) for how, numbers in {
        "POWER": (0.5, 2.0), "MULTIPLY_ADD": (0.5, 0.3, 0.2), "MODULO": (1.7, 1.2), "DIVIDE": (0.2, 0.5)}.items()},
    **{f"image, {space}": colored(painted(space=space)) for space in ("sRGB", "Non-Color")},
    **{f"image, {extension}": colored(painted(extension, scale=(3.0, 3.0, 1.0)))
       for extension in ("REPEAT", "EXTEND", "CLIP", "MIRROR")},
    "nearest texel": colored(painted(interpolation="Closest")),
    "generated": colored(painted(coordinates="Generated")),
    **{f"colors, {kind} {domain}": colored(layered("Paint", kind, domain))
       for kind in ("FLOAT_COLOR", "BYTE_COLOR") for domain in ("POINT", "CORNER")},
}  # fmt: skip
"""Materials whose whole color is the sum of Cycles' colors."""

PARTLY = {
    (metallic, transmission): shader(
        "BsdfPrincipled", Base_Color=(0.7, 0.4, 0.2), Metallic=metallic, Transmission_Weight=transmission,
        Specular_IOR_Level=0.0,
    )
    for metallic in (0.0, 0.5) for transmission in (0.0, 0.4)
}  # fmt: skip
"""Materials whose Diffuse Color in Cycles is what metal and transmission leave of their Base Color; a specular layer
of the usual level would take another 0.04 of it.
"""
