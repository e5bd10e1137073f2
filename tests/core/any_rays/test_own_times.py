"""Rays with times at shapes that move, turn, stretch and bend: beside a cast at the time of each ray, to the bit."""

from dataclasses import replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays.moving import moving_of
from camera_ray_caster.core.motion.evaluations import resolve

PASSES = "depth", "position", "normal", "uv", "shape_index", "face_index", "position_bound", "normal_bound"
CORNER = (np.arange(6)[:, None] * 7 + np.arange(6)).ravel()
FACES = np.stack((CORNER, CORNER + 1, CORNER + 8, CORNER + 7), axis=1)
X, Y = (grid.ravel() for grid in np.meshgrid(np.linspace(-1, 1, 7), np.linspace(-1, 1, 7)))
BUMPY = crc.mesh(np.stack((X, Y, 0.2 * np.sin(4 * X + Y)), axis=1), FACES, name="bumpy")
LEVEL = crc.mesh(np.stack((X, Y, 0 * X), axis=1), FACES, name="level")


def turned(shapes, center, angle, scale=(1.0, 1.0, 1.0)):
    """The shapes at another place, turned about z and then about x, and scaled."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    return replace(shapes, center=np.array([center], float), axes=(turn * scale)[None])


def waving(f, bend=True, **looks):
    """A mesh of two faces a quad, with normals and a map, that bends and leans."""
    height = 0.3 * np.sin(3 * X + 4 * f * bend) * np.cos(Y)
    normals = np.stack((-0.9 * np.cos(3 * X + 4 * f * bend) * np.cos(Y), 0.3 * np.sin(Y), 1 + 0 * X), axis=1)
    looks = {"normals": normals, "uv": np.stack((X, Y + f), axis=1)} | looks
    return crc.mesh(np.stack((X + 3, Y + f * X, height), axis=1), FACES, name="waving", **looks)


SCENES = {
    "a mesh that bends": lambda f: [turned(waving(f), (0, f, 0.2), f), turned(LEVEL, (0, 0, -0.5 - f), 0)],
    "a flat shaded mesh that bends, in three places": lambda f: [
        waving(f, normals=None, uv=None), turned(waving(f, normals=None, uv=None), (1, 0, f), 0, (0.5, 0.3, 2)), BUMPY,
    ],
    "a mesh that bends far from the origin": lambda f: [turned(waving(f), (1e9 + f, 0, 0), f)],
    "meshes that turn and stretch": lambda f: [
        turned(BUMPY, (f, 0, 1), 2 * f, (1, 1.5, 1 + f)), turned(LEVEL, (0, f - 0.5, -0.5), -f)
    ],
    "a mesh flattened by its scale": lambda f: [
        turned(BUMPY, (0, f, 0.2), f, (1, 1, 0)), crc.spheres([(0, 0, f)], 0.3)
    ],
    "spheres and planes": lambda f: [
        crc.join(*(turned(crc.spheres([(0, 0, 0)], 1.0), (x, f, 0), f, (0.4, 0.7, 0.2)) for x in (-1.5, 0, 1.5))),
        turned(crc.planes((0, 0, 0), [[1, 0], [0, 1], [0, 0]]), (0, 0, f), f),
        crc.planes((0, 0, -1 - f), infinite=True),
    ],
    "far from the world's origin": lambda f: [turned(BUMPY, (1e9 + 2 * f, 0, 0), f)],
    "at the same place": lambda f: [turned(LEVEL, (0, 0, f), 0), turned(LEVEL, (0, 0, f), 0), LEVEL],
}  # fmt: skip


@pytest.mark.parametrize("name", SCENES)
def test_each_ray_meets_what_moves_as_a_cast_at_its_time_does(name):
    camera, floor = crc.camera("PERSP", (8, 8)), crc.planes((0, 0, -1.2), [[3, 0], [0, 3], [0, 0]])

    def at(frame):
        return crc.join(floor, *SCENES[name](frame))

    meshes = at(0.0).meshes

    def evaluate(frame):
        return camera, replace(at(frame), meshes=at(frame).meshes if "bends" in name else meshes)

    motion = resolve(evaluate, 0.0, 1.0, 0.1, 64)
    shapes = replace(at(0.0), motion=motion)
    apart = moving_of(shapes)
    assert apart.alike.all()
    assert bool(apart.forms) == ("bends" in name)
    assert len(apart.rows) in (len(shapes) - 1, len(shapes) - 2)
    random, count = np.random.default_rng(6), 600
    times = np.append(np.round(random.uniform(0, 5, count - 8)) / 5, np.resize(sorted(motion.states), 8))
    middle = shapes.center[1] * (np.abs(shapes.center[1]) > 1e6)
    origin, towards = (middle + random.uniform(-span, span, (count, 3)) for span in (4, 1))
    rays = origin, towards - origin
    hits = crc.cast_rays(*rays, shapes, passes=PASSES, times=times)
    every = crc.cast_rays(*rays, shapes, passes=PASSES, times=times, all_hits=True)
    hidden = crc.occluded(origin, towards, shapes, times=times)
    assert 20 < np.count_nonzero(hidden) < count - 20
    assert set(apart.rows[: 3 if name == "spheres and planes" else 1].tolist()) <= set(hits["shape_index"].tolist())
    for time in np.unique(times).tolist():
        some, then = times == time, motion.shapes_at(time)
        expected = crc.cast_rays(*(array[some] for array in rays), then, passes=PASSES)
        for each, image in expected.items():
            np.testing.assert_array_equal(hits[each][some], image, err_msg=f"{each} at {time}")
        expected, of_time = (
            crc.cast_rays(*(array[some] for array in rays), then, passes=PASSES, all_hits=True),
            some[every["ray"]],
        )
        np.testing.assert_array_equal(np.flatnonzero(some)[expected["ray"]], every["ray"][of_time])
        np.testing.assert_array_equal(every["count"][some], expected["count"])
        for each in PASSES:
            np.testing.assert_array_equal(every[each][of_time], expected[each], err_msg=f"{each} of all hits at {time}")
        np.testing.assert_array_equal(hidden[some], crc.occluded(origin[some], towards[some], then))


def test_a_world_that_brightens_is_seen_by_each_ray_at_its_time():
    camera, ball = crc.camera("PERSP", (8, 8)), crc.spheres([(0, 0, -3)], 1.0)

    def at(frame):
        return replace(ball, world_color=(frame, frame, frame, 1.0))

    motion = resolve(lambda frame: (camera, at(frame)), 0.0, 1.0, 0.1, 16)
    shapes, times = replace(at(0.0), motion=motion), np.array([0.0, 0.25, 1.0])
    colors = crc.cast_rays([0, 0, 0], [[0, 0, 1.0]] * 3, shapes, passes="combined", times=times)["combined"]
    np.testing.assert_allclose(colors[:, 0], times, atol=1 / 255)
