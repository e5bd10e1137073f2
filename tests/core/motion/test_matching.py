"""Which shapes of two frames are the same, and the flow of those that are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.motion.matching import rows_in
from camera_ray_caster.core.records import PLANE, SPHERE, no_shapes

from ..casting.neighbors import with_others
from ..casting.test_cast import camera_at, shapes_of
from ..shapes import meshes


def test_shapes_are_known_by_their_names():
    rows = [(SPHERE, (k, 0, -5), 1.0) for k in range(4)]
    before = replace(shapes_of(*rows), names=("a", "b", "c", "a"), name_index=np.array([0, 1, 2, 3], np.int32))
    after = replace(shapes_of(*rows), names=("b", "new", "a", "a"), name_index=np.array([0, 1, 2, 3], np.int32))
    assert rows_in(before, before).tolist() == [0, 1, 2, 3]
    assert rows_in(before, after).tolist() == [2, 0, -1, 3]
    other = replace(after, kind=np.array([PLANE, SPHERE, SPHERE, SPHERE], np.uint8))
    assert rows_in(before, other).tolist() == [2, -1, -1, 3]
    one_less = replace(after, names=("b", "new", "a", "d"))
    assert rows_in(before, one_less).tolist() == [-1, 0, -1, -1]
    flow = cast(*with_others(camera_at(), before, camera_at(), one_less), passes=("flow_forward", "shape_index"))
    assert (np.isnan(flow["flow_forward"][..., 0]) == (flow["shape_index"] != 1)).all()
    assert rows_in(before, no_shapes()).tolist() == [-1] * 4
    passes = "flow_forward", "flow_hidden", "shape_index"
    flow = cast(*with_others(camera_at(), before, camera_at(), no_shapes()), passes=passes)
    assert (flow["shape_index"] >= 0).any()
    assert np.isnan(flow["flow_forward"]).all()
    assert not flow["flow_hidden"].any()


def test_a_face_that_is_divided_otherwise_moves_as_it_was_divided_before():
    """Of two squares one has the other diagonal in the next frame, where both are one unit to the right."""
    corners = [(x, y, 0.0) for y in (-1, 1) for x in (-2, 0, 2)]
    halves = [(0, 1, 4), (0, 4, 3), (1, 2, 5), (1, 5, 4)]
    others = [(0, 1, 3), (1, 4, 3), *halves[2:]]
    faces = np.array([0, 0, 1, 1], np.int32)
    right = [(x + 1, y, z) for x, y, z in corners]
    now, same, divided, broken = (
        meshes.shapes_of((meshes.mesh_of(places, triangles, polygon=faces), (0, 0, -5), 1.0))
        for places, triangles in (
            (corners, halves), (right, halves), (right, others), (right, [(0, 1, 5), (0, 4, 3), *halves[2:]])
        )
    )  # fmt: skip
    passes = "flow_forward", "shape_index"
    expected, found, none = (
        cast(*with_others(camera_at(), now, camera_at(), after), passes=passes) for after in (same, divided, broken)
    )
    hit = expected["shape_index"] == 0
    assert np.isfinite(expected["flow_forward"][hit]).any()
    np.testing.assert_array_equal(found["flow_forward"], expected["flow_forward"])
    assert np.isnan(none["flow_forward"]).all()
