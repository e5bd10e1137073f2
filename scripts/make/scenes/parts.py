"""Parts of the example scenes: meshes, points, lights and cameras, named and linked to the scene."""

from __future__ import annotations

from itertools import pairwise
from math import radians

import bmesh
import bpy
from mathutils import Vector

ENGINE = "CAMERA_RAY_CASTER"


def linear(hexadecimal: str) -> tuple[float, float, float, float]:
    """Return the linear RGBA of an sRGB color such as "e07a5f", by IEC 61966-2-1."""
    srgb = [int(hexadecimal[k : k + 2], 16) / 255 for k in (0, 2, 4)]
    return (*(c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in srgb), 1.0)


def material(color: str):
    """Return the Principled material of an sRGB color, made once; pass indices number the materials from 1."""
    result = bpy.data.materials.get(color)
    if result is None:
        result = bpy.data.materials.new(color)
        result.use_nodes = True
        result.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = linear(color)
        result.diffuse_color = linear(color)
        result.pass_index = len(bpy.data.materials)
    return result


def add(
    scene, name: str, data=None, location=(0, 0, 0), turn=(0, 0, 0), scale=(1, 1, 1), *, color="", index=0, parent=None
):
    """Add an object to the scene and return it; ``turn`` is Euler XYZ in degrees, ``index`` the pass index.

    The material belongs to the object, so that objects of different colors share their data.
    """
    thing = bpy.data.objects.new(name, data)
    thing.location, thing.scale = location, (scale,) * 3 if isinstance(scale, float | int) else scale
    thing.rotation_euler = [radians(angle) for angle in turn]
    thing.pass_index = index
    thing.parent = parent
    if color:
        if not data.materials:
            data.materials.append(None)
        thing.material_slots[0].link = "OBJECT"
        thing.material_slots[0].material = material(color)
    scene.collection.objects.link(thing)
    return thing


def mesh(shape: str, **arguments):
    """Return the mesh that ``bmesh.ops.create_{shape}`` makes, for example "monkey"; made once and shared."""
    name = " ".join([shape, *map(str, arguments.values())])
    if name not in bpy.data.meshes:
        built = bmesh.new()
        getattr(bmesh.ops, f"create_{shape}")(built, **arguments)
        built.to_mesh(bpy.data.meshes.new(name))
        built.free()
        bpy.data.meshes[name].shade_smooth()
    return bpy.data.meshes[name]


def uv_sphere(segments: int = 32, rings: int = 16):
    """Return the mesh of a unit sphere with poles."""
    return mesh("uvsphere", u_segments=segments, v_segments=rings, radius=1)


def ico_sphere(subdivisions: int = 3):
    """Return the mesh of a unit sphere made of triangles."""
    return mesh("icosphere", subdivisions=subdivisions, radius=1)


def square():
    """Return the mesh of the flat quad |x| <= 1, |y| <= 1."""
    return mesh("grid", x_segments=1, y_segments=1, size=1)


def points(positions, radii):
    """Return a mesh of loose vertices with a radius each, for ``spheres_of_points``."""
    data = bpy.data.meshes.new("points")
    data.from_pydata(positions, [], [])
    data.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", radii)
    return data


def spheres_of_points(thing) -> None:
    """Add geometry nodes that turn an object's vertices into a point cloud with their radii and its first material."""
    to_points, tree = geometry_nodes(thing, "GeometryNodeMeshToPoints", "GeometryNodeSetMaterial")
    radius = tree.nodes.new("GeometryNodeInputNamedAttribute")
    radius.inputs["Name"].default_value = "radius"
    tree.links.new(radius.outputs["Attribute"], to_points.inputs["Radius"])
    tree.nodes["Set Material"].inputs["Material"].default_value = thing.material_slots[0].material


def instances_of_points(thing, instance) -> None:
    """Add geometry nodes that put an instance of another object, with its scale, on each vertex of an object."""
    on_points, tree = geometry_nodes(thing, "GeometryNodeInstanceOnPoints")
    source = tree.nodes.new("GeometryNodeObjectInfo")
    source.inputs["Object"].default_value = instance
    source.inputs["As Instance"].default_value = True
    tree.links.new(source.outputs["Geometry"], on_points.inputs["Instance"])
    tree.links.new(source.outputs["Scale"], on_points.inputs["Scale"])


def geometry_nodes(thing, *kinds: str):
    """Add a chain of geometry nodes of these kinds to an object; return the first of these nodes and the node tree."""
    tree = bpy.data.node_groups.new("Points", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    chain = [tree.nodes.new(kind) for kind in ("NodeGroupInput", *kinds, "NodeGroupOutput")]
    for left, right in pairwise(chain):
        tree.links.new(left.outputs[0], right.inputs[0])
        right.location = left.location.x + 200, 0
    thing.modifiers.new("Points", "NODES").node_group = tree
    return chain[1], tree


def camera(scene, location, target=(0, 0, 0), *, type="PERSP", **settings):
    """Add the scene's camera, which looks at ``target`` with world Z up; ``settings`` are Blender's."""
    data = bpy.data.cameras.new("Camera")
    data.type = type
    for name, value in settings.items():
        setattr(data, name, value)
    made = add(scene, "Camera", data, location)
    made.rotation_euler = (Vector(target) - made.location).to_track_quat("-Z", "Y").to_euler()
    scene.camera = made
    return made


def sun(scene, turn, energy: float, color: str = "ffffff"):
    """Add sunlight along the -Z axis turned by Euler angles in degrees; energy in W/m^2."""
    data = bpy.data.lights.new("Sun", "SUN")
    data.energy, data.color = energy, linear(color)[:3]
    return add(scene, "Sun", data, (0, 0, 8), turn)


def lamp(scene, location, energy: float, color: str = "ffffff"):
    """Add a point light; energy in W."""
    data = bpy.data.lights.new("Lamp", "POINT")
    data.energy, data.color = energy, linear(color)[:3]
    return add(scene, "Lamp", data, location)


def render(scene, width: int = 640, height: int = 360, world: str = "8d99ae", **settings) -> None:
    """Set the engine, the picture's size, other render settings, the background and the view layers' passes."""
    scene.render.engine = ENGINE
    scene.render.resolution_x, scene.render.resolution_y = width, height
    for name, value in settings.items():
        setattr(scene.render, name, value)
    scene.render.dither_intensity = 0
    scene.view_settings.view_transform = "Standard"
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = linear(world)[:3]
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = linear(world)
    for layer in scene.view_layers:
        for name in ("combined", "z", "normal", "position", "object_index"):
            setattr(layer, f"use_pass_{name}", True)
