"""Hits and passes against geometry worked out by hand, and against the implicit equations of the shapes."""

from __future__ import annotations

import numpy as np
import pytest

from camera_ray_caster.core import tuning
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS
from camera_ray_caster.core.records import INFINITE_PLANE, PLANE, SPHERE, BlenderCamera, Cancelled, InputError, Shapes
from camera_ray_caster.core.report.omitted import omitted

from ..still import STILL


def shapes_of(*rows, **more):
    """Return shapes from (kind, center, axes or radius) rows; object index 10, 11, ..., material index 20, 21, ..."""
    n = len(rows)
    axes = [np.eye(3) * a if np.ndim(a) == 0 else np.array(a, float) for _, _, a in rows]
    return Shapes(
        kind=np.array([kind for kind, _, _ in rows], np.uint8),
        center=np.array([center for _, center, _ in rows], float).reshape(n, 3),
        axes=np.array(axes, float).reshape(n, 3, 3),
        object_index=np.arange(10, 10 + n, dtype=np.int32),
        material_index=np.arange(20, 20 + n, dtype=np.int32),
        color=np.tile(np.float32([0.5, 0.25, 1.0, 1.0]), (n, 1)),
        name_index=np.arange(n, dtype=np.int32),
        names=tuple(f"shape {i}" for i in range(n)),
        **more,
    )


def camera_at(matrix=None, **raw):
    """Return a 33 x 33 camera of 90 degrees, looking along -Z unless a matrix turns it."""
    raw = {"type": "PERSP", "lens": 18.0, "resolution_x": 33, "resolution_y": 33} | raw
    return camera_from(BlenderCamera(name="Camera", matrix_world=np.eye(4) if matrix is None else matrix, **raw))


