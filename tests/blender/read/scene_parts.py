"""Parts of scenes that the tests of the reader put together."""

from collections import Counter

import bpy

from camera_ray_caster.blender.read.depsgraph_shapes import shapes_record

ADD = bpy.ops.mesh


def new_object(name, data=None, collection=None):
    item = bpy.data.objects.new(name, data)
    (collection or bpy.context.scene.collection).objects.link(item)
    return item


def ball(name="Ball", collection=None, **options):
    """Return an object whose mesh is Blender's ico sphere, smooth."""
    ADD.primitive_ico_sphere_add(**options)
    made = bpy.context.object
    item = new_object(name, made.data, collection)
    item.data.shade_smooth()
    bpy.data.objects.remove(made)
    return item


def plain(name, color, index=0):
    """A material of one color, whether this Blender gives nodes to a new one or not; and its pass index."""
    material_data = bpy.data.materials.new(name)
    material_data.pass_index = index
    paint(material_data, color)
    return material_data


def paint(material, color):
    """Give such a material another color."""
    material.diffuse_color = color
    if bpy.app.version >= (5, 0):
        material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = color


def new_collection(name, *parents):
    collection = bpy.data.collections.new(name)
    for parent in parents:
        parent.children.link(collection)
    return collection


def geometry_nodes(item, build):
    """Give an object a geometry nodes modifier; ``build(nodes, link, mesh)`` returns the socket of the result."""
    tree = bpy.data.node_groups.new("Geometry", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    mesh, result = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    tree.links.new(build(tree.nodes.new, tree.links.new, mesh.outputs[0]), result.inputs[0])
    item.modifiers.new("Geometry", "NODES").node_group = tree


def curves(item):
    """The animation curves of an object, wherever this Blender keeps them."""
    action = item.animation_data.action
    if hasattr(action, "fcurves"):
        return action.fcurves
    return action.layers[0].strips[0].channelbag(item.animation_data.action_slot).fcurves


def mesh_of(*vertices):
    mesh = bpy.data.meshes.new("Vertices")
    mesh.from_pydata(vertices, [], [])
    return mesh


def counts(shapes):
    return Counter(shapes.names[index] for index in shapes.name_index)


def in_a_render(scene, frames=()):
    """Return what a render's depsgraph gives, the last one of those at some frames."""
    records = []

    class Engine(bpy.types.RenderEngine):
        bl_idname, bl_label = "READ_SHAPES_TEST", "Test"

        def render(self, depsgraph):
            records.append(shapes_record(depsgraph))
            for frame in frames:
                self.frame_set(frame, 0.0)
                records.append(shapes_record(depsgraph))

    scene.camera = scene.camera or new_object("Camera", bpy.data.cameras.new("Camera"))
    scene.render.resolution_x = scene.render.resolution_y = 8
    bpy.utils.register_class(Engine)
    try:
        scene.render.engine = Engine.bl_idname
        bpy.ops.render.render()
    finally:
        scene.render.engine = "CYCLES" if "CYCLES" in dir(scene) else "BLENDER_WORKBENCH"
        bpy.utils.unregister_class(Engine)
    return records[-1]
