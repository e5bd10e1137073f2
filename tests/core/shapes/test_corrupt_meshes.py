"""Meshes whose numbers were overwritten, as in a file that is damaged, or set by a script that errs."""

from collections import Counter
from dataclasses import replace

import numpy as np

from camera_ray_caster.core.shapes.instances import Primitive
from camera_ray_caster.core.shapes.recognize import CORRUPT, ROUNDED_AWAY, MeshArrays, recognize

from .test_recognize import SQUARE, grid, mesh, prism, uv_sphere


def corrupted(whole: MeshArrays, random) -> MeshArrays:
    """Return a mesh some of whose numbers were overwritten."""
    limits = {
        "loop_vertices": len(whole.vertices),
        "loop_edges": whole.edge_count,
        "loop_starts": len(whole.loop_vertices),
    }
    changed = {}
    for name, limit in limits.items():
        if random.random() < 0.5:
            changed[name] = getattr(whole, name).copy()
            new = (
                random.integers(0, limit) if random.random() < 0.7 else random.choice([-1, limit, 2**31 - 1, -(2**31)])
            )
            changed[name][random.integers(0, len(changed[name]), random.integers(1, 4))] = new
    scale, axis = 10.0 ** random.integers(-45, 39), 10.0 ** random.integers(-30, 1, 3)
    if random.random() < 0.5:
        with np.errstate(all="ignore"):
            changed["vertices"] = (whole.vertices * scale * axis).astype(np.float32)
    return replace(whole, **changed)


def test_a_corrupt_mesh_is_named_and_nothing_is_read_beyond_its_arrays():
    random, counts = np.random.default_rng(0), Counter()
    wholes = [
        mesh(*grid([0, 1, 2, 3], [0, 1, 2])),
        mesh(SQUARE, [(0, 1, 2, 3)]),
        mesh(*uv_sphere(8, 6)),
        mesh(*prism(6, 1)),
    ]
    for k in range(1000):
        recognized = recognize(corrupted(wholes[k % 4], random))
        counts["a shape" if isinstance(recognized, Primitive) else recognized] += 1
    assert counts["a shape"] > 20
    assert counts[CORRUPT] > 200
    assert counts[ROUNDED_AWAY] > 10


def test_a_face_of_two_corners_is_corrupt():
    """Blender's own triangles of such a face would be none, or fewer."""
    whole = mesh(SQUARE, [(0, 1, 2), (0, 2, 3)])
    assert whole.is_whole
    assert not replace(whole, loop_starts=np.array([0, 2], np.int32)).is_whole
