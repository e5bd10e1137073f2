"""Meshes made by hand, in float32 as Blender stores them: what is a sphere or a plane, and what only looks like one."""

import numpy as np
import pytest

from camera_ray_caster.core.records import PLANE, SPHERE
from camera_ray_caster.core.shapes.instances import Primitive
from camera_ray_caster.core.shapes.recognize import MeshArrays, exclude, recognize

ULP = float(np.finfo(np.float32).eps)


def mesh(vertices, faces) -> MeshArrays:
    """Return a mesh of faces given as tuples of vertex numbers."""
    edges: dict[frozenset, int] = {}
    loop_edges = []
    for face in faces:
        for pair in zip(face, (*face[1:], face[0]), strict=True):
            loop_edges.append(edges.setdefault(frozenset(pair), len(edges)))
    sizes = [len(face) for face in faces]
    return MeshArrays(
        vertices=np.asarray(vertices, np.float32),
        loop_vertices=np.array([vertex for face in faces for vertex in face], np.int32),
        loop_edges=np.array(loop_edges, np.int32),
        loop_starts=np.cumsum([0, *sizes[:-1]]).astype(np.int32),
        edge_count=len(edges),
    )


def uv_sphere(segments=32, rings=16):
    """Return vertices and faces of a UV sphere of radius 1, poles first and last."""
    latitudes = np.pi * np.arange(1, rings) / rings
    longitudes = 2 * np.pi * np.arange(segments) / segments
    ring = [(np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)) for a in latitudes for b in longitudes]
    vertices = np.array([(0, 0, 1), *ring, (0, 0, -1)])
    around = [(k, (k + 1) % segments) for k in range(segments)]
    last = len(vertices) - 1
    faces = [(0, 1 + a, 1 + b) for a, b in around]
    for row in range(rings - 2):
        top, low = 1 + row * segments, 1 + (row + 1) * segments
        faces += [(top + a, low + a, low + b, top + b) for a, b in around]
    bottom = 1 + (rings - 2) * segments
    return vertices, faces + [(bottom + a, last, bottom + b) for a, b in around]


def prism(corners: int, height: float):
    angle = 2 * np.pi * np.arange(corners) / corners
    ring = np.column_stack([np.cos(angle), np.sin(angle)])
    vertices = np.vstack([np.c_[ring, np.full(corners, z)] for z in (-height / 2, height / 2)])
    around = [(k, (k + 1) % corners) for k in range(corners)]
    sides = [(a, b, corners + b, corners + a) for a, b in around]
    return vertices, [*sides, tuple(range(corners))[::-1], tuple(range(corners, 2 * corners))]


def turn(angle=0.7):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


SQUARE = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)


@pytest.mark.parametrize(("segments", "rings"), [(6, 4), (7, 5), (8, 4), (32, 16), (33, 17), (64, 32)])
@pytest.mark.parametrize("radius", [1e-3, 1.0, 3.7, 1e4])
def test_a_uv_sphere_has_the_radius_it_was_made_with(segments, rings, radius):
    vertices, faces = uv_sphere(segments, rings)
    recognized = recognize(mesh(radius * vertices, faces))
    assert isinstance(recognized, Primitive)
    assert recognized.kind == SPHERE
    # Each coordinate is rounded to float32; no more than three of them make a distance.
    np.testing.assert_allclose(recognized.axes, radius * np.eye(3), atol=2 * ULP * radius)
    np.testing.assert_array_equal(recognized.centers, 0)


@pytest.mark.parametrize("offset", [(1, 2, 3), (-500, 30, 0.1), (1e4, -1e4, 5)])
def test_an_applied_offset_and_turn_cost_what_float32_rounds_away(offset):
    vertices, faces = uv_sphere()
    recognized = recognize(mesh(vertices @ turn().T * 2 + offset, faces))
    assert isinstance(recognized, Primitive)
    rounding = ULP * np.abs(offset).max()
    np.testing.assert_allclose(recognized.centers[0], offset, atol=rounding)
    np.testing.assert_allclose(recognized.axes, 2 * np.eye(3), atol=2 * rounding + 4 * ULP)


def test_an_affine_matrix_applied_to_a_sphere_makes_the_ellipsoid_of_that_matrix():
    vertices, faces = uv_sphere()
    matrix = np.array([[1, 0.5, 0], [0, 2, 0.3], [0, 0, -0.2]])
    recognized = recognize(mesh(vertices @ matrix.T + (0, 3, 0), faces))
    assert isinstance(recognized, Primitive)
    # The axes are known up to a turn of the unit ball, which their product with their transpose does not see.
    np.testing.assert_allclose(recognized.axes @ recognized.axes.T, matrix @ matrix.T, atol=32 * ULP)
    np.testing.assert_allclose(recognized.centers, [[0, 3, 0]], atol=8 * ULP)


