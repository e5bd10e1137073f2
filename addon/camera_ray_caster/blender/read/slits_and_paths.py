"""Slits and paths, copied from Blender: points in an object's space and the object's world matrix."""

import numpy as np

from ...core.cameras.parts.settings import Line

X_AXIS = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))


def line_record(setting: Line, item, depsgraph):
    """Return the line of an object, as the depsgraph evaluated it; see ``core.cameras.parts.lines``.

    The line is (points, matrix_world), with the first and the last control point of a curve's first spline, or the ends
    of any other object's X axis. For a ``sampled`` setting it is (points, matrix_world, edges), as Blender samples the
    curve. None for a sampled object that is not a curve, and if Blender does not evaluate the object: a setting may
    still refer to an object deleted from the scene, and the matrix of an object that is disabled, for renders or in
    viewports, is not up to date.
    """
    evaluated = _evaluated(item, depsgraph.view_layer_eval.objects) if item else None
    if evaluated is None:
        return None
    return _sampled(evaluated) if setting.sampled else _ends(evaluated)


def _evaluated(item, objects):
    """Return an object as a view layer has evaluated it; None if it has not. Linked objects may have the same name."""
    namesake = objects.get(item.name)
    if namesake is None or namesake.original == item.original:
        return namesake
    return next((candidate for candidate in objects if candidate.original == item.original), None)


def _ends(item):
    """Return the two ends of an object's line, and its matrix; no points for a curve without any."""
    ends = X_AXIS
    if item.type == "CURVE":
        splines = item.data.splines
        points = (splines[0].bezier_points or splines[0].points) if splines else ()
        ends = [tuple(points[k].co)[:3] for k in (0, -1)] if points else ()
    return np.array(ends, np.float64).reshape(-1, 3), np.array(item.matrix_world, np.float64)


def _sampled(item):
    """Return a curve's sampled points, its matrix, and the edges between the points; None for any other object."""
    if item.type != "CURVE":
        return None
    mesh = item.to_mesh()  # None if no spline has two points
    counts = (len(mesh.vertices), len(mesh.edges)) if mesh else (0, 0)
    points, edges = np.empty((counts[0], 3), np.float32), np.empty((counts[1], 2), np.int32)
    if mesh:
        mesh.vertices.foreach_get("co", points.ravel())
        mesh.edges.foreach_get("vertices", edges.ravel())
        item.to_mesh_clear()
    return points.astype(np.float64), np.array(item.matrix_world, np.float64), edges
