"""What Blender does to a picture after the cast is warned of: compositor nodes without their passes, and Freestyle."""

import pytest

from camera_ray_caster.blender.output import reports


@pytest.fixture
def layers(blender, scene):
    """A Render Layers node of the compositor of a scene whose engine is Cycles, where it has all passes."""
    scene.render.engine = "CYCLES"
    if hasattr(scene, "compositing_node_group"):  # from 5.0 on
        tree = scene.compositing_node_group = blender.data.node_groups.new("Compositor", "CompositorNodeTree")
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        end = tree.nodes.new("NodeGroupOutput")
    else:
        scene.use_nodes = True
        tree = scene.node_tree
        tree.nodes.clear()
        end = tree.nodes.new("CompositorNodeComposite")
    node = tree.nodes.new("CompositorNodeRLayers")
    node.scene, node.name = scene, "Beauty"

    def read(*names):
        """Let the compositor read the first of these passes that this Blender has; return its name."""
        name = next(name for name in names if name in node.outputs)
        tree.links.new(node.outputs[name], end.inputs[0])
        scene.render.engine = "CAMERA_RAY_CASTER"
        return name

    return node, read


def rendered(blender):
    """Render, and return the warnings; () if Blender renders nothing, since no node asks for it."""
    reports.forget()
    blender.ops.render.render()
    report = reports.latest()
    return () if report is None else report.warnings


def test_a_pass_that_the_engine_lacks_is_warned_of_with_its_node(blender, scene, layers, capfd):
    _, read = layers
    scene.view_layers[0].use_pass_diffuse_color = True
    name = read("Diffuse Color", "DiffCol")
    (warning,) = rendered(blender)
    assert "'Beauty'" in warning
    assert f"{name!r} of 'ViewLayer', which this engine does not have" in warning
    assert warning in capfd.readouterr().out
    blender.ops.camera_ray_caster.write_report()
    text = " ".join(blender.data.texts["Camera Ray Caster Report"].as_string().split())
    assert warning in text


def test_a_pass_that_is_not_cast_is_to_be_enabled(blender, scene, layers):
    _, read = layers
    read("Depth")
    assert rendered(blender) == ()
    scene.view_layers[0].use_pass_z = False
    (warning,) = rendered(blender)
    assert "'Depth' of 'ViewLayer', which is not cast: enable it" in warning


def test_a_compositor_that_does_not_run_is_not_warned_of(blender, scene, layers):
    node, read = layers
    scene.view_layers[0].use_pass_mist = True
    read("Mist")
    assert len(rendered(blender)) == 1
    node.mute = True
    assert rendered(blender) == ()
    node.mute, scene.render.use_compositing = False, False
    assert rendered(blender) == ()
    scene.render.use_compositing = True
    node.id_data.links[0].is_muted = True
    assert rendered(blender) == ()


def test_freestyle_is_warned_of_with_its_cost(blender, scene):
    scene.render.use_freestyle = True
    (warning,) = rendered(blender)
    assert warning.startswith("Freestyle draws its lines after the cast")
    scene.view_layers[0].use_freestyle = False
    assert rendered(blender) == ()


def test_a_cryptomatte_node_reads_passes_that_the_engine_lacks(blender, scene, layers):
    node, read = layers
    read("Image")
    scene.view_layers[0].use_pass_cryptomatte_object = True
    scene.render.engine = "CYCLES"
    tree = node.id_data
    matte = tree.nodes.new("CompositorNodeCryptomatteV2")
    matte.scene = scene
    matte.layer_name = "ViewLayer.CryptoObject"
    end = next(link for link in tree.links if link.from_node == node).to_socket
    tree.links.new(matte.outputs[0], end)
    tree.links.new(node.outputs["Image"], matte.inputs[0])
    scene.render.engine = "CAMERA_RAY_CASTER"
    (warning,) = rendered(blender)
    assert "reads the pass 'CryptoObject' of 'ViewLayer', which this engine does not have" in warning
