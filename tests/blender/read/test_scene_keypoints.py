"""Key points of a mesh whose vertex groups a modifier has renumbered."""

import bpy
import pytest

from camera_ray_caster.blender.read.scene_keypoints import key_points

from .scene_parts import geometry_nodes, mesh_of, new_object


def with_groups(name, points, groups):
    """An object with one vertex group for each of its vertices."""
    item = new_object(name, mesh_of(*points))
    for k, group in enumerate(groups):
        item.vertex_groups.new(name=group).add([k], 1.0, "REPLACE")
    return item


@pytest.mark.parametrize("theirs_first", [False, True])
def test_vertex_groups_of_a_joined_mesh_are_told_apart_by_name(theirs_first):
    theirs = with_groups("Theirs", [(10, 0, 0), (20, 0, 0), (30, 0, 0)], ["Left", "Right", "Tail"])
    ours = with_groups("Ours", [(1, 2, 3), (4, 5, 6)], ["Tip", "Foot"])

    def joined(new, link, mesh):
        info, join = new("GeometryNodeObjectInfo"), new("GeometryNodeJoinGeometry")
        info.inputs["Object"].default_value = theirs
        for geometry in (info.outputs["Geometry"], mesh)[:: -1 if theirs_first else 1]:
            link(geometry, join.inputs[0])
        return join.outputs[0]

    geometry_nodes(ours, joined)
    points = key_points(bpy.context.scene, bpy.context.evaluated_depsgraph_get(), ["Ours"])
    assert [(point.name, point.position) for point in points] == [("Tip", (1, 2, 3)), ("Foot", (4, 5, 6))]
