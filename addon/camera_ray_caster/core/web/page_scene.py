"""A scene of shapes as the page's scripts have it: balls, rectangles, and triangles in a tree of boxes.

The page's axes are x right, y up and z backward, of which Blender's z is up. Shapes are still, and show their colors
without textures.
"""

import base64
from typing import Any

import numpy as np

from ..camera.camera import Camera
from ..records import INFINITE_PLANE, MESH, PLANE, SPHERE, Shapes

MOST_FACETS = 20_000
"""Maximum number of triangles: the tree then takes 1.4 MB of text, and a picture in software a few seconds."""
MOST_BALLS, MOST_PLANES = 32, 16
"""Number of exact balls and planes: each takes places of which graphics cards have 224. Further ones are facets."""
SMALL_MESH, GRIDS = 36, (256, 128, 64, 32, 22, 16, 11, 8, 6, 4, 3, 2)
"""Meshes of at most SMALL_MESH triangles stay as they are; cells along each side of a mesh that is thinned out."""
LEAF = 4
"""Maximum number of triangles of a leaf."""
ENDLESS = 1e4
"""Half side of an infinite plane, in distances from the camera to the middle of the scene."""
UNIFORM = 1e-4
"""Largest difference of the axes of a ball, as part of them; others are ellipsoids, which become facets."""

PAGE = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""The page's axes from Blender's."""


SQUARE = np.array([[[-1, -1, 0], [1, -1, 0], [1, 1, 0]], [[-1, -1, 0], [1, 1, 0], [-1, 1, 0]]], float)
"""The triangles of a plane."""

Facets = tuple[np.ndarray, np.ndarray, int]
"""Triangles, (n, 3, 3), their colors, (n, 3), and the row of their shape."""


def scene_data(camera: Camera, shapes: Shapes) -> dict[str, Any]:
    """Return what the page's scripts know of a scene, as ``SCENE`` in ``room``, seen from a camera's place.

    ``coarser`` has the names of meshes whose vertices are thinned out, so that all fit, and ``left_out`` of those that
    do not fit then either, the largest ones.
    """
    eye, axes = PAGE @ camera.pose.eye, PAGE @ camera.pose.basis
    centers, frames = shapes.center @ PAGE.T, PAGE @ shapes.axes
    colors, names = shapes.color[:, :3].astype(float), [shapes.names[k] for k in shapes.name_index]
    limited = np.flatnonzero(shapes.kind != INFINITE_PLANE)
    away = np.linalg.norm(centers[limited] - eye, axis=1)
    scale = float(np.median(away)) / 5 if len(away) and np.median(away) > 0 else 1.0
    balls: list[dict[str, Any]] = []
    flats: list[dict[str, Any]] = []
    in_triangles = []
    for k in range(len(shapes)):
        lengths = np.linalg.norm(frames[k], axis=0)
        is_ball = shapes.kind[k] == SPHERE and np.ptp(lengths) <= UNIFORM * lengths.max()
        common = {"name": names[k], "center": _rounded(centers[k]), "color": _rounded(colors[k])}
        if is_ball and len(balls) < MOST_BALLS:
            balls.append({**common, "radius": float(lengths[0])})
        elif shapes.kind[k] in (PLANE, INFINITE_PLANE) and len(flats) < MOST_PLANES:
            size = ENDLESS * scale / lengths[:2] if shapes.kind[k] == INFINITE_PLANE else np.ones(2)
            flats.append({**common, "u": _rounded(frames[k][:, 0] * size[0]), "v": _rounded(frames[k][:, 1] * size[1])})
        else:
            in_triangles.append(k)
    meshes, coarser = _coarse([_facets(shapes, k) for k in in_triangles])
    parts, left_out, count = [], [], 0
    for triangles, color, k in sorted(meshes, key=lambda mesh: len(mesh[0])):
        count += len(triangles)
        if count > MOST_FACETS:
            left_out.append(names[k])
        elif len(triangles):
            parts.append((triangles, color, np.full(len(triangles), k)))
    low = [ball["center"][1] - ball["radius"] for ball in balls] + [flat["center"][1] for flat in flats]
    low += [float(triangles[..., 1].min()) for triangles, *_ in parts]
    return {
        "spheres": balls, "rectangles": flats, "turn": (0.0, 0.0), "height": 0.0, "near": 1e-5 * scale,
        "floor": min(low, default=float(eye[1])), "scale": scale, "still": True, "left_out": sorted(set(left_out)),
        "coarser": sorted({names[k] for k in coarser} - set(left_out)),
        "camera": {"eye": eye.tolist(), **{name: axes[:, k].tolist() for k, name in enumerate("uv")},
                   "w": (-axes[:, 2]).tolist()},
        **_tree(parts, names),
    }  # fmt: skip


def _rounded(values: np.ndarray) -> list[float]:
    return [float(f"{value:.9g}") for value in values]


def _facets(shapes: Shapes, k: int) -> Facets:
    """Return the triangles of a shape, in the page's axes."""
    if shapes.kind[k] == MESH:
        mesh = shapes.meshes[shapes.mesh[k]]
        places = (mesh.vertices.astype(np.float64) - mesh.middle[:, None]).T[mesh.triangles.T]
        color = np.broadcast_to(shapes.color[k, :3], (len(mesh), 3))
        if shapes.slots is not None and shapes.slots.first[k] >= 0:
            slot = np.zeros(len(mesh), np.intp) if mesh.slot is None else mesh.slot
            color = shapes.slots.color[shapes.slots.first[k] + slot, :3]
    else:
        places = _globe() if shapes.kind[k] == SPHERE else SQUARE
        color = np.broadcast_to(shapes.color[k, :3], (len(places), 3))
    return (shapes.center[k] + places @ shapes.axes[k].T) @ PAGE.T, color, k


