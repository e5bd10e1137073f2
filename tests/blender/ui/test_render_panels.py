"""What Blender's own panels and nodes know of the engine."""


def test_blenders_panels_know_the_engine(blender):
    for name in ("RENDER_PT_output", "VIEWLAYER_PT_layer", "DATA_PT_camera_dof", "OBJECT_PT_visibility"):
        assert "CAMERA_RAY_CASTER" in getattr(blender.types, name).COMPAT_ENGINES
    for name in ("RENDER_PT_eevee_performance", "DATA_PT_lens"):  # for the latter there is a panel of our own
        assert "CAMERA_RAY_CASTER" not in getattr(blender.types, name).COMPAT_ENGINES


def test_the_compositor_is_offered_the_ticked_passes(blender):
    from camera_ray_caster.blender.properties import pass_properties

    scene = blender.context.scene
    scene.render.engine = "CAMERA_RAY_CASTER"
    pass_properties.tick(scene, scene.view_layers[0], ["combined", "depth", "ray_direction"])
    if hasattr(scene, "compositing_node_group"):
        tree = scene.compositing_node_group = blender.data.node_groups.new("Compositing", "CompositorNodeTree")
    else:
        scene.use_nodes = True
        tree = scene.node_tree
    node = tree.nodes.new("CompositorNodeRLayers")
    scene.view_layers[0].update_render_passes()
    sockets = {socket.name for socket in node.outputs if socket.enabled}
    assert sockets == {"Image", "Alpha", "Depth", "Ray Direction"}
