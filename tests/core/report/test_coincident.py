"""Surfaces in the same place: the report says in how many pixels, with the names, and only then."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.report.accuracy import accuracy

SIZE = 40
"""Pixels along each side of a picture of parallel rays, ten a unit: all are checked."""

SQUARE = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
FACES = [(0, 1, 2), (0, 2, 3)]


def looked_at(*shapes, **options):
    pose = np.eye(4)
    pose[2, 3] = 5.0
    camera = crc.camera("ORTHO", (SIZE, SIZE), pose, ortho_scale=4.0, **options)
    shapes = crc.join(*shapes)
    return accuracy(camera, shapes, crc.cast(camera, shapes, passes=("depth",)).plan)


def square(name, x=0.0, z=0.0):
    return crc.mesh(np.add(SQUARE, (x, 0, z)), FACES, name=name)


def plane(name, x=0.0, z=0.0):
    return crc.planes([(x, 0, z)], [np.eye(3)], name=name)


def ball(name, z=0.0, radius=1.0):
    return crc.spheres([(0, 0, z)], [radius], name=name)


@pytest.mark.parametrize(
    ("first", "second", "count"),
    [
        (square("A"), square("B", 0.5), 300),
        (plane("A"), plane("B", 0.5), 300),
        (plane("A"), square("B", 0.5), 300),
        (square("A"), plane("B", 0.5, 1e-8), 300),
        (ball("A"), ball("B"), 316),
    ],
    ids=["meshes", "planes", "a plane and a mesh", "but for rounding", "balls"],
)
def test_the_pixels_of_two_surfaces_in_the_same_place_are_counted(first, second, count):
    counts = looked_at(plane("Behind", z=-1), first, second)
    assert (counts.coincident, counts.names) == (count, ("A", "B"))
    names, notes = zip(*counts.notes(SIZE * SIZE), strict=True)
    assert names == ("A", "B")
    assert f"at {count} of the 1,600 pixels:" in notes[0]
    assert "at 1,264 of the 6,400 pixels, estimated from 1,600:" in looked_at(ball("A"), ball("B")).notes(6400)[0][1]


def test_faces_of_one_mesh_in_the_same_place_are_counted():
    twice = crc.mesh(np.concatenate((SQUARE, SQUARE)), [*FACES, (4, 5, 6), (4, 6, 7)], name="Twice")
    counts = looked_at(twice)
    assert (counts.coincident, counts.names) == (400, ("Twice",))


@pytest.mark.parametrize(
    "shapes",
    [
        (square("A"), square("B", 0.5, 1e-3)),
        (square("A"), square("B", 2.0)),
        (ball("A"), ball("B", 0.0, 1.001), plane("Behind", z=-1)),
        (square("In front", z=1), square("A"), square("B")),
    ],
    ids=["apart", "side by side", "one in the other", "hidden"],
)
def test_other_surfaces_are_not(shapes):
    """Also where rays go through the edges of triangles: the diagonal of a square has pixel centers on it."""
    counts = looked_at(*shapes)
    assert (counts.coincident, counts.names, counts.notes(SIZE * SIZE)) == (0, (), ())
