"""The steps of a pixel: hand numbers, and what the search finds of the same ray by other means."""

from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.lesson.formula import shown
from camera_ray_caster.core.lesson.lesson import lesson
from camera_ray_caster.core.lesson.meetings import nearest
from camera_ray_caster.core.mesh import Mesh
from camera_ray_caster.core.records import INFINITE_PLANE, MESH, PLANE, SPHERE, BlenderCamera, InputError, Shapes

TETRAHEDRON = Mesh(
    vertices=np.array([[-1, 1, 0, 0], [-1, -1, 1, 0], [0, 0, 0, 2]], np.float32),
    triangles=np.array([[0, 0, 1, 2], [2, 1, 2, 0], [1, 3, 3, 3]], np.int32),
    polygon=np.arange(4, dtype=np.int32),
)


def scene():
    """A ball, a quad behind it, an endless floor and a tetrahedron beside the ball; the camera looks along -Z."""
    count = 4
    column = np.arange(count, dtype=np.int32)
    axes = np.stack([np.eye(3), np.diag([3.0, 3.0, 1.0]), np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0.0]]), np.eye(3)])
    return Shapes(
        kind=np.array([SPHERE, PLANE, INFINITE_PLANE, MESH], np.uint8),
        center=np.array([[0, 0, -5], [0, 0, -8], [0, -2, 0], [2, 0, -6.0]]),
        axes=axes,
        object_index=column,
        material_index=column,
        color=np.ones((count, 4), np.float32),
        name_index=column,
        names=("Ball", "Wall", "Floor", "Tent"),
        meshes=(TETRAHEDRON,),
        mesh=np.array([-1, -1, -1, 0], np.int32),
    )


def camera(**changed):
    settings = {"type": "PERSP", "resolution_x": 40, "resolution_y": 30, "lens": 18.0} | changed
    return camera_from(BlenderCamera("Camera", matrix_world=np.eye(4), **settings))


def test_the_ball_straight_ahead_is_met_at_4_and_at_6():
    explained = lesson(camera(resolution_x=41, resolution_y=31), scene(), 20, 15)
    assert explained.seen.name == "Ball"
    ball, wall = explained.met[:2]
    assert [place.t for place in ball.places] == [4, 6]
    assert [place.t for place in wall.places] == [8]
    assert ball.equation[1] == "1 t² -10 t +24 = 0, discriminant 4"
    assert np.array_equal(explained.point, [0, 0, -4])
    assert np.array_equal(explained.normal, [0, 0, 1])
    text = "\n".join(explained.lines())
    assert "t = 4: seen: the nearest that counts" in text
    assert "t = 6: hidden behind the nearest" in text
    assert "r = x u + aspect y v + d w" in text
    assert "(20, 15) of 41 × 31, from the bottom left" in text
    assert repr(explained) == f"<Lesson: pixel (20, 15), Ball, {len(explained.steps)} steps: print it>"


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    "changed",
    [{}, {"type": "ORTHO"}, {"type": "PANO", "settings": {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 3.0}}],
)
def test_the_plain_equations_find_what_the_search_finds(changed):
    eye, shapes = camera(**changed), scene()
    images = cast(eye, shapes, passes=("distance", "shape_index", "valid"), dtype=np.float64)
    hits = 0
    for row in range(0, 30, 3):
        for column in range(0, 40, 3):
            explained = lesson(eye, shapes, column, row)
            first = nearest(list(explained.met))
            assert np.isnan(explained.seen.direction).any() == (not images["valid"][row, column])
            assert (first[0].shape if first else -1) == images["shape_index"][row, column]
            if first:
                assert first[1].t == pytest.approx(images["distance"][row, column], rel=1e-12)
                hits += 1
    assert hits > 50


LENS = {"use_dof": True, "focus_distance": 4.0, "aperture_fstop": 0.05, "aperture_ratio": 1.0, "aperture_blades": 0,
        "aperture_rotation": 0.0, "focus_position": None}  # fmt: skip
FISHEYE = {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 3.0}


@pytest.mark.parametrize("shading", ["MATERIAL", "GRID"])
@pytest.mark.parametrize(
    ("changed", "samples"), [({}, 1), ({"settings": LENS}, 7), ({"type": "PANO", "settings": FISHEYE}, 5)]
)
def test_the_color_is_that_of_the_picture(changed, samples, shading):
    eye, shapes = camera(**changed), replace(scene(), world_color=(0.1, 0.2, 0.3, 1.0))
    one, picture = (
        cast(eye, shapes, passes="combined", dtype=np.float64, shading=shading, samples=count)["combined"]
        for count in (1, samples)
    )
    differing = 0
    for column, row in [(0, 0), (1, 14), (14, 17), (20, 5), (20, 15), (28, 16), (39, 29)]:
        explained = lesson(eye, shapes, column, row, shading=shading, samples=samples)
        # to rounding: triangles are searched otherwise in a single pixel
        assert explained.color == pytest.approx(picture[row, column], rel=1e-12, abs=0)
        color_step = dict(explained.steps)["Color"]
        assert shown(one[row, column]) in color_step[-1 if samples == 1 else -2]
        if samples > 1:
            assert f"the mean of {samples} rays" in color_step[-1]
            assert color_step[-1].endswith(shown(picture[row, column]))
        differing += not np.array_equal(one[row, column], picture[row, column])
    assert (differing > 0) == (samples > 1)


def test_a_mean_of_too_many_rays_is_named_and_left_out():
    explained = lesson(camera(), scene(), 20, 15, samples=300, max_samples=256)
    assert explained.color is None
    assert "the mean of 300 rays over the pixel: too many to cast here" in "\n".join(explained.lines())


def test_what_lies_outside_of_the_clip_range_says_so():
    near = replace(camera(resolution_x=41, resolution_y=31), clip_start=4.5, clip_end=7.0)
    text = "\n".join(lesson(near, scene(), 20, 15).lines())
    assert "t = 4: nearer than the clip start, 4.5" in text
    assert "t = 6: seen" in text
    assert "t = 8: farther than the clip end, 7" in text


def test_a_pixel_outside_of_the_frame_is_refused():
    with pytest.raises(InputError, match=r"pixel 40,0 is outside the frame: give 0,0 \(bottom left\) to 39,29"):
        lesson(camera(), scene(), 40, 0)


def test_pages_of_a_lecture_are_few_and_equally_long():
    seven, uneven = ("direction",) * 7, ("a", "  1", "  2", "b", "  1", "  2", "c", "  1", "  2", "d")
    last = tuple(line for count in (2, 2, 2, 2, 2, 4, 2, 1) for line in ("a", *("  1",) * (count - 1)))
    explained = lesson(camera(), scene(), 20, 15)
    steps = tuple((title, lines) for title, lines in explained.steps if title == "Ray in the world")
    pages = replace(explained, steps=(*steps, ("Seven", seven), ("Uneven", uneven), ("Last", last))).screens[1:]
    assert [(title, len(lines)) for title, lines in pages] == [
        ("Ray in the world", 6), ("Seven", 4), ("Seven", 3), ("Uneven", 6), ("Uneven", 4),
        ("Last", 6), ("Last", 4), ("Last", 4), ("Last", 3),
    ]  # fmt: skip
    assert [line.split(" = ")[0] for line in pages[0][1]] == ["eye", "u", "v", "w", "o", "r"]
