"""Triangles of a mesh that bends, each at a time of its own, to the bits of ``deformation``."""

import numpy as np

from ..mesh import LooseTriangles
from .apart import LOOPS, mesh_of
from .deformation import unit
from .evaluations import Motion
from .means import mean


def triangles_at(motion: Motion, row: int, number: np.ndarray, frames: np.ndarray) -> LooseTriangles:
    """Return triangles of the mesh of a shape, (k,) by number, each as it is at a frame of its own, (k,)."""
    mesh = mesh_of(next(iter(motion.states.values()))[1], row)
    loops = np.zeros((3, len(number)), np.int32) if mesh.loops is None else mesh.loops[:, number]
    middle, places = np.empty((3, len(number))), np.empty((3, 3, len(number)))
    at_loops = {name: np.empty((3, len(number), getattr(mesh, name).shape[1]))
                for name in LOOPS if getattr(mesh, name) is not None}  # fmt: skip
    for interval, within in motion.parts(frames):
        forms = [mesh_of(shapes, row) for _, shapes in interval.states]
        weights, corners = interval.weights(frames[within]), mesh.triangles[:, number[within]]
        middle[:, within] = mean([form.middle[:, None] for form in forms], weights)
        places[..., within] = mean([form.vertices[:, corners] - form.middle[:, None, None] for form in forms], weights)
        places[..., within] += middle[:, None, within]
        for name, values_of in at_loops.items():
            values = [getattr(form, name)[loops[:, within]] for form in forms]
            between = np.broadcast_to(
                mean(values, [weight[:, None].astype(values[0].dtype) for weight in weights]), values[0].shape
            )
            values_of[:, within] = unit(between) if name == "normals" else between
        for frame, form in zip(interval.frames, forms, strict=True):
            now = within[frames[within] == frame]
            middle[:, now] = form.middle[:, None]
            places[..., now] = form.vertices[:, mesh.triangles[:, number[now]]]
            for name, values_of in at_loops.items():
                values_of[:, now] = getattr(form, name)[loops[:, now]]
    each = np.arange(3 * len(number), dtype=np.int32).reshape(3, -1)
    return LooseTriangles(
        places.reshape(3, -1), each, mesh.polygon[number], None if mesh.loops is None else each,
        **{name: values_of.reshape(-1, values_of.shape[2]) for name, values_of in at_loops.items()},
        slot=None if mesh.slot is None else mesh.slot[number],
        layers=tuple((name, values[:, number]) for name, values in mesh.layers),
        middle_of=middle, outer=mesh.is_outer[:, number],
    )  # fmt: skip
