"""Slits and paths as Blender has them: points in an object's space and its world matrix, copied, nothing computed."""

import numpy as np

X_AXIS = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))


def lines_record(own, depsgraph) -> dict[str, object]:
    """Return slit_1, slit_2 and path of a camera's own properties, as the depsgraph evaluated them.

    A slit is (points, matrix_world), with the first and the last control point of a curve's first spline, or the ends
    of any other object's X axis. A path is (points, matrix_world, edges) as Blender samples the curve. None for a path
    that is no curve, and where there is no object that Blender evaluates: one that was deleted from the scene is still
    referred to here, and one that is disabled, for renders or in viewports, is not where its matrix says.
    """
    found: dict[str, object] = {}
    for name, points in (("slit_1", _ends), ("slit_2", _ends), ("path", _sampled)):
        item = getattr(own, name)
        evaluated = depsgraph.view_layer_eval.objects.get(item.name) if item else None
        there = evaluated is not None and evaluated.original == item.original
        found[name] = points(evaluated) if there else None
    return found


def _ends(item):
    """Return the two ends of an object's line, and its matrix."""
    ends = X_AXIS
    if item.type == "CURVE":
        splines = item.data.splines
        points = (splines[0].bezier_points or splines[0].points) if splines else ()
        ends = [tuple(points[k].co)[:3] for k in (0, -1)] if points else ()
    return np.array(ends, np.float64).reshape(-1, 3), np.array(item.matrix_world, np.float64)


def _sampled(item):
    """Return a curve's sampled points, its matrix, and the edges between the points; None for what is no curve."""
    if item.type != "CURVE":
        return None
    mesh = item.to_mesh()
    points, edges = np.empty((len(mesh.vertices), 3), np.float32), np.empty((len(mesh.edges), 2), np.int32)
    mesh.vertices.foreach_get("co", points.ravel())
    mesh.edges.foreach_get("vertices", edges.ravel())
    item.to_mesh_clear()
    return points.astype(np.float64), np.array(item.matrix_world, np.float64), edges
