"""The places full of meshes: what Cycles meets in their pixels, and what hand geometry and still pictures say."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.conventions import EPS32
from camera_ray_caster.core.records import SPHERE

from ..blender.cycles.cycles import cycles_surface
from .opening import look, opened

PLACES = {"toys": 250, "living_room": 500, "street": 300, "sculpture_garden": 400}
"""Most pixels, of 160 columns, whose ray passes so near the edge of a face that either side may be met."""

OFF = 1 / 128
"""Pixels: how near that is. Cycles' rays are of single precision."""

REACH = 128.0
"""More than any coordinate or depth."""

ROUNDING = 128 * EPS32 * 8
"""As in the tests of hits beside Cycles, eight times as far away."""

PIXEL = 1 / 100
"""How far aside Cycles itself is on long thin triangles, at most."""

TURNED = 5e-4
"""Radians: the position's error times the bend of smooth faces of some millimeters; Blender 5.2 packs normals, too."""


def small(scene):
    """Make a picture 160 pixels wide, of triangles alone: what Cycles has for balls."""
    scene.render.resolution_y = round(160 * scene.render.resolution_y / scene.render.resolution_x)
    scene.render.resolution_x = 160
    scene.camera_ray_caster.exact_shapes = False
    return scene


def unambiguous(scene):
    """Return where rays a little aside meet the same face, (h, w) bool: found without Cycles."""
    data, indices = scene.camera.data, []
    x, y = data.shift_x, data.shift_y
    for dx, dy in ((0, 0), (OFF, OFF), (OFF, -OFF), (-OFF, OFF), (-OFF, -OFF)):
        data.shift_x, data.shift_y = x + dx / 160, y + dy / 160
        images = cast(read_camera(scene), read_shapes(scene), passes=("shape_index", "face_index"))
        indices.append(np.stack((images["shape_index"], images["face_index"])))
    data.shift_x, data.shift_y = x, y
    return (np.array(indices) == indices[0]).all(axis=(0, 1))


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", PLACES)
def test_a_place_is_what_cycles_sees(blender, name):
    scene = small(opened(blender, name))
    sure = unambiguous(scene)
    assert np.count_nonzero(~sure) <= PLACES[name]
    _, _, ours = look(scene)
    hit = ours["shape_index"] >= 0
    step = ours["depth"] * scene.camera.data.sensor_width / (scene.camera.data.lens * 160)
    index = cycles_surface(scene, "Object Index", REACH)[..., 0]
    position = cycles_surface(scene, "Position", REACH)
    normal = cycles_surface(scene, "Normal", 1.0)
    depth = cycles_surface(scene, "View Z Depth", REACH)[..., 0]
    np.testing.assert_array_equal(hit[sure], ~np.isnan(depth)[sure])
    hit &= sure
    np.testing.assert_array_equal(np.rint(index[hit]), ours["object_index"][hit])
    cosine = np.abs((ours["normal"] * ours["ray_direction"]).sum(axis=-1))
    allowed = (ROUNDING / np.maximum(cosine, EPS32) + PIXEL * step)[hit]
    away = np.linalg.norm(position - ours["position"], axis=-1)[hit]
    assert (away <= allowed).all()
    assert np.median(away) <= ROUNDING
    assert (np.abs(depth - ours["depth"])[hit] <= allowed / np.maximum(cosine, EPS32)[hit]).all()
    turned = np.linalg.norm(normal - ours["normal"], axis=-1)
    assert turned[hit].max() <= TURNED
    assert np.median(turned[hit]) <= TURNED / 10


def test_toys_are_triangles_but_the_balls(blender):
    _, shapes, _ = look(opened(blender, "toys"))
    round_ones = {shapes.names[k] for k in shapes.name_index[shapes.kind == SPHERE]}
    assert round_ones == {"Ball", "Small ball", "Marble"}
    assert len(shapes) == 12


@pytest.mark.full
def test_the_pushbroom_shows_fronts_as_wide_as_they_are(blender):
    _, shapes, images = look(opened(blender, "street_pushbroom"))
    named = np.array(shapes.names)[shapes.name_index]
    for k, width in enumerate((4.4, 3.8, 5.0, 4.0, 4.6, 3.8, 4.4)):
        front = images["shape_index"] == np.flatnonzero(named == f"Front {k}")
        assert abs(front.any(axis=0).sum() - width * 840 / 30) <= 1  # whole pixels


def test_the_wood_stands_on_the_hill(blender):
    """The trees that geometry nodes put there have their feet on the faces that are shown."""
    _, shapes, _ = look(opened(blender, "sculpture_garden"))
    named = np.array(shapes.names)[shapes.name_index]
    (hill,) = np.flatnonzero(named == "Hill")
    mesh = shapes.meshes[shapes.mesh[hill]]
    corners = mesh.vertices[:, mesh.triangles].astype(float)
    trunks = np.flatnonzero(np.char.startswith(named, "Trunk"))
    assert len(trunks) > 50
    for trunk in trunks:
        foot = shapes.center[trunk] - 0.6 * shapes.axes[trunk, :, 2]  # 1.2 high, around its middle
        assert height(corners, foot[:2]) == pytest.approx(foot[2], abs=1e-4)


def height(corners, place):
    """Return the height of triangles, (3, 3, k) of coordinate, corner, at a place (2,) that one of them covers."""
    a, b, c = corners.transpose(1, 0, 2)
    sides = np.stack([b[:2] - a[:2], c[:2] - a[:2]], axis=1).transpose(2, 0, 1)
    u, v = np.linalg.solve(sides, (place[:, None] - a[:2]).T[..., None])[..., 0].T
    heights = a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2])
    return heights[np.minimum(np.minimum(u, v), 1 - u - v).argmax()]


@pytest.mark.cases(1)
@pytest.mark.parametrize("name", ["propeller", "twisted_monkey"])
def test_each_row_is_a_still_picture_of_its_time(blender, name):
    from camera_ray_caster.blender.engine.job import Job

    scene = opened(blender, name)
    scene.render.resolution_percentage = 25
    scene.camera_ray_caster.samples = 1
    images, _ = Job.read(blender.context.evaluated_depsgraph_get(), scene.camera, ("object_index",)).cast()
    rows = range(8, len(images["object_index"]) - 8, 9)
    times = read_camera(scene).rays().time[:, 0]
    scene.camera.data.camera_ray_caster.time_mode = "NONE"
    stills = {row: look(scene, frame=float(times[row]))[2]["object_index"] for row in rows}
    assert any((stills[row] != stills[rows[0]]).any() for row in rows)
    for row, still in stills.items():
        # a tenth of a pixel is what the time model may be off, which outlines of a few parts meet now and then
        assert np.count_nonzero(images["object_index"][row] != still[row]) <= 1