def pose(rotation, eye):
    """Return a world matrix."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, eye
    return matrix


def random_shapes(rng, n):
    """Return spheres, ellipsoids, planes and an infinite plane all around the origin."""
    return shapes_of(*random_rows(rng, n))


def random_rows(rng, n):
    """Return the rows of ``random_shapes``."""
    rows = []
    for _ in range(n):
        center, axes = rng.uniform(-9, 9, 3), rng.normal(size=(3, 3)) * rng.uniform(0.1, 1.5)
        kinds = [(SPHERE, center, rng.uniform(0.1, 2.0)), (SPHERE, center, axes), (PLANE, center, axes)]
        rows.append(kinds[rng.integers(3)])
    rows.append((INFINITE_PLANE, rng.uniform(-9, 9, 3), np.linalg.qr(rng.normal(size=(3, 3)))[0]))
    return rows


def test_the_middle_ray_meets_a_sphere_at_its_near_pole():
    images = cast(camera_at(), shapes_of((SPHERE, (0, 0, -5), 2.0)), passes=STILL, dtype=np.float64)
    middle = 16, 16
    assert images["depth"][middle] == 3.0
    assert images["distance"][middle] == 3.0
    assert images["position"][middle] == pytest.approx((0, 0, -3), abs=8 * EPS)
    assert images["normal"][middle] == pytest.approx((0, 0, 1), abs=8 * EPS)
    assert images["object_index"][middle] == 10
    assert images["material_index"][middle] == 20
    assert images["shape_index"][middle] == 0
    assert images["ray_direction"][middle] == pytest.approx((0, 0, -1))


def test_a_miss_and_a_pixel_without_shapes():
    sphere = shapes_of((SPHERE, (0, 0, -5), 2.0), world_color=(0.1, 0.2, 0.3, 1.0))
    images = cast(camera_at(), sphere, passes=STILL, dtype=np.float64)
    corner = 0, 0
    assert images["depth"][corner] == images["distance"][corner] == np.inf
    assert images["shape_index"][corner] == -1
    assert images["combined"][corner] == pytest.approx((0.1, 0.2, 0.3, 1.0))
    assert images["valid"].all()
    for name in ("position", "normal", "uv", "object_index", "material_index"):
        assert not images[name][corner].any(), name


def test_depth_is_planar_and_distance_is_along_the_ray():
    floor = shapes_of((INFINITE_PLANE, (0, 0, -4), 1.0))
    images = cast(camera_at(), floor, passes=("depth", "distance"), dtype=np.float64)
    x = (np.arange(33) + 0.5 - 16.5) / 16.5
    assert np.abs(images["depth"] - 4).max() <= 8 * EPS
    assert images["distance"] == pytest.approx(4 * np.sqrt(1 + x[None] ** 2 + x[:, None] ** 2), rel=8 * EPS)


def test_a_finite_plane_ends_where_it_ends():
    square = shapes_of((PLANE, (0, 0, -2), 1.0))
    hit = np.isfinite(cast(camera_at(), square, passes=("depth",))["depth"])
    x = np.abs((np.arange(33) + 0.5 - 16.5) / 16.5) <= 0.5
    assert np.array_equal(hit, x[:, None] & x[None])


def test_orthographic_rays_start_on_the_camera_plane():
    camera = camera_at(type="ORTHO", ortho_scale=4.0)
    images = cast(camera, shapes_of((SPHERE, (0, 0, -5), 1.5)), passes=STILL, dtype=np.float64)
    x = (np.arange(33) + 0.5 - 16.5) / 33 * 4
    square = x[None] ** 2 + x[:, None] ** 2
    hit = square <= 1.5**2
    assert np.array_equal(np.isfinite(images["depth"]), hit)
    expected = 5 - np.sqrt(1.5**2 - square[hit])
    assert images["depth"][hit] == pytest.approx(expected, rel=1e-14)
    assert np.array_equal(images["depth"], images["distance"])
    assert np.abs(images["ray_origin"][..., 2]).max() == 0


def test_from_inside_a_sphere_the_far_wall_is_seen_and_faces_the_eye():
    images = cast(camera_at(clip_start=0.01), shapes_of((SPHERE, (0, 0, 0), 3.0)), passes=STILL, dtype=np.float64)
    assert images["distance"] == pytest.approx(np.full((33, 33), 3.0), rel=8 * EPS)
    assert (images["normal"] * images["ray_direction"]).sum(axis=-1) == pytest.approx(-np.ones((33, 33)))


def test_the_clip_range_cuts_shapes_open():
    sphere = shapes_of((SPHERE, (0, 0, -5), 2.0))
    middle = 16, 16
    assert cast(camera_at(clip_start=4.0), sphere, passes=("depth",))["depth"][middle] == 7.0
    assert cast(camera_at(clip_start=8.0), sphere, passes=("depth",))["depth"][middle] == np.inf
    assert cast(camera_at(clip_end=2.5), sphere, passes=("depth",))["depth"][middle] == np.inf
    assert cast(camera_at(clip_end=3.0), sphere, passes=("depth",))["depth"][middle] == 3.0


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
@pytest.mark.parametrize("seed", range(6))
def test_hits_lie_on_the_ray_and_on_the_shape_and_none_is_nearer(kind, seed):
    rng = np.random.default_rng(seed)
    shapes = random_shapes(rng, 25)
    rotation = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    camera = camera_at(pose(rotation, rng.uniform(-1, 1, 3)), type=kind, ortho_scale=9.0, clip_start=0.05)
    images = cast(camera, shapes, passes=STILL, dtype=np.float64)
    rays, seen = camera.rays(), images["shape_index"] >= 0
    assert seen.any()
    along = rays.origins + images["distance"][..., None] * rays.directions
    scale = 64 * EPS * 20
    off = np.abs(along - images["position"]).max(axis=-1)[seen]
    assert (off < 8 * EPS * np.maximum(20, images["distance"][seen])).all()  # of numbers of about 20, or as far away

    rows = images["shape_index"][seen]
    axes = np.linalg.inv(shapes.axes)
    q = np.einsum("nij,nj->ni", axes[rows], images["position"][seen] - shapes.center[rows])
    residual = np.where(shapes.kind[rows] == SPHERE, np.linalg.norm(q, axis=1) - 1, q[:, 2])
    size = np.linalg.norm(axes[rows], axis=(1, 2))
    assert (np.abs(residual) <= scale * size * np.linalg.cond(shapes.axes[rows])).all()
    finite = shapes.kind[rows] == PLANE
    assert (np.abs(q[finite, :2]) <= 1 + scale * size[finite, None] * 100).all()

    gradient = np.where((shapes.kind[rows] == SPHERE)[:, None], q, (0, 0, 1.0))
    expected = np.einsum("nji,nj->ni", axes[rows], gradient)
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    expected *= -np.sign((expected * rays.directions[seen]).sum(axis=1))[:, None]
    tilt = np.abs(expected - images["normal"][seen]).max(axis=1)
    assert (tilt <= scale * size * np.linalg.cond(shapes.axes[rows]) ** 2).all()

    # no shape is crossed before the hit: f changes its sign nowhere on the way (sampled densely)
    for k in range(len(shapes)):
        if shapes.kind[k] != SPHERE:
            continue
        t = np.where(seen, images["depth"], 1e3)[..., None] * np.linspace(0, 1 - 1e-9, 200)
        t = np.maximum(t, 0.05)
        scale_to_depth = np.where(seen, images["distance"] / np.where(seen, images["depth"], 1), 1.0)
        points = rays.origins[..., None, :] + (t * scale_to_depth[..., None])[..., None] * rays.directions[..., None, :]
        inside = np.linalg.norm((points - shapes.center[k]) @ axes[k].T, axis=-1) < 1 - 1e-6
        before_clip = inside[..., 0]
        crossed = inside.any(axis=-1) & ~before_clip
        assert not (crossed & seen).any()


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
@pytest.mark.parametrize("seed", range(8))
def test_culling_and_batches_change_no_bit(kind, seed):
    rng = np.random.default_rng(100 + seed)
    shapes = random_shapes(rng, 60)
    rotation = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    camera = camera_at(
        pose(rotation, rng.uniform(-4, 4, 3)), type=kind, ortho_scale=12.0, resolution_x=160, resolution_y=90,
        clip_start=[0.1, 3.0][seed % 2], use_border=seed % 3 == 0, border_min_x=0.2, border_max_y=0.7,
    )  # fmt: skip
    culled, unculled = (cast(camera, shapes, passes=STILL, dtype=np.float64, cull=cull) for cull in (True, False))
    for name in STILL:
        assert np.array_equal(culled[name], unculled[name]), name
    assert culled.plan.unseen > unculled.plan.unseen == 0


def test_of_coincident_shapes_the_first_is_seen():
    pair = shapes_of(*[(SPHERE, (0, 0, -5), 2.0)] * 3, *[(PLANE, (0, 0, -9), 20.0)] * 2)
    index = cast(camera_at(), pair, passes=("shape_index",))["shape_index"]
    assert set(np.unique(index)) == {0, 3}


def test_far_small_spheres_are_not_lost():
    """Radius 1 at 1e9: the textbook's discriminant is lost from 1e8 on."""
    camera = camera_at(resolution_x=3, resolution_y=3, lens=5e9, clip_end=1e10)
    images = cast(camera, shapes_of((SPHERE, (0, 0, -1e9), 1.0)), passes=("depth", "normal"), dtype=np.float64)
    assert np.isfinite(images["depth"]).sum() == 1
    assert images["depth"][1, 1] == 1e9 - 1


