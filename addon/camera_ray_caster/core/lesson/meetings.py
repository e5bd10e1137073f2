"""All intersections of one ray with the shapes of a scene, each from the plain equation of its shape.

The code is independent of the search for hits. It is written to be read; only boxes that the line misses are left out.
"""

from dataclasses import dataclass

import numpy as np

from ..camera.camera import Camera
from ..maths.vector import cross, inverse, norm
from ..records import INFINITE_PLANE, MESH, PLANE, SPHERE, Shapes
from ..shapes.cutouts import Cutouts, crossings
from ..shapes.in_camera import in_camera
from ..shapes.kinds import by_kind
from ..shapes.mesh.mesh_surface import TRIANGLES, HitTriangles
from ..tuning import MESH_BLOCK
from .formula import NOISE, digits, shown

MOST_INTERSECTIONS = 12
"""Maximum number of intersections listed per mesh."""

SLACK = 1e-6
"""Fraction of a box's size by which a line may miss it and is looked at all the same: far above any rounding."""


@dataclass(frozen=True)
class Crossing:
    """One intersection of the ray with a shape."""

    t: float
    """Distance from the ray's origin in Blender units; negative behind the origin."""
    face: str
    """Face of a mesh; empty for other shapes."""
    objection: str
    """Reason why the intersection does not count; empty if it counts."""


@dataclass(frozen=True)
class Meeting:
    """Intersections of the ray with one shape."""

    shape: int
    """Row in ``Shapes``."""
    name: str
    equation: tuple[str, ...]
    """Lines: the ray in the shape's own frame, the equation of t, its roots."""
    places: tuple[Crossing, ...]
    """Intersections in the order of t."""


def meetings(camera: Camera, shapes: Shapes, origin: np.ndarray, direction: np.ndarray) -> list[Meeting]:
    """Return the shapes that the line of a ray intersects, ordered by their nearest intersection that counts.

    origin, direction: (3,) each, in the world; the direction has unit length. An intersection is a point of the shape's
    own surface. It counts if it is in front of the origin and between the clip distances (depths for planar models).
    """
    depth = float(-(np.linalg.inv(camera.pose.basis) @ direction)[2]) if camera.model.planar else 1.0
    result = []
    transparent = _Transparent(camera, shapes)

    def along_ray(t: float) -> np.ndarray:
        return origin + t * direction - camera.pose.eye

    whole = np.flatnonzero((shapes.kind != MESH) | (np.abs(np.linalg.det(shapes.axes)) > 0))
    ray = np.stack((origin - shapes.center[whole], np.broadcast_to(direction, (len(whole), 3))), axis=2)
    local = np.linalg.solve(shapes.axes[whole], ray)  # all at once: a call takes as long as some hundred solutions
    near = _pass(local[..., 0].T, local[..., 1].T, _half_sizes(shapes, whole))
    for k, (at, along) in zip(whole[near].tolist(), local[near].swapaxes(1, 2), strict=True):
        equation, roots = EQUATIONS[int(shapes.kind[k])](shapes, k, at, along)
        places = tuple(
            Crossing(t, face, _clipped(camera, t, t * depth) or transparent(k, triangle, t, along_ray(t)))
            for t, face, triangle in sorted(roots)
        )
        if places:
            name = shapes.names[shapes.name_index[k]]
            result.append(Meeting(k, name, equation, places))
    return sorted(result, key=lambda meeting: min((p.t for p in meeting.places if not p.objection), default=np.inf))


def nearest(met: list[Meeting]) -> tuple[Meeting, Crossing] | None:
    """Return the visible intersection, the nearest that counts, with its shape; None if there is none."""
    counted = [(meeting, crossing) for meeting in met for crossing in meeting.places if not crossing.objection]
    return min(counted, key=lambda pair: pair[1].t, default=None)


def _pass(at, along, half) -> np.ndarray:
    """Return whether lines at + t along, (3, n) or (3, 1) each, pass boxes about 0 with these half sizes, (3, n); (n,)
    bool. A line passes a box that it misses by a millionth of its size.

    Reference: S. Gottschalk, M. Lin and D. Manocha, OBBTree (1996): the nine axes of a line and a box.
    """
    x, y, z = (np.abs(component) for component in along)
    beside, (a, b, c) = np.abs(cross(at, along)), half * (1 + SLACK)
    with np.errstate(invalid="ignore"):  # of an endless box, NaN: it is passed
        return ~((beside[0] > b * z + c * y) | (beside[1] > c * x + a * z) | (beside[2] > a * y + b * x))


def _half_sizes(shapes: Shapes, at: np.ndarray) -> np.ndarray:
    """Return half the sides of the boxes of shapes in their own frames, (3, n): endless but for meshes."""
    half = np.full((3, len(at)), np.inf)
    for i in np.flatnonzero(shapes.kind[at] == MESH).tolist():
        half[:, i] = shapes.meshes[shapes.mesh[at[i]]].half_size
    return half


