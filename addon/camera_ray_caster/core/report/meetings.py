"""Where one ray meets the shapes of a scene: every place, each by the plain equation of its shape.

It shares nothing with the search, and does nothing to be fast: it is there to be read.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..camera.camera import Camera
from ..records import INFINITE_PLANE, MESH, SPHERE, Shapes

MOST = 12
"""Places of one mesh that are listed."""


@dataclass(frozen=True)
class Place:
    """One place where the ray meets a shape."""

    t: float
    """The distance from the ray's origin, in Blender units; negative behind it."""
    what: str
    """Of a mesh, which face; else empty."""
    objection: str
    """Why it does not count; empty where it counts."""


@dataclass(frozen=True)
class Meeting:
    """What the ray and a shape have to do with each other."""

    shape: int
    """The row in ``Shapes``."""
    name: str
    equation: tuple[str, ...]
    """Lines: the ray in the shape's own frame, the equation of t, its roots."""
    places: tuple[Place, ...]
    """In the order of t."""


def meetings(camera: Camera, shapes: Shapes, origin: np.ndarray, direction: np.ndarray) -> list[Meeting]:
    """Return the shapes that a ray (3,), (3,), world, unit length, meets anywhere on its line, the nearest first.

    A place counts between the clip distances (depths for planar models) and on the shape's own surface.
    """
    depth = float(-(np.linalg.inv(camera.pose.basis) @ direction)[2]) if camera.model.planar else 1.0
    found = []
    for k in range(len(shapes)):
        axes = shapes.axes[k]
        if shapes.kind[k] != MESH or abs(np.linalg.det(axes)) > 0:
            at, along = np.linalg.solve(axes, np.stack((origin - shapes.center[k], direction), axis=1)).T
            equation, roots = EQUATIONS.get(int(shapes.kind[k]), _plane)(shapes, k, at, along)
            places = tuple(Place(t, what, _clipped(camera, t, t * depth)) for t, what in sorted(roots))
            if places:
                name = shapes.names[shapes.name_index[k]]
                found.append(Meeting(k, name, equation, places))
    return sorted(found, key=lambda meeting: min((p.t for p in meeting.places if not p.objection), default=np.inf))


def nearest(met: list[Meeting]) -> tuple[Meeting, Place] | None:
    """Return the place that is seen: the nearest of those that count."""
    counted = [(meeting, place) for meeting in met for place in meeting.places if not place.objection]
    return min(counted, key=lambda pair: pair[1].t, default=None)


def _sphere(shapes, k, at, along):
    a, b, c = along @ along, 2 * (at @ along), at @ at - 1
    under = b * b - 4 * a * c
    lines = (
        f"own frame, where it is the unit sphere: |p + t d|² = 1, p = {words(at)}, d = {words(along)}",
        f"{a:.6g} t² {b:+.6g} t {c:+.6g} = 0, discriminant {under:.6g}",
    )
    if under < 0:
        return lines, []
    q = -0.5 * (b + np.copysign(np.sqrt(under), b))  # the sum of two numbers of one sign cancels nothing
    return lines, [(float(t), "") for t in ({q / a, c / q} if q else {0.0})]


def _plane(shapes, k, at, along):
    endless = shapes.kind[k] == INFINITE_PLANE
    if along[2] == 0:
        return (), []
    t = float(-at[2] / along[2])
    x, y = (at + t * along)[:2]
    line = f"own frame, where it is z = 0: {at[2]:.6g} {along[2]:+.6g} t = 0 at x = {x:.6g}, y = {y:.6g}"
    return (line,), [(t, "")] if endless or max(abs(x), abs(y)) <= 1 else []


def _mesh(shapes, k, at, along):
    """Intersect with every triangle, by Cramer's rule (T. Möller and B. Trumbore, JGT 2 (1), 1997)."""
    mesh = shapes.meshes[shapes.mesh[k]]
    corners = (mesh.vertices - mesh.middle[:, None])[:, mesh.triangles]  # (3, 3, k): component, corner, triangle
    first, one, two = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across, beside = np.cross(along, two, axisb=0).T, at[:, None] - first
    turned = np.cross(beside.T, one.T).T
    with np.errstate(all="ignore"):  # triangles that are seen from their edge give NaN, which is no hit
        scale = 1 / (one * across).sum(axis=0)
        v, w = (beside * across).sum(axis=0) * scale, along @ turned * scale
        t = (two * turned).sum(axis=0) * scale
        hit = np.flatnonzero((v >= 0) & (w >= 0) & (v + w <= 1))
    hit = hit[np.argsort(np.abs(t[hit]))][:MOST]
    lines = (f"own frame: p + t d = (1 - v - w) A + v B + w C, p = {words(at)}, d = {words(along)}",)
    roots = [(float(t[i]), f"face {mesh.polygon[i]}, v = {v[i]:.4f}, w = {w[i]:.4f}") for i in hit]
    return lines, roots


EQUATIONS = {SPHERE: _sphere, MESH: _mesh}
"""How a ray meets the kinds of shapes that are no planes."""


def _clipped(camera: Camera, t: float, depth: float) -> str:
    """Return why a place at t does not count, at that depth or distance; empty where it does."""
    if t < 0:
        return "behind the ray's origin"
    if depth < camera.clip_start:
        return f"nearer than the clip start, {camera.clip_start:.6g}"
    return f"farther than the clip end, {camera.clip_end:.6g}" if depth > camera.clip_end else ""


def words(vector) -> str:
    """Return a vector in words."""
    return "(" + ", ".join(f"{component + 0.0:.6g}" for component in vector) + ")"
