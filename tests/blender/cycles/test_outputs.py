"""The output of a material that Cycles renders, also in groups: random trees, one for each square of a grid."""

from random import Random

import bpy as bpy_module
import numpy as np
import pytest

from .material_examples import BLUE, RED
from .test_albedo import CELL, CLOSE, grid
from .test_alpha import material, scene  # noqa: F401

TREES = 56


def shaded(random, tree):
    """A socket that may be linked to Surface: of a shader, a color, a number or a vector, which emit."""
    kind = random.choice(["BsdfDiffuse", "BsdfDiffuse", "Emission", "RGB", "Value", "CombineXYZ", "MixShader"])
    node = tree.nodes.new(f"ShaderNode{kind}")
    color = [random.uniform(0.05, 0.95) for _ in range(3)]
    if kind == "MixShader":
        node.inputs[0].default_value = 0.25
        for socket in node.inputs[1 : random.choice([2, 3])]:
            tree.links.new(shaded(random, tree), socket)
    elif kind == "CombineXYZ":
        for socket, value in zip(node.inputs, color, strict=True):
            socket.default_value = value
    elif kind == "Value":
        node.outputs[0].default_value = color[0]
    else:
        (node.outputs[0] if kind == "RGB" else node.inputs[0]).default_value = (*color, 1)
    return node.outputs[0]


def fill(random, tree, depth=0):
    """Fill a tree with outputs and groups of such trees; some are muted, some without a link."""
    things = ["output"] * random.choice([0, 1, 1, 2, 3]) + ["group"] * (depth < 2) * random.choice([0, 1, 1, 2])
    random.shuffle(things)
    outputs = []
    for thing in things:
        if thing == "group":
            group = tree.nodes.new("ShaderNodeGroup")
            group.node_tree, group.mute = (
                bpy_module.data.node_groups.new("Group", tree.bl_idname),
                random.random() < 0.1,
            )
            fill(random, group.node_tree, depth + 1)
            continue
        outputs.append(tree.nodes.new("ShaderNodeOutputMaterial"))
        outputs[-1].target, outputs[-1].mute = random.choice(["ALL", "ALL", "CYCLES", "EEVEE"]), random.random() < 0.06
        if random.random() < 0.85:
            tree.links.new(shaded(random, tree), outputs[-1].inputs["Surface"])
    if outputs:
        random.choice(outputs).is_active_output = True


def planted(seed):
    def make(item):
        tree = material(item)[3].node_tree
        tree.nodes.clear()
        fill(Random(seed), tree)

    return make


@pytest.mark.parametrize("first", [0, *(pytest.param(TREES * k, marks=pytest.mark.full) for k in (1, 2))])
def test_outputs_anywhere_in_a_tree_are_chosen_as_in_cycles(scene, first):  # noqa: F811
    images, shapes, colors = grid(scene, [planted(first + k) for k in range(TREES)])
    truth = sum(colors)
    off = {k: (images["albedo"] - truth)[images["object_index"] == k + 1] for k in range(TREES)}
    assert {len(some) for some in off.values()} == {CELL * CELL}
    assert {first + k for k, some in off.items() if np.abs(some).max() > CLOSE} == set()
    assert len(np.unique(truth.reshape(-1, 3).round(3), axis=0)) > TREES / 2
    assert not shapes.unread


def in_a_group(alpha):
    """The tree of MToon: a group without sockets holds the output of Cycles, beside one for all engines."""

    def make(item):
        new, link, out, made = material(item)
        red = new("ShaderNodeBsdfDiffuse")
        red.inputs["Color"].default_value = (*RED, 1)
        link(red.outputs[0], out)
        group = new("ShaderNodeGroup")
        group.node_tree = tree = bpy_module.data.node_groups.new("Group", made.node_tree.bl_idname)
        output, shader = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new("ShaderNodeBsdfPrincipled")
        output.target = "CYCLES"
        shader.inputs["Base Color"].default_value, shader.inputs["Alpha"].default_value = (*BLUE, 1), alpha
        shader.inputs["Specular IOR Level"].default_value = 0.0
        tree.links.new(shader.outputs[0], output.inputs["Surface"])

    return make


def test_alpha_is_that_of_the_output_in_a_group(scene):  # noqa: F811
    images, shapes, colors = grid(scene, [in_a_group(1.0), in_a_group(0.0)])
    assert set(np.unique(images["object_index"])) == {0, 1}
    np.testing.assert_allclose(images["albedo"], sum(colors), atol=CLOSE)
    assert not shapes.left_out
    assert not shapes.unread


def test_a_surface_without_a_material_is_gray(scene):  # noqa: F811
    def empty(item):
        item.data.materials.append(None)
        item.color = 1, 0, 0, 1

    images, _, colors = grid(scene, [empty, lambda item: None])
    np.testing.assert_allclose(images["albedo"], sum(colors), atol=CLOSE)
