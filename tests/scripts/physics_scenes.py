"""Small scenes with physics that are not baked, seen by a camera along y."""

from itertools import pairwise


def empty(bpy):
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    bpy.ops.object.camera_add(location=(0, -8, 1), rotation=(1.5708, 0, 0))
    scene.camera = bpy.context.object
    scene.render.resolution_x, scene.render.resolution_y = 32, 24
    return scene


def _named(bpy, name):
    bpy.context.object.name = name
    return bpy.context.object


def rigid_body(bpy):
    """A cube that falls onto a slope."""
    empty(bpy)
    bpy.ops.rigidbody.world_add()
    bpy.ops.mesh.primitive_cube_add(size=0.5, location=(0, 0, 2), rotation=(0.3, 0.2, 0.1))
    _named(bpy, "Body")
    bpy.ops.rigidbody.object_add()
    bpy.ops.mesh.primitive_plane_add(size=6, rotation=(0.2, 0, 0))
    bpy.ops.rigidbody.object_add()
    bpy.context.object.rigid_body.type = "PASSIVE"


def cloth(bpy):
    """A cloth that falls onto a ball."""
    empty(bpy)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=6, y_subdivisions=6, size=2, location=(0, 0, 2))
    _named(bpy, "Body")
    bpy.ops.object.modifier_add(type="CLOTH")
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8, radius=0.7, location=(0.1, 0, 1))
    bpy.ops.object.modifier_add(type="COLLISION")


def particles(bpy):
    """Balls that fall from a plane, each for ten frames."""
    empty(bpy)
    bpy.ops.mesh.primitive_ico_sphere_add(radius=4, location=(50, 0, 0))
    ball = bpy.context.object
    bpy.ops.mesh.primitive_plane_add(size=2, location=(0, 0, 2))
    emitter = _named(bpy, "Body")
    bpy.ops.object.particle_system_add()
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_end, settings.lifetime, settings.brownian_factor = 30, 20, 10, 3
    settings.render_type, settings.instance_object = "OBJECT", ball


def nodes(bpy):
    """A cube that simulation nodes move and turn by the same step in each frame."""
    empty(bpy)
    bpy.ops.mesh.primitive_cube_add(size=1)
    tree = bpy.data.node_groups.new("Simulation", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    kinds = ("NodeGroupInput", "GeometryNodeSimulationInput", "GeometryNodeTransform", "GeometryNodeSimulationOutput",
             "NodeGroupOutput")  # fmt: skip
    steps = [tree.nodes.new(kind) for kind in kinds]
    steps[1].pair_with_output(steps[3])
    steps[2].inputs["Translation"].default_value = 0.03, 0, 0.07
    steps[2].inputs["Rotation"].default_value = 0.02, 0.01, 0.03
    for node, other in pairwise(steps):
        output = next(socket for socket in node.outputs if socket.type == "GEOMETRY")
        tree.links.new(output, next(socket for socket in other.inputs if socket.type == "GEOMETRY"))
    _named(bpy, "Body").modifiers.new("Simulation", "NODES").node_group = tree


KINDS = rigid_body, cloth, particles, nodes
