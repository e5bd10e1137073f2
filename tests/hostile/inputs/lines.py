"""Curves and empties as slits and as paths."""

from .parts import FLOATS, Hostile, new_object

COUNT = 240
MODELS = ("STRIP", "STRIP", "CROSS_SLIT", "PUSHBROOM", "PENCIL", "TWISTED_ORTHOGRAPHIC")


def make(chance, number, folder):
    """Give a model that looks through lines some that are none."""
    import bpy

    group = bpy.context.scene.camera.data.camera_ray_caster
    group.model = MODELS[number % len(MODELS)]
    group.follow_path = chance.random() < 0.5
    changes = [group.model, f"follow {group.follow_path}"]
    for name in ("slit_1", "slit_2", "path"):
        item = new_object(name, _curve(chance, changes) if chance.random() < 0.7 or name == "path" else None)
        item.location = [chance.choice((0.0, 0.0, 1.0, -1.0)) for _ in range(3)]
        if chance.random() < 0.4:
            field, axis, value = (
                chance.choice(("location", "scale", "rotation_euler")),
                chance.randrange(3),
                chance.choice(FLOATS),
            )
            getattr(item, field)[axis] = value
            changes.append(f"{name}.{field}[{axis}] = {value}")
        setattr(group, name, item)
        fate = chance.choice(("stays", "stays", "stays", "stays", "removed", "hidden", "unlinked"))
        if fate == "removed":
            bpy.data.objects.remove(item)
        elif fate == "hidden":
            item.hide_viewport = True
        elif fate == "unlinked":
            bpy.context.scene.collection.objects.unlink(item)
        changes.append(f"{name} {fate}")
    return Hostile(", ".join(changes))


def _curve(chance, changes):
    """Return a curve of no, one or several splines."""
    import bpy

    curve = bpy.data.curves.new("Curve", "CURVE")
    curve.dimensions = chance.choice(("2D", "3D", "3D"))
    for _ in range(chance.choice((0, 1, 1, 1, 2))):
        kind, count = chance.choice(("POLY", "BEZIER", "NURBS")), chance.choice((1, 2, 3, 5))
        spline = curve.splines.new(kind)
        points = spline.bezier_points if kind == "BEZIER" else spline.points
        points.add(count - 1)
        odd = chance.choice(FLOATS)
        places = [
            [odd if chance.random() < 0.1 else chance.uniform(-2, 2) for _ in range(3)] for _ in range(len(points))
        ]
        if chance.random() < 0.2:
            places = [places[0]] * len(places)
        for point, location in zip(points, places, strict=True):
            point.co = location if kind == "BEZIER" else (*location, chance.choice((1.0, 1.0, 1.0, 0.0, odd)))
        spline.use_cyclic_u = chance.random() < 0.3
        changes.append(f"{kind} of {count}, odd {odd}")
    for name in ("bevel_depth", "extrude", "offset"):
        if chance.random() < 0.1:
            setattr(curve, name, value := chance.choice(FLOATS))
            changes.append(f"{name} {value}")
    if chance.random() < 0.1:
        curve.resolution_u = 1
    return curve