def _coarse(meshes: list[Facets]) -> tuple[list[Facets], list[int]]:
    """Return meshes with at most MOST_FACETS triangles if they can be thinned out, and the rows of those that were.

    Of the vertices of a mesh in a cell of a grid over its bounding box one is kept, where it is.
    """
    total = sum(len(triangles) for triangles, _, _ in meshes)
    if total <= MOST_FACETS:
        return meshes, []
    for cells in GRIDS:
        thinner, coarser = [], []
        for triangles, color, k in meshes:
            if len(triangles) > SMALL_MESH:
                kept, corners = _thinned(triangles, cells)
                if kept.sum() < len(triangles):
                    triangles, color = corners[kept], color[kept]
                    coarser.append(k)
            thinner.append((triangles, color, k))
        if sum(len(triangles) for triangles, _, _ in thinner) <= MOST_FACETS:
            break
    return thinner, coarser


def _thinned(triangles: np.ndarray, cells: int) -> tuple[np.ndarray, np.ndarray]:
    """Return which triangles stay, (n,) bool, and all with the kept vertex of each cell for their corners."""
    flat = triangles.reshape(-1, 3)
    low, size = flat.min(axis=0), np.maximum(np.ptp(flat, axis=0), np.finfo(float).tiny)
    keys = np.minimum((flat - low) / size * cells, cells - 1).astype(np.int64) @ np.array([1, 1 << 10, 1 << 20])
    _, first, cell_of = np.unique(keys, return_index=True, return_inverse=True)
    cell_of = cell_of.reshape(-1, 3)
    ends = np.sort(cell_of, axis=1)
    single = np.zeros(len(ends), bool)
    single[np.unique(ends @ np.array([1, 1 << 20, 1 << 40]), return_index=True)[1]] = True
    return single & (np.diff(ends, axis=1) > 0).all(axis=1), flat[first][cell_of]


def _globe(around: int = 24, up: int = 12) -> np.ndarray:
    """Return the triangles of a unit sphere."""
    latitude, longitude = np.linspace(-np.pi / 2, np.pi / 2, up + 1)[:, None], np.linspace(0, 2 * np.pi, around + 1)
    parts = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude) + 0 * longitude
    p = np.stack(parts, axis=-1)
    halves = ((p[:-1, :-1], p[:-1, 1:], p[1:, 1:]), (p[:-1, :-1], p[1:, 1:], p[1:, :-1]))
    triangles = np.concatenate([np.stack(half, axis=2).reshape(-1, 3, 3) for half in halves])
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    return triangles[area > 1e-9]


def _tree(parts: list[tuple[np.ndarray, np.ndarray, np.ndarray]], names: list[str]) -> dict[str, Any]:
    """Return ``nodes``, ``triangles``, their numbers, ``names``, and ``facets``, texels of four float32 in base64.

    Each node has two texels: the low corner of its box and the node that follows if rays miss it; the high corner and,
    in a leaf, its first triangle times 8 plus their number, else -1. Nodes are in the order of a walk. Each triangle
    has three: a corner and its place in ``names``; two edges, the first with its color, 8 bits a channel, gamma 2.2.
    """
    if not parts:
        return {"nodes": 0, "triangles": 0, "names": [], "facets": ""}
    corners, colors, shape = (np.concatenate(several) for several in zip(*parts, strict=True))
    low, high, middle = corners.min(axis=1), corners.max(axis=1), corners.mean(axis=1)
    nodes: list[list[float]] = []
    order: list[np.ndarray] = []
    first = 0

    def add(members: np.ndarray) -> None:
        nonlocal first
        here = len(nodes)
        nodes.extend(([*low[members].min(axis=0), 0.0], [*high[members].max(axis=0), -1.0]))
        if len(members) <= LEAF:
            nodes[here + 1][3] = 8.0 * first + len(members)
            order.append(members)
            first += len(members)
        else:
            spread = np.ptp(middle[members], axis=0)
            members = members[np.argsort(middle[members, spread.argmax()], kind="stable")]
            add(members[: len(members) // 2])
            add(members[len(members) // 2 :])
        nodes[here][3] = len(nodes) / 2

    add(np.arange(len(corners)))
    sorted_ = np.concatenate(order)
    used, name_index = np.unique(shape[sorted_], return_inverse=True)
    bits = np.rint(255 * np.clip(colors[sorted_], 0, 1) ** (1 / 2.2)) @ (1.0, 256.0, 65536.0)
    a, b, c = (corners[sorted_, k] for k in range(3))
    texels = np.column_stack((a, name_index, b - a, bits, c - a, 0 * bits))
    data = np.concatenate((np.array(nodes), texels.reshape(-1, 4))).astype("<f4")
    return {
        "nodes": len(nodes) // 2, "triangles": len(corners), "names": [names[k] for k in used],
        "facets": base64.b64encode(data.tobytes()).decode(),
    }  # fmt: skip
