"""Solids of few vertices with Blender's modifiers, for furniture, houses and toys. Sizes are in meters."""

from __future__ import annotations

from hashlib import blake2b
from math import pi, radians

import bpy

from .parts import add, geometry_nodes, mesh


def modified(thing, kind: str, **settings):
    """Add a modifier with these settings to an object; return the object."""
    modifier = thing.modifiers.new(kind.title(), kind)
    for name, value in settings.items():
        setattr(modifier, name, value)
    return thing


def drawn(name: str, vertices, edges=(), faces=()):
    """Return a smooth-shaded mesh; equal meshes are made once and shared."""
    name = f"{name} {blake2b(repr((vertices, edges, faces)).encode(), digest_size=4).hexdigest()}"
    if name not in bpy.data.meshes:
        data = bpy.data.meshes.new(name)
        data.from_pydata(vertices, edges, faces)
        data.shade_smooth()
    return bpy.data.meshes[name]


def sheet(name: str, places, across: int):
    """Return the mesh of the quads between points that are given in rows of ``across`` points."""
    corners = [k for k in range(len(places) - across) if (k + 1) % across]
    return drawn(name, places, faces=[(k, k + 1, k + 1 + across, k + across) for k in corners])


def line(name: str, places):
    """Return the mesh of the edges from point to point: a profile for the Screw modifier."""
    return drawn(name, places, edges=[(k, k + 1) for k in range(len(places) - 1)])


def block(scene, name: str, size, location=(0, 0, 0), turn=(0, 0, 0), *, edge: float = 0.01, **look):
    """Add a centered box with the given size along x, y and z, with round edges."""
    return rounded(add(scene, name, box(size), location, turn, **look), edge)