CUBE = prism(4, np.sqrt(2))
OCTAHEDRON = (
    np.vstack([np.eye(3), -np.eye(3)]),
    [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)],
)


@pytest.mark.parametrize("scale", [(1, 1, 1), (1, 2, 3)])
@pytest.mark.parametrize(
    "solid",
    [CUBE, OCTAHEDRON, prism(6, 1), prism(32, 2), prism(32, 0.5), prism(32, np.sqrt(2)), uv_sphere(4, 8)],
    ids=["cube", "octahedron", "hexagon", "cylinder", "disc", "widest cylinder", "four sides"],
)
def test_solids_with_their_corners_on_one_sphere_are_no_sphere(solid, scale):
    vertices, faces = solid
    assert "cut deep" in recognize(mesh(vertices * scale, faces))


def test_how_far_the_faces_of_a_sphere_and_an_ellipsoid_are_from_it():
    """A face of a UV sphere between two meridians and two parallels, with the middle of the equator's farthest in."""
    vertices, faces = uv_sphere(16, 8)
    lowest = np.cos(np.pi / 16) * np.cos(np.pi / 16)  # half a step along, half a step up
    for matrix in (np.eye(3), 100 * np.eye(3), np.diag([1, 2, 3])):
        recognized = recognize(mesh(vertices @ matrix, faces))
        corners = np.array([vertices[list(face)[:3]] for face in faces])
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        heights = np.abs((corners[:, 0] * normals).sum(axis=1)) / np.linalg.norm(normals, axis=1)
        assert recognized.apart == pytest.approx(1 - heights.min(), abs=8 * ULP)
        assert recognized.apart == pytest.approx(1 - lowest, abs=2e-3)
    assert recognize(mesh(SQUARE, [(0, 1, 2, 3)])).apart == 0


def test_large_meshes_are_excluded_by_some_of_their_vertices_and_shapes_are_not():
    vertices, faces = uv_sphere(64, 48)
    for matrix, offset in ((np.eye(3), (0, 0, 0)), (np.diag([1, 2, 3]), (5, 0, 0)), (turn() * 1e-3, (0, 1, 0))):
        assert exclude(mesh(vertices @ matrix + offset, faces)) == ""
    points, quads = grid(np.linspace(-1, 1, 50), np.linspace(-1, 1, 50))
    for matrix in (np.eye(3), turn()):
        assert exclude(mesh(points @ matrix, quads)) == ""
    dented = vertices * np.where(vertices[:, :1] > 0.5, 1.01, 1)
    wavy = points + np.c_[np.zeros((len(points), 2)), 0.01 * np.sin(7 * points[:, 0])]
    for array, polygons in ((dented, faces), (wavy, quads)):
        assert "not on one sphere" in exclude(mesh(array, polygons))


def test_a_sphere_with_a_face_missing_is_not_closed():
    vertices, faces = uv_sphere()
    assert "not closed" in recognize(mesh(vertices, faces[:-1]))


