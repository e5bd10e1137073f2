"""File Output nodes write only where the user lets them, and what they wrote stands in the report."""

import json

import pytest

from camera_ray_caster.blender.output import file_outputs


def compositor(bpy, scene):
    """A new node tree, the scene's compositor."""
    if hasattr(scene, "compositing_node_group"):  # from 5.0 on
        scene.compositing_node_group = bpy.data.node_groups.new("Compositor", "CompositorNodeTree")
        return scene.compositing_node_group
    scene.use_nodes = True
    scene.node_tree.nodes.clear()
    return scene.node_tree


def file_output(tree, socket, folder, name):
    """A File Output node that writes one image."""
    node = tree.nodes.new("CompositorNodeOutputFile")
    if hasattr(node, "directory"):
        node.directory, node.file_name = folder, name
        node.file_output_items.new("RGBA", "")
        node.format.media_type = "IMAGE"
    else:
        node.base_path = folder
        node.file_slots[0].path = name
    node.format.file_format = "PNG"
    tree.links.new(socket, node.inputs[0])


@pytest.fixture
def scene(blender, camera_scene, tmp_path):
    """A small scene with a node that writes beside the file, one in a group that writes elsewhere, and a muted one."""
    scene = camera_scene
    scene.render.engine = "CAMERA_RAY_CASTER"
    tree = compositor(blender, scene)
    group = blender.data.node_groups.new("Group", "CompositorNodeTree")
    group.interface.new_socket("Image", socket_type="NodeSocketColor")
    layers, inner = tree.nodes.new("CompositorNodeRLayers"), tree.nodes.new("CompositorNodeGroup")
    inner.node_tree = group
    tree.links.new(layers.outputs[0], inner.inputs[0])
    file_output(tree, layers.outputs[0], "//beside/", "below/one")
    file_output(group, group.nodes.new("NodeGroupInput").outputs[0], str(tmp_path / "elsewhere"), "two")
    file_output(tree, layers.outputs[0], str(tmp_path / "muted"), "three")
    tree.nodes[-1].mute = True
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "nodes.blend"))
    return scene


def cast(tmp_path, *words):
    """Cast the file; return the report, and the files that appeared beside it."""
    from camera_ray_caster.blender.terminal import commands

    before = set(tmp_path.rglob("*"))
    words = [str(tmp_path / "nodes.blend"), "--output", str(tmp_path / "out"), *words]
    assert commands.main("cast", words, "cast.py") == 0
    appeared = [path for path in tmp_path.rglob("*") if path.is_file() and path not in before]
    outside = {path.relative_to(tmp_path).parts[0] for path in appeared} - {"out"}
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    return report, sorted(str(path) for path in appeared if path.relative_to(tmp_path).parts[0] in outside)


def test_they_write_nothing_and_one_line_says_so(blender, scene, tmp_path, capfd):
    report, appeared = cast(tmp_path)
    assert appeared == report["file_outputs"] == []
    (warning,) = report["warnings"]
    warnings = [line for line in capfd.readouterr().err.splitlines() if line.startswith("cast.py")]
    assert warnings == [f"cast.py: warning: {warning}"]
    assert "--file-output" in warning
    assert [node.mute for node in file_outputs.writing(blender.context.scene)] == [False, False]


def test_an_option_lets_them_write_and_the_report_has_the_paths(scene, tmp_path, capfd):
    for _ in range(2):  # files that are new, and files that are replaced
        report, appeared = cast(tmp_path, "--file-output")
        assert report["warnings"] == []
        assert [path.split("/")[-2] for path in report["file_outputs"]] == ["below", "elsewhere"]
        assert set(appeared) <= set(report["file_outputs"])
        output = capfd.readouterr()
        assert not [line for line in output.err.splitlines() if line.startswith("cast.py")]
        assert "Written by File Output nodes" in output.out
    assert (tmp_path / "beside" / "below").is_dir()


def test_without_a_compositor_there_are_none(blender, scene):
    scene.render.use_compositing = False
    assert file_outputs.writing(scene) == []
    assert file_outputs.writing(blender.data.scenes.new("Other")) == []