def test_dtype_is_only_what_is_stored():
    shapes = random_shapes(np.random.default_rng(5), 20)
    single, double = (cast(camera_at(), shapes, passes=STILL, dtype=dtype) for dtype in (np.float32, np.float64))
    for name in (name for name in STILL if not name.endswith("_bound")):  # a bound counts what storing loses
        stored = double[name].astype(single[name].dtype)
        assert np.array_equal(single[name], stored), name
    assert single["shape_index"].dtype == np.int32
    assert single["valid"].dtype == bool


def test_what_is_not_needed_is_said():
    images = cast(camera_at(), shapes_of((SPHERE, (0, 0, -5), 1.0), (SPHERE, (0, 0, 5), 1.0)), passes=("depth",))
    lines = "\n".join(omitted(images.plan))
    assert "1 of 2 shapes" in lines
    for word in ("plane", "normal", "start at the eye", "clip end"):
        assert word in lines
    slanted = cast(camera_at(type="ORTHO", clip_end=5.5), shapes_of((SPHERE, (0, 0, -5), 1.0)), passes=("depth",))
    assert not any("eye" in line or "clip" in line for line in omitted(slanted.plan))


def test_precision_has_no_effect_and_warns_until_it_goes():
    shapes = shapes_of((SPHERE, (0, 0, -5), 1.0))
    with pytest.warns(DeprecationWarning, match="precision has no effect"):
        images = cast(camera_at(), shapes, passes=("depth",), precision="FAST")
    np.testing.assert_array_equal(images["depth"], cast(camera_at(), shapes, passes=("depth",))["depth"])


def test_unknown_pass_and_shading_are_refused_by_name():
    with pytest.raises(InputError, match="unknown pass 'depht': did you mean depth"):
        cast(camera_at(), shapes_of(), passes=("depht",))
    with pytest.raises(InputError, match=r"PHONG.*MATERIAL"):
        cast(camera_at(), shapes_of(), passes=("depth",), shading="PHONG")


def test_one_pass_may_be_named_alone_and_no_threads_are_refused():
    ball = shapes_of((SPHERE, (0, 0, -5), 1.0))
    assert list(cast(camera_at(), ball, passes="depth")) == ["depth"]
    for threads in (0, -1):
        with pytest.raises(InputError, match=f"threads is {threads}"):
            cast(camera_at(), ball, passes="depth", threads=threads)


def test_progress_rises_to_one_and_can_stop_the_cast(monkeypatch):
    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 16)
    camera = camera_at(resolution_x=1024, resolution_y=1024)
    shares = []
    cast(camera, shapes_of(), passes=("depth",), threads=8, progress=lambda fraction: shares.append(fraction) or True)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert len(shares) >= 4
    with pytest.raises(Cancelled):
        cast(camera, shapes_of(), passes=("depth",), progress=lambda fraction: False)