def test_half_a_sphere_is_no_sphere_open_or_doubled():
    vertices, faces = uv_sphere()
    half = faces[: len(faces) // 2]
    assert "not closed" in recognize(mesh(vertices, half))
    doubled = np.vstack([vertices, vertices])
    seam = range(1 + 7 * 32, 1 + 8 * 32)  # the ring where both sheets meet
    other = {k: k if k in seam else k + len(vertices) for k in range(len(vertices))}
    sheets = half + [tuple(other[k] for k in face[::-1]) for face in half]
    assert "do not cover the sphere exactly once" in recognize(mesh(doubled, sheets))


def test_one_vertex_out_of_place_is_seen():
    vertices, faces = uv_sphere()
    vertices[100] *= 1 + 1e-4
    assert "not on one sphere" in recognize(mesh(vertices, faces))


def test_a_sphere_that_rounding_has_eaten_is_named():
    vertices, faces = uv_sphere()
    assert "float32 rounding has destroyed its shape" in recognize(mesh(1e-3 * vertices + (100, 0, 0), faces))


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_vertices_that_are_not_finite_are_named(bad):
    vertices, faces = uv_sphere()
    vertices[3, 1] = bad
    assert "not all finite" in recognize(mesh(vertices, faces))


@pytest.mark.parametrize(
    ("axes", "offset"),
    [
        (np.eye(3), (0, 0, 0)),
        (np.diag([5, 0.1, 1]), (3, 4, 5)),
        (np.array([[1, 0.8, 0], [0, 0.5, 0], [0, 0.2, 1]]), (0, -2, 0)),
        (turn() * 3, (100, 0, 0)),
    ],
    ids=["square", "rectangle", "sheared", "turned"],
)
def test_a_parallelogram_is_the_image_of_the_unit_square(axes, offset):
    recognized = recognize(mesh(SQUARE @ axes.T + offset, [(0, 1, 2, 3)]))
    assert isinstance(recognized, Primitive)
    assert recognized.kind == PLANE
    rounding = 2 * ULP * (np.abs(axes).max() + np.abs(offset).max())
    np.testing.assert_allclose(recognized.axes[:, :2], axes[:, :2], atol=rounding)
    np.testing.assert_allclose(recognized.centers[0], offset, atol=rounding)
    normal = np.cross(axes[:, 0], axes[:, 1])
    np.testing.assert_allclose(recognized.axes[:, 2], normal / np.sqrt(np.linalg.norm(normal)), rtol=1e-4, atol=1e-5)


def grid(x, y):
    """Return a subdivided square with its lines at these places."""
    vertices = [(a, b, 0) for b in y for a in x]
    across = len(x)
    corners = [(j * across + i) for j in range(len(y) - 1) for i in range(across - 1)]
    return np.array(vertices, float), [(k, k + 1, k + across + 1, k + across) for k in corners]


def test_a_subdivided_or_triangulated_quad_is_the_quad():
    vertices, faces = grid([-1, -0.2, 0.7, 1], [-1, 0.5, 1])
    recognized = recognize(mesh(vertices @ turn().T, faces))
    assert isinstance(recognized, Primitive)
    assert abs(np.linalg.det(recognized.axes)) == pytest.approx(1, abs=1e-6)
    np.testing.assert_allclose(recognized.axes @ recognized.axes.T, np.eye(3), atol=1e-6)
    triangles = recognize(mesh(SQUARE, [(0, 1, 2), (0, 2, 3)]))
    assert isinstance(triangles, Primitive)
    np.testing.assert_array_equal(triangles.centers, 0)


def flat_with_a_hole():
    vertices, faces = grid([-1, -0.5, 0.5, 1], [-1, -0.5, 0.5, 1])
    return vertices, faces[:4] + faces[5:]


def folded():
    vertices, faces = grid([-1, 0.5, 1], [-1, 1])
    vertices[vertices[:, 0] == 0.5, 0] = 1.5  # runs past the edge and back
    return vertices, faces


@pytest.mark.parametrize(
    ("vertices", "faces", "reason"),
    [
        (SQUARE * [[1], [1], [0.5], [1]], [(0, 1, 2, 3)], "not a parallelogram"),
        (np.add(SQUARE, [[0, 0, 0.05], [0, 0, 0], [0, 0, 0], [0, 0, 0]]), [(0, 1, 2, 3)], "not flat"),
        (SQUARE[:3], [(0, 1, 2)], "3 corners"),
        (*flat_with_a_hole(), "holes or parts"),
        (np.vstack([SQUARE, np.add(SQUARE, (3, 0, 0))]), [(0, 1, 2, 3), (4, 5, 6, 7)], "holes or parts"),
        (SQUARE * (1, 0, 1), [(0, 1, 2, 3)], "neither flat nor round"),
    ],
    ids=["trapezoid", "bent", "triangle", "hole", "two", "no area"],
)
def test_what_is_no_parallelogram_is_named(vertices, faces, reason):
    assert reason in recognize(mesh(vertices, faces))


@pytest.mark.parametrize("faces", [[(0, 1, 3, 2)], [(0, 1, 2, 3), (0, 1, 2, 3)]], ids=["bow tie", "doubled"])
def test_faces_that_lap_are_no_plane(faces):
    assert isinstance(recognize(mesh(SQUARE, faces)), str)


def test_a_folded_strip_is_no_plane():
    assert isinstance(recognize(mesh(*folded())), str)


def test_a_trapezoid_beyond_rounding_is_told_from_a_parallelogram():
    vertices = SQUARE.copy()
    vertices[2, 0] += 1e-5
    assert "not a parallelogram" in recognize(mesh(vertices, [(0, 1, 2, 3)]))
