"""Instances and points that come and go at a constant number are known by Blender's numbers, not by their places."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.read import read_scene
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.motion.interpolation import matched
from camera_ray_caster.core.motion.matching import rows_in

from .scene_parts import ball, geometry_nodes, new_object


@pytest.fixture
def scene(camera_scene):
    """A camera that sees 20 units, 4 pixels a unit, from above."""
    camera = camera_scene.camera
    camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 20, (0, 0, 10)
    camera_scene.render.resolution_x = camera_scene.render.resolution_y = 80
    return camera_scene


def moves(read):
    """How far each shape moves to the next frame; NaN where it goes."""
    rows = rows_in(read.shapes, read.next.shapes)
    there = np.where((rows >= 0)[:, None], read.next.shapes.center[rows], np.nan)
    return there - read.shapes.center


@pytest.mark.parametrize("kind", ["instances", pytest.param("points", marks=pytest.mark.full)])
def test_points_with_an_id_are_the_points_of_that_id(scene, kind):
    """Five points with the IDs frame .. frame + 4 at x = ID: one goes and one comes in each frame, and all stand."""
    dot, carrier = ball("Dot", radius=0.3), new_object("Points", bpy.data.meshes.new("None"))
    dot.location.x = 50

    def build(new, link, mesh):
        points, index, time, number, combined, named = (
            new(f"GeometryNode{name}" if name[0] != "S" or name == "SetID" else f"ShaderNode{name[1:]}")
            for name in ("Points", "InputIndex", "InputSceneTime", "SMath", "SCombineXYZ", "SetID")
        )
        points.inputs["Count"].default_value, points.inputs["Radius"].default_value = 5, 0.3
        link(index.outputs[0], number.inputs[0])
        link(time.outputs["Frame"], number.inputs[1])
        link(number.outputs[0], combined.inputs["X"])
        link(combined.outputs[0], points.inputs["Position"])
        link(points.outputs[0], named.inputs[0])
        link(number.outputs[0], named.inputs["ID"])
        if kind == "points":
            return named.outputs[0]
        info, scatter = new("GeometryNodeObjectInfo"), new("GeometryNodeInstanceOnPoints")
        info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = dot, True
        link(named.outputs[0], scatter.inputs["Points"])
        link(info.outputs["Geometry"], scatter.inputs["Instance"])
        return scatter.outputs[0]

    geometry_nodes(carrier, build)
    read = read_scene(scene, frame=2, passes=("flow_forward", "flow_hidden"))
    here = read.shapes.center[:, 0] < 20
    assert sorted(read.shapes.center[here, 0]) == [2, 3, 4, 5, 6]
    gone = here & (read.shapes.center[:, 0] == 2)
    away = moves(read)
    np.testing.assert_array_equal(away[here & ~gone], 0)
    assert np.isnan(away[gone]).all()
    assert not matched(read.shapes, read.next.shapes), "between the frames they are other shapes"
    flow = cast(read.camera, read.shapes, passes=("flow_forward", "shape_index"), dtype=float)
    row = flow["shape_index"]
    np.testing.assert_allclose(flow["flow_forward"][(row >= 0) & ~gone[row]], 0, atol=1e-9)
    assert np.isnan(flow["flow_forward"][(row >= 0) & gone[row]]).all()


def test_particles_are_those_that_blender_numbers(scene):
    """Each lives for five frames, and one is born in each frame; the witness is Blender's own list of particles."""
    dot = ball("Dot", radius=4)
    dot.location.x = 50
    bpy.ops.mesh.primitive_plane_add(size=8)
    emitter = bpy.context.object
    bpy.ops.object.particle_system_add()
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_end, settings.lifetime = 30, 31, 5
    settings.render_type, settings.instance_object = "OBJECT", dot
    with bpy.context.temp_override(point_cache=emitter.particle_systems[0].point_cache):
        bpy.ops.ptcache.bake(bake=True)

    def places(frame):
        scene.frame_set(frame)
        system = emitter.evaluated_get(bpy.context.evaluated_depsgraph_get()).particle_systems[0]
        return {
            k: tuple(particle.location)
            for k, particle in enumerate(system.particles)
            if particle.alive_state == "ALIVE"
        }

    here, there = places(12), places(13)
    assert len(here) == len(there) > 3
    assert here.keys() != there.keys()
    read = read_scene(scene, frame=12, passes=("flow_forward",))
    away, seen = moves(read), 0
    for center, move in zip(read.shapes.center, away, strict=True):
        (number,) = [k for k, location in here.items() if np.allclose(location, center, atol=1e-5)] or [None]
        if number is not None:
            seen += 1
            expected = np.subtract(there.get(number, (np.nan,) * 3), here[number])
            np.testing.assert_allclose(move, expected, atol=1e-5)
    assert seen == len(here)
