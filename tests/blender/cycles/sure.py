"""Pixels at which there is no doubt which face a ray meets, and our own passes beside those of Cycles there."""

import numpy as np

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from .cycles import cycles_truth

OFF = 1 / 128
"""Pixels. Where a ray so far aside meets another face, it may be another one that Cycles meets, in float32."""

NEAR = 2e-4
"""Largest error of depth and position, of a distance of 10: Cycles' own, 32 EPS32 of it over a cosine of 0.2."""

TURNED = 2e-4
"""Radians: see test_meshes."""

MAPPED = 2e-4
"""Of maps that grow by 1 or less on a length of 1: as NEAR. A test whose maps grow faster says so."""

PASSES = ("depth", "position", "normal", "uv", "object_index", "material_index")


def cast_scene(scene, names):
    return cast(read_camera(scene), read_shapes(scene), passes=names, dtype=np.float64)


def unambiguous(scene):
    """Where rays a little aside meet the same face: found without Cycles."""
    data, indices = scene.camera.data, []
    for dx, dy in ((0, 0), (OFF, OFF), (OFF, -OFF), (-OFF, OFF), (-OFF, -OFF)):
        data.shift_x, data.shift_y = (offset / scene.render.resolution_x for offset in (dx, dy))
        images = cast_scene(scene, ("shape_index", "face_index"))
        indices.append(np.stack((images["shape_index"], images["face_index"])))
    data.shift_x = data.shift_y = 0
    return (np.array(indices) == indices[0]).all(axis=(0, 1))


def assert_as_cycles(scene, sure=None, mapped=MAPPED, but=()):
    """Check all passes of PASSES ``but`` some at all unambiguous pixels, or at those of ``sure``; return ours."""
    sure = unambiguous(scene) if sure is None else sure
    ours, theirs = cast_scene(scene, PASSES), cycles_truth(scene)
    hit = np.isfinite(ours["depth"])
    np.testing.assert_array_equal(hit[sure], theirs["depth"][sure] < 1e9)
    assert (hit & sure).sum() > 100
    bounds = {"depth": NEAR, "position": NEAR, "normal": TURNED, "uv": mapped}
    for name in PASSES:
        if name not in but:
            off = np.abs(ours[name] - theirs[name])[hit & sure]
            assert off.max() <= bounds.get(name, 0), name
    return ours