def _sphere(shapes, k, at, along):
    a, b, c = along @ along, 2 * (at @ along), at @ at - 1
    under = b * b - 4 * a * c
    length, away = np.sqrt(a), np.sqrt(c + 1)
    noise = NOISE * 2 * length * away, NOISE * (c + 2), NOISE * 4 * a * (away + 1) ** 2
    lines = (
        f"own frame, where it is the unit sphere: |p + t d|² = 1, p = {shown(at)}, d = {shown(along)}",
        f"{digits(a)} t² {digits(b, '+', noise[0])} t {digits(c, '+', noise[1])} = 0, "
        f"discriminant {digits(under, noise=noise[2])}",
    )
    if under < 0:
        return lines, []
    q = -0.5 * (b + np.copysign(np.sqrt(under), b))  # adding two numbers of the same sign causes no cancellation
    return lines, [(float(t), "", -1) for t in ({q / a, c / q} if q else {0.0})]


def _plane(shapes, k, at, along):
    endless = shapes.kind[k] == INFINITE_PLANE
    if along[2] == 0:
        return (), []
    t = float(-at[2] / along[2])
    x, y = (at + t * along)[:2]
    noise, far = NOISE * norm(at), NOISE * (norm(at) + abs(t) * norm(along))
    position = f"x = {digits(x, noise=far)}, y = {digits(y, noise=far)}"
    z = f"{digits(at[2], noise=noise)} {digits(along[2], '+', NOISE * norm(along))} t"
    line = f"own frame, where it is z = 0: {z} = 0 at {position}"
    return (line,), [(t, "", -1)] if endless or max(abs(x), abs(y)) <= 1 else []


def _mesh(shapes, k, at, along):
    """Intersect with every triangle of the blocks that the line passes, by Cramer's rule (T. Möller and B. Trumbore,
    JGT 2 (1), 1997).
    """
    mesh = shapes.meshes[shapes.mesh[k]]
    middles, half = mesh.blocks
    passed = np.flatnonzero(_pass(at[:, None] - middles, along[:, None], half))
    candidates = (passed[:, None] * MESH_BLOCK + np.arange(MESH_BLOCK)).ravel()
    candidates = candidates[candidates < len(mesh)]
    if not len(candidates):
        return (), []
    triangles = mesh.triangles[:, candidates]
    corners = mesh.vertices[:, triangles] - mesh.middle[:, None, None]  # (3, 3, k): component, corner, triangle
    first, edge, other_edge = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across, beside = np.cross(along, other_edge, axisb=0).T, at[:, None] - first
    turned = np.cross(beside.T, edge.T).T
    with np.errstate(all="ignore"):  # triangles seen edge-on give NaN, which is no hit
        scale = 1 / (edge * across).sum(axis=0)
        v, w = (beside * across).sum(axis=0) * scale, along @ turned * scale
        t = (other_edge * turned).sum(axis=0) * scale
        hit = np.flatnonzero((v >= 0) & (w >= 0) & (v + w <= 1))
    hit = hit[np.argsort(np.abs(t[hit]))][:MOST_INTERSECTIONS]
    lines = (f"own frame: p + t d = (1 - v - w) A + v B + w C, p = {shown(at)}, d = {shown(along)}",)
    roots = []
    for i in hit:
        named = ", ".join(f"{name} = {shown(corner)}" for name, corner in zip("ABC", corners[:, :, i].T, strict=True))
        text = f"face {mesh.polygon[candidates[i]]}, {named}, v = {v[i]:.4f}, w = {w[i]:.4f}"
        roots.append((float(t[i]), text, int(candidates[i])))
    return lines, roots


EQUATIONS = {SPHERE: _sphere, PLANE: _plane, INFINITE_PLANE: _plane, MESH: _mesh}
"""How a ray meets each kind of shape."""


class _Transparent:
    """Tells which intersections are on transparent points of a surface."""

    def __init__(self, camera: Camera, shapes: Shapes):
        self._placed = in_camera(shapes, camera.pose) if shapes.surfaces else None

    def __call__(self, k: int, triangle: int, t: float, point: np.ndarray) -> str:
        """Return the reason why an intersection with shape k, at a point relative to the eye, does not count; empty if
        it counts.
        """
        if self._placed is None:
            return ""
        (kind, _), at = next(by_kind(self._placed.shapes.kind[[k]])), np.array([k])
        cutouts = Cutouts.of(kind, self._placed, at)
        if cutouts is None:
            return ""
        triangles = HitTriangles(self._placed, np.zeros(1, int), at, np.array([triangle]), False)
        pixels = crossings(at, np.array([t]), False, **{TRIANGLES: triangles})
        return "" if cutouts.hit(pixels, inverse(self._placed.pose.basis) @ point[:, None])[0] else TRANSPARENT


TRANSPARENT = "transparent there: its alpha is below the Alpha Threshold"


def _clipped(camera: Camera, t: float, depth: float) -> str:
    """Return the reason why an intersection at t, at this depth or distance, does not count; empty if it counts."""
    if t < 0:
        return "behind the ray's origin"
    if depth < camera.clip_start:
        return f"nearer than the clip start, {digits(camera.clip_start)}"
    return f"farther than the clip end, {digits(camera.clip_end)}" if depth > camera.clip_end else ""
