"""The search that a picture is cast by: the tree gives the picture that the search of tiles gives."""

from dataclasses import fields, replace

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.any_rays.choice import uses_tree
from camera_ray_caster.core.casting.pass_needs import WITHOUT_PIXEL
from camera_ray_caster.core.casting.passes import PASSES

from ..shapes.meshes import ball

BOUNDED = ("distance", "position", "normal")


def without_bounds(camera):
    """The camera with a model whose bounds tell nothing."""
    kind = type(camera.model)
    everywhere = type("Everywhere", (kind,), {
        "bounds": lambda self, centers, radii: np.tile((-np.inf, np.inf) * 2, (len(radii), 1)),
    })  # fmt: skip
    return replace(camera, model=everywhere(*(getattr(camera.model, entry.name) for entry in fields(kind))))


@pytest.mark.parametrize("settings", [
    {"model": "EQUIRECTANGULAR"}, {"model": "PERSP", "lens": 20.0}, {"model": "ORTHO", "ortho_scale": 12.0},
], ids=lambda settings: settings["model"])  # fmt: skip
def test_the_tree_gives_the_picture_of_the_search_of_tiles(settings):
    """Distances within both bounds, and the same shapes, in every pixel of a scene without edges near rays."""
    pose = crc.look_at((0.3, -1.2, 0.4), (0.0, 8.0, 0.1))
    tiles = crc.camera(size=(96, 48), pose=pose, **settings)
    rng, mesh = np.random.default_rng(5), ball(24, 32, 1.5)
    shapes = crc.join(
        crc.spheres(rng.uniform((-6, 4, -4), (6, 14, 4), (400, 3)), 0.3),
        crc.mesh(mesh.vertices.T + np.array((0, 6, 0)), mesh.triangles.T),
        crc.planes((0, 16, 0), [[20, 0], [0, 0], [0, 20]]),
    )  # fmt: skip
    names = tuple(name for name in PASSES if name not in WITHOUT_PIXEL[2:])
    by_tiles, by_tree = (
        crc.cast(camera, shapes, passes=names, dtype=np.float64) for camera in (tiles, without_bounds(tiles))
    )
    assert [uses_tree(images.plan) for images in (by_tiles, by_tree)] == [False, True]
    assert len(np.unique(by_tiles["shape_index"])) > 50
    assert np.array_equal(by_tiles["shape_index"], by_tree["shape_index"])
    hit = by_tiles["shape_index"] >= 0
    for name in names:
        left, right = (images[name][hit] for images in (by_tiles, by_tree))
        if name in BOUNDED:
            bound = (by_tiles[f"{name}_bound"] + by_tree[f"{name}_bound"])[hit]
            off = np.abs(left - right) if left.ndim == 1 else np.linalg.norm(left - right, axis=-1)
            assert (off <= bound).all(), name
        elif left.dtype.kind in "ib" or name.startswith("ray_") or name == "solid_angle":
            assert np.array_equal(left, right), name
        elif not name.endswith("_bound"):
            assert np.allclose(left, right, rtol=1e-9, atol=1e-9), name


def test_few_shapes_are_left_to_the_search_of_tiles():
    camera = without_bounds(crc.camera("EQUIRECTANGULAR", (16, 8)))
    assert not uses_tree(crc.cast(camera, crc.spheres([(0, 0, -5)], 1.0), passes="depth").plan)


@pytest.mark.parametrize(("apart", "by_tree"), [(0.01, True), (1.0, False)])
def test_tables_of_rays_that_begin_near_each_other_are_cast_by_rays(apart, by_tree):
    """The picture is that of the same rays by ``cast_rays`` away from edges, where one ray in a hundred is."""
    y, x = np.mgrid[-0.4:0.4:12j, -0.6:0.6:18j]
    origins = apart * np.stack((x, y, np.zeros_like(x)), axis=2)
    table = {"ray_directions": np.stack((x, y, np.full_like(x, -1.0)), axis=2), "ray_origins": origins}
    mesh = ball(150, 150, 1.5)
    shapes = crc.join(*(crc.mesh(mesh.vertices.T + np.array((k, 0, -6 - k)), mesh.triangles.T) for k in (-1, 1)))
    camera = crc.camera("RAY_TABLE", (90, 60), **table)
    passes = "shape_index", "distance", "distance_bound"
    images = crc.cast(camera, shapes, passes=passes, dtype=np.float64)
    assert uses_tree(images.plan) is by_tree
    assert uses_tree(crc.cast(without_bounds(camera), shapes, passes="valid").plan), "wherever its rays begin"
    rays = camera.rays()
    hits = crc.cast_rays(rays.origins, rays.directions, shapes, passes=passes)
    same = images["shape_index"] == hits["shape_index"]
    assert same.mean() > 0.99
    hit = same & (images["shape_index"] >= 0)
    assert hit.mean() > 0.1
    off = np.abs(images["distance"][hit] - hits["distance"][hit])
    assert (off <= images["distance_bound"][hit] + hits["distance_bound"][hit]).all()
