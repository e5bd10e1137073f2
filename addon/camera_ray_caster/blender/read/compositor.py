"""The nodes of a scene's compositor."""

from collections.abc import Iterator


def compositor_nodes(scene) -> Iterator:
    """Yield the compositor's nodes that a render of the scene runs, those in groups, too, without muted nodes."""
    if not scene.render.use_compositing:
        return
    from_5_0 = hasattr(scene, "compositing_node_group")
    trees = [scene.compositing_node_group if from_5_0 else scene.node_tree if scene.use_nodes else None]
    for tree in trees:  # the list grows during the loop
        nodes = [node for node in tree.nodes if not node.mute] if tree is not None else []
        yield from nodes
        trees += [node.node_tree for node in nodes if node.type == "GROUP" and node.node_tree not in trees]