def box(size):
    """Return the mesh of a centered box with the given size along x, y and z."""
    x, y, z = (side / 2 for side in size)
    corners = [(a * x, b * y, c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return drawn("box", corners, faces=sides)


def prism(scene, name: str, outline, depth: float, location=(0, 0, 0), turn=(0, 0, 0), *, edge: float = 0.01, **look):
    """Add a prism: an outline of (x, z), extruded by ``depth`` along y, with round edges."""
    count = len(outline)
    ends = [(x, y, z) for y in (-depth / 2, depth / 2) for x, z in outline]
    sides = [(k, (k + 1) % count, (k + 1) % count + count, k + count) for k in range(count)]
    faces = [tuple(range(count))[::-1], tuple(range(count, 2 * count)), *(side[::-1] for side in sides)]
    return rounded(add(scene, name, drawn(name, ends, faces=faces), location, turn, **look), edge)


def rounded(thing, edge: float):
    """Round an object's edges, if ``edge`` is not 0; flat faces keep flat shading."""
    if edge:
        return modified(thing, "BEVEL", width=edge, segments=2, harden_normals=True)
    return modified(thing, "EDGE_SPLIT")


def turned(scene, name: str, profile, location=(0, 0, 0), turn=(0, 0, 0), *, steps=48, sharp: float = 35, **look):
    """Add a solid of revolution of a profile of (radius, height); corners above ``sharp`` degrees stay sharp."""
    data = line(name, [(radius, 0, height) for radius, height in profile])
    thing = add(scene, name, data, location, turn, **look)
    modified(thing, "SCREW", steps=steps, render_steps=steps, use_merge_vertices=True, use_normal_calculate=True)
    return modified(thing, "EDGE_SPLIT", split_angle=radians(sharp))


def soft(scene, name: str, size, location=(0, 0, 0), turn=(0, 0, 0), *, crease: float = 0.6, **look):
    """Add a cushion: a subdivided box."""
    thing = add(scene, name, box(size), location, turn, **look)
    modified(thing, "BEVEL", width=(1 - crease) * min(size) / 2, segments=1)
    return modified(thing, "SUBSURF", levels=2, render_levels=2)


def monkey(scene, location, turn=(0, 0, 0), scale=1.0, *, levels: int = 2, **look):
    """Add a subdivided Suzanne that looks along -y."""
    thing = add(scene, "Suzanne", mesh("monkey"), location, turn, scale, **look)
    return modified(thing, "SUBSURF", levels=levels, render_levels=levels)


def repeated(thing, *steps):
    """Repeat an object by Array modifiers, each given as (count, offset); return the object."""
    for count, offset in steps:
        modified(thing, "ARRAY", count=count, use_relative_offset=False, use_constant_offset=True)
        thing.modifiers[-1].constant_offset_displace = offset
    return thing


def tube(scene, name: str, points, radius: float, location=(0, 0, 0), turn=(0, 0, 0), *, closed: bool = False, **look):
    """Add a round tube along a smooth curve through points."""
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions, data.bevel_depth, data.bevel_resolution, data.resolution_u = "3D", radius, 3, 8
    data.use_fill_caps = not closed
    spline = data.splines.new("BEZIER")
    spline.bezier_points.add(len(points) - 1)
    spline.use_cyclic_u = closed
    for point, at in zip(spline.bezier_points, points, strict=True):
        point.co, point.handle_left_type, point.handle_right_type = at, "AUTO", "AUTO"
    return add(scene, name, data, location, turn, **look)


def letters(scene, text: str, location=(0, 0, 0), turn=(0, 0, 0), *, size: float = 1.0, **look):
    """Add thick letters with round edges, centered on their baseline; they lie flat unless they are turned."""
    data = bpy.data.curves.new(text, "FONT")
    data.body, data.size, data.align_x = text, size, "CENTER"
    data.extrude, data.bevel_depth, data.bevel_resolution = 0.12 * size, 0.02 * size, 2
    return add(scene, text, data, location, turn, **look)


def blob(scene, name: str, balls, location=(0, 0, 0), turn=(0, 0, 0), *, resolution: float = 0.06, **look):
    """Add merging metaballs, each given as (x, y, z, radius)."""
    data = bpy.data.metaballs.new(name)
    data.resolution = data.render_resolution = resolution
    for *at, radius in balls:
        ball = data.elements.new()
        ball.co, ball.radius = at, radius
    return add(scene, name, data, location, turn, **look)


def scattered(thing, collection, density: float, seed: int = 0) -> None:
    """Add geometry nodes that scatter a collection's objects, each with a random turn, on an object's faces.

    The faces themselves are no longer shown: use another object for them.
    """
    spread, tree = geometry_nodes(thing, "GeometryNodeDistributePointsOnFaces", "GeometryNodeInstanceOnPoints")
    spread.inputs["Density"].default_value, spread.inputs["Seed"].default_value = density, seed
    on_points = tree.nodes["Instance on Points"]
    source, turn = tree.nodes.new("GeometryNodeCollectionInfo"), tree.nodes.new("FunctionNodeRandomValue")
    source.inputs["Collection"].default_value = collection
    source.inputs["Separate Children"].default_value = source.inputs["Reset Children"].default_value = True
    on_points.inputs["Pick Instance"].default_value = True
    turn.data_type = "FLOAT_VECTOR"
    turn.inputs["Max"].default_value = 0, 0, 2 * pi
    tree.links.new(source.outputs["Instances"], on_points.inputs["Instance"])
    tree.links.new(turn.outputs["Value"], on_points.inputs["Rotation"])


def assembled(scene, name: str, things):
    """Move objects to a new collection that is not linked to the scene; return the collection."""
    made = bpy.data.collections.new(name)
    for thing in things:
        scene.collection.objects.unlink(thing)
        made.objects.link(thing)
    return made


def stand(scene, collection, location, turn=(0, 0, 0), scale=(1, 1, 1)):
    """Add an instance of a collection at a place."""
    made = add(scene, collection.name, None, location, turn, scale)
    made.instance_type, made.instance_collection = "COLLECTION", collection
    return made
