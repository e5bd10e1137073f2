"""Meshes, point clouds and objects that no modeler leaves."""

from .parts import FLOATS, Hostile, new_object

COUNT = 210


def make(chance, number, folder):
    """Spoil the ball or the wall, in one of many ways."""
    import bpy

    scene = bpy.context.scene
    item = chance.choice([candidate for candidate in scene.objects if candidate.type == "MESH"])
    way = WAYS[number % len(WAYS)]
    item.camera_ray_caster.primitive = chance.choice(("AUTOMATIC", "AUTOMATIC", "SPHERE", "PLANE", "INFINITE_PLANE"))
    change = f"{item.name} as {item.camera_ray_caster.primitive}: {way.__name__[1:]} {way(chance, item, bpy)}"
    return Hostile(change)


def _place(chance, item, bpy):
    value = chance.choice(FLOATS)
    vertices = item.data.vertices
    many = chance.choice((1, len(vertices)))
    for vertex in chance.sample(list(vertices), many):
        axis = chance.randrange(3)
        vertex.co[axis] = value * chance.choice((1.0, 1.0, -1.0, 0.5))
    return f"{many} vertices at {value}"


def _transform(chance, item, bpy):
    name, value, axis = (
        chance.choice(("location", "scale", "rotation_euler")),
        chance.choice(FLOATS),
        chance.randrange(3),
    )
    getattr(item, name)[axis] = value
    if chance.random() < 0.3:
        item.scale = (value,) * 3
    return f"{name}[{axis}] = {value}"


def _thin(chance, item, bpy):
    size, axis = 10.0 ** chance.randint(-45, 38), chance.randrange(3)
    item.scale[axis] = size
    if chance.random() < 0.5:
        item.scale[(axis + 1) % 3] = other = 10.0 ** chance.randint(-30, 20)
        return f"scale {size} and {other}"
    return f"scale {size}"


def _indices(chance, item, bpy):
    mesh, index = item.data, chance.choice((-1, 10**6, 2**31 - 1, -(2**31), 0))
    which = chance.choice(("vertex_index", "edge_index", "edges", "loop_start"))
    if which == "edges":
        mesh.edges[chance.randrange(len(mesh.edges))].vertices = (index, 0)
    elif which == "loop_start":
        mesh.polygons[chance.randrange(len(mesh.polygons))].loop_start = index
    else:
        setattr(mesh.loops[chance.randrange(len(mesh.loops))], which, index)
    return f"{which} {index}"


def _attribute(chance, item, bpy):
    kind = chance.choice(("FLOAT", "INT", "FLOAT_VECTOR", "BOOLEAN"))
    name = chance.choice(("position", "radius", ".corner_vert", "sharp_face", "crease", "material_index", "UVMap"))
    try:
        attribute = item.data.attributes.new(name, kind, chance.choice(("POINT", "FACE", "CORNER")))
    except RuntimeError:
        return f"no {name}"
    if attribute is not None and kind == "INT" and len(attribute.data):
        attribute.data[0].value = 2**31 - 1
    return f"{name} {kind}"


def _empty(chance, item, bpy):
    how = chance.choice(("nothing", "a vertex", "an edge", "loose", "same", "line"))
    mesh = bpy.data.meshes.new("Empty")
    points, edges, faces = {
        "nothing": ([], [], []),
        "a vertex": ([(0, 0, 0)], [], []),
        "an edge": ([(0, 0, 0), (1, 0, 0)], [(0, 1)], []),
        "loose": ([(k, k * k, 0) for k in range(20)], [], []),
        "same": ([(0, 0, 0)] * 4, [], [(0, 1, 2, 3)]),
        "line": ([(k, 0, 0) for k in range(4)], [], [(0, 1, 2, 3)]),
    }[how]
    mesh.from_pydata(points, edges, faces)
    item.data = mesh
    return how


def _points(chance, item, bpy):
    cloud = bpy.data.pointclouds.new("Cloud")
    count = chance.choice((0, 1, 5))
    if hasattr(cloud, "resize"):
        cloud.resize(count)
    value, radius = chance.choice(FLOATS), chance.choice(FLOATS)
    for point in cloud.points:
        point.co = (value, 0, -5)
    radii = cloud.attributes.get("radius") or cloud.attributes.new("radius", "FLOAT", "POINT")
    for entry in radii.data if radii else ():
        entry.value = radius
    new_object("Cloud", cloud)
    return f"{len(cloud.points)} points at {value} of radius {radius}"


def _forced(chance, item, bpy):
    item.camera_ray_caster.primitive = chance.choice(("SPHERE", "PLANE", "INFINITE_PLANE"))
    return f"{_empty(chance, item, bpy)}, {_transform(chance, item, bpy)}"


def _parent(chance, item, bpy):
    parent = new_object("Parent", None)
    item.parent = parent
    sheared = parent.matrix_world.copy()
    sheared[chance.randrange(3)][chance.randrange(3)] = chance.choice(FLOATS)
    parent.matrix_world = sheared
    item.matrix_parent_inverse[chance.randrange(4)][chance.randrange(4)] = value = chance.choice(FLOATS)
    return f"parent's inverse {value}"


def _huge(chance, item, bpy):
    size = chance.choice((1e15, 1e18, 1e19, 1e20, 1e30, 3e38))
    item.scale = (size,) * 3
    item.location = (size * chance.choice((0, 1, -1)), 0, -size * chance.choice((0, 0.5, 2)))
    bpy.context.scene.camera.data.clip_end = chance.choice((1e3, 1e20, 3e38))
    return f"size {size}"


def _modifier(chance, item, bpy):
    array = item.modifiers.new("Array", "ARRAY")
    array.count, array.fit_type = 5, "FIXED_COUNT"
    array.relative_offset_displace[0] = value = chance.choice(FLOATS)
    return f"array {value}"


WAYS = (
    _place, _place, _transform, _transform, _thin, _thin, _indices, _attribute, _empty, _points, _forced, _parent,
    _huge, _modifier,
)  # fmt: skip
