"""Normals of meshes with sharp edges, where three faces meet or faces wind oppositely, are those of Cycles."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from .cycles import cycles_truth

SIDE, GRIDS = 5, 6


def bumpy(random):
    """Vertices and faces of a bumpy grid with fins below; some faces wind the other way, in a random order."""
    step = np.linspace(-1, 1, SIDE)
    vertices = [(x, y, random.uniform(-0.15, 0.15)) for y in step for x in step]
    corners = [j * SIDE + i for j in range(SIDE - 1) for i in range(SIDE - 1)]
    faces = [(k, k + 1, k + SIDE + 1, k + SIDE) for k in corners]
    for k in random.choice(corners, 4, replace=False).tolist():
        vertices += [(x, y, z - 1) for x, y, z in vertices[k : k + 2]]
        faces.append((k, k + 1, len(vertices) - 1, len(vertices) - 2))
    faces = [face[::-1] if random.random() < 0.3 else face for face in faces]
    return vertices, [faces[k] for k in random.permutation(len(faces))]


@pytest.mark.parametrize("is_custom", [False, pytest.param(True, marks=pytest.mark.full)])
def test_normals_end_where_they_do_in_cycles(camera_scene, blender, is_custom):
    random, data = np.random.default_rng(1), blender.data
    dull = data.materials.new("Dull")  # Cycles bends the normals of what reflects
    if blender.app.version < (5, 0):
        dull.use_nodes = True
    nodes = dull.node_tree.nodes
    dull.node_tree.links.new(nodes.new("ShaderNodeBsdfDiffuse").outputs[0], nodes["Material Output"].inputs[0])
    for k in range(GRIDS):
        mesh = data.meshes.new("Grid")
        vertices, faces = bumpy(random)
        mesh.from_pydata(vertices, [], faces)
        mesh.polygons.foreach_set("use_smooth", random.random(len(faces)) > 0.2 * (k % 2))
        sharp = mesh.attributes.new("sharp_edge", "BOOLEAN", "EDGE")
        sharp.data.foreach_set("value", random.random(len(mesh.edges)) < 0.2)
        if is_custom:
            mesh.normals_split_custom_set([(*random.uniform(-0.5, 0.5, 2), 1) for _ in mesh.loops])
        mesh.update()
        mesh.materials.append(dull)
        item = data.objects.new("Grid", mesh)
        item.location = 2.2 * (k % 3) - 2.2, 2.2 * (k // 3) - 1.1, 0
        item.pass_index = k + 1
        camera_scene.collection.objects.link(item)
    camera = camera_scene.camera
    camera.location, camera.rotation_euler = (0, 0, 5), (0, 0, 0)
    camera.data.type, camera.data.ortho_scale = "ORTHO", 6.8
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 204, 136
    ours = cast(read_camera(camera_scene), read_shapes(camera_scene), passes=("normal", "object_index"))
    theirs = cycles_truth(camera_scene)
    both = (ours["object_index"] == theirs["object_index"]) & (ours["object_index"] > 0)
    off = np.linalg.norm(ours["normal"] - theirs["normal"], axis=-1) > 0.02
    assert both.mean() > 0.7
    assert (off & both).mean() < 0.005  # pixels at the edges of faces
