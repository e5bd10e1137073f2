"""The report: sums and facts by hand, a table that fits, and JSON that any reader takes."""

import json
from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.camera.facts import camera_facts
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.exports.camera_json import camera_from_json
from camera_ray_caster.core.records import SPHERE, BlenderCamera, Finding, InputError, Lights, Shapes, no_shapes
from camera_ray_caster.core.report.accuracy import Accuracy, accuracy
from camera_ray_caster.core.report.indices import indices_of
from camera_ray_caster.core.report.report import WIDTH, Report, as_data, as_json, as_lines, report_cast
from camera_ray_caster.core.version import VERSION

GOOD = Finding("good witness", 9, 1e-5, 1e-6, 1e-4, 1e-8, 1e-9, 1e-7)
BAD = replace(GOOD, witness="bad witness", worst_pixels=0.5)


def camera(**settings):
    """A camera at (1, 2, 3) that looks down."""
    matrix = np.eye(4)
    matrix[:3, 3] = 1, 2, 3
    raw = BlenderCamera("Camera", "PERSP", matrix, resolution_x=64, resolution_y=48, lens=50.0, sensor_width=36.0)
    return camera_from(replace(raw, **settings))


@pytest.fixture
def report():
    """The report of a sphere that is cast and an object that is not; its times are made up."""
    shapes = Shapes(
        kind=np.array([SPHERE], np.uint8),
        center=np.array([[1.0, 2.0, 0.0]]),
        axes=np.eye(3)[None],
        object_index=np.zeros(1, np.int32),
        material_index=np.zeros(1, np.int32),
        color=np.ones((1, 4), np.float32),
        name_index=np.zeros(1, np.int32),
        names=("Sphere",),
        left_out=(("Suzanne", "it is a monkey " + "of many words " * 20),),
        exact=(("Sphere", 0.0096), ("Floor", 0.0), ("Sphere", 0.0096)),
        notes=tuple((name, "its map is another") for name in ("A", "B", "C", "D", "E")),
        lights=Lights(left_out=(("Lamp", "its color is not finite"),)),
    )
    images = cast(camera(), shapes, passes=("depth",))
    seconds = {"read": 0.5, "plan": 0.01, "cast": 0.02, "passes": 0.03, "write": 0.25}
    bounds = accuracy(camera(), shapes, images.plan)
    return report_cast(camera(), shapes, images, seconds, [GOOD], 1.5, "Layer", accuracy=bounds)


def strict(text):
    """JSON as a reader takes it that knows no NaN."""

    def refuse(word):
        raise ValueError(word)

    return json.loads(text, parse_constant=refuse)


def test_rays_per_second_counts_the_steps_of_the_cast_and_no_others(report):
    assert report.pixels == 64 * 48
    assert report.rays_per_second == pytest.approx(64 * 48 / 0.06)
    assert Report(camera={}, frame=1).rays_per_second is None


def test_a_second_layer_adds_up(report):
    other = replace(report, layers=("Other",), seconds={"read": 0.25, "files": 1.0}, findings=(GOOD, BAD))
    both = report + other
    assert both.layers == ("Layer", "Other")
    assert both.pixels == 2 * 64 * 48
    assert both.seconds == {"read": 0.75, "plan": 0.01, "cast": 0.02, "passes": 0.03, "write": 0.25, "files": 1.0}
    assert both.findings == (GOOD, BAD)
    assert both.left_out == report.left_out, "an object is named once"
    assert both.exact == report.exact == (("Sphere", 0.0096), ("Floor", 0.0))
    assert report.passed
    assert not both.passed


def test_a_step_that_is_taken_again_adds_up(report):
    assert report.with_seconds(write=0.5).seconds["write"] == 0.75
    assert report.with_seconds(files=0.5).seconds == {**report.seconds, "files": 0.5}


def test_of_several_layers_each_is_named_beside_what_it_did_not_do(report):
    assert any(line.startswith("passes combined") for line in report.not_done)
    images = cast(
        camera(), Shapes(*(np.zeros((0, *s)) for s in ((), (3,), (3, 3), (), (), (4,), ()))), passes=("depth",)
    )
    nothing = Shapes(*(np.zeros(0),) * 7)
    several = report_cast(camera(), nothing, images, {}, [], 1.0, "Layer", several=True, accuracy=Accuracy())
    assert several.not_done
    assert all(line.startswith("Layer: ") for line in several.not_done)


def test_lights_are_left_out_of_a_picture_alone():
    """Depth needs no light, and another engine's picture has its own."""
    shapes = replace(no_shapes(), lights=Lights(left_out=(("Lamp", "its color is not finite"),)))
    for passes, left_out in ((("depth",), ()), (("depth", "combined"), shapes.lights.left_out)):
        images = cast(camera(), shapes, passes=passes)
        report = report_cast(camera(), shapes, images, {}, [], 1.0, "Layer", accuracy=Accuracy())
        assert report.left_out == left_out


def test_json_is_strict_and_holds_the_record(report):
    broken = replace(report, findings=(replace(GOOD, worst_pixels=np.nan, bound_pixels=np.inf),))
    data = strict(as_json(broken))
    assert data["findings"][0]["worst_pixels"] is None
    assert data["findings"][0]["bound_pixels"] is None
    assert data["findings"][0]["median_pixels"] == 1e-6
    assert data["findings"][0]["passed"] is False
    assert data["passed"] is False
    data = strict(as_json(report))
    assert data == as_data(report)
    assert data["camera"]["eye"] == [1.0, 2.0, 3.0]
    assert data["frame"] == 1.5
    assert data["seconds"] == dict(report.seconds)
    assert data["left_out"][0]["name"] == "Suzanne"
    assert data["exact"][0] == {"name": "Sphere", "apart": 0.0096}
    assert data["notes"][4] == {"name": "E", "note": "its map is another"}
    assert data["passed"] is True


def test_the_table_says_all_and_fits(report):
    lines = as_lines(replace(report, findings=(GOOD, BAD)))
    assert max(map(len, lines)) <= WIDTH
    table = " ".join(" ".join(lines).split())
    for word in ("'Camera'", "frame 1.5", "Perspective", "good witness", "read", "0.5000", "Suzanne", "not requested"):
        assert word in table
    verdicts = {line.split()[0]: line.split()[-1] for line in lines if "witness" in line}
    assert verdicts == {"good": "ok", "bad": "FAILED"}
    assert "2 meshes cast as spheres or planes, with a deviation of at most 0.96% of the radius, in 'Sphere'" in table
    text_lines = as_lines(replace(report, exact=report.exact[:1]))
    assert "1 mesh cast as spheres or planes" in " ".join(" ".join(text_lines).split())
    assert "'A', 'B', 'C' and 2 more: its map is another" in table
    assert "'Sphere': the exact shape is up to 0.96% of its radius away from the mesh" in table


def test_settings_and_formula_of_the_model_are_in_the_report(report):
    data = strict(as_json(report))["camera"]
    assert data["key"] == "PERSP"
    film = {"sensor_fit": "AUTO", "sensor_width": 36.0, "sensor_height": 24.0, "shift_x": 0.0, "shift_y": 0.0}
    assert data["settings"] == {"lens": 50.0, **film}
    assert data["formula"][2] == {"words": "Direction along the axes u, v, w", "symbols": "r = X u + Y v + w"}
    lines = as_lines(report)
    assert "  Direction along the axes u, v, w: r = X u + Y v + w" in lines[lines.index("Formula") :]


def test_settings_are_in_the_table_where_they_are_few(report):
    fisheye = {"fov": 1.5, "shift_x": 0.0, "shift_y": 0.0}
    few = camera(model="FISHEYE_ORTHOGRAPHIC", settings={"fov": 1.5})
    assert camera_facts(few)["settings"] == fisheye
    assert "  settings             fov 1.5, shift_x 0, shift_y 0" in as_lines(Report(camera_facts(few), frame=1))
    assert not any(line.startswith("  settings") for line in as_lines(report))


def test_the_bounds_of_hits_are_in_table_and_json_with_their_units(report):
    bounds = np.array([[1e-15, 2e-15, 3e-15, 4e-15], [5e-15, 6e-15, 7e-15, 8e-15], [9e-15, 1e-14, 2e-14, np.inf]])
    report = replace(report, accuracy=Accuracy(10, bounds))
    data = strict(as_json(report))
    figures = data["accuracy"]
    assert (figures["sampled_pixels"], figures["hits"]) == (10, 3)
    assert figures["distance"] == {"unit": "world units", "median_bound": 5e-15, "worst_bound": 9e-15}
    assert figures["relative_distance"] == {"unit": "of the distance", "median_bound": 6e-15, "worst_bound": 1e-14}
    assert (figures["normal"]["median_bound"], figures["normal"]["worst_bound"]) == (8e-15, None)
    assert figures["rounding_when_stored"] == 2.0**-24
    lines = as_lines(report)
    rows = {line[2:19].strip(): line[19:].split()[:2] for line in lines if line[19:].strip()[:1].isdigit()}
    assert rows["distance"] == ["5.0e-15", "9.0e-15"]
    assert rows["normal"] == ["8.0e-15", "inf"]
    assert "  3 hits at 10 pixels all over the picture, in float64" in lines
    assert max(map(len, lines)) <= WIDTH


def test_the_samples_of_two_layers_are_one(report):
    rows = np.ones((3, 4)), np.full((2, 4), 5.0)
    first, other = (replace(report, accuracy=Accuracy(10, bounds)) for bounds in rows)
    figures = strict(as_json(first + other))["accuracy"]
    assert (figures["sampled_pixels"], figures["hits"]) == (20, 5)
    assert (figures["position"]["median_bound"], figures["position"]["worst_bound"]) == (1.0, 5.0)


def test_where_nothing_is_hit_the_report_says_so(report):
    report = replace(report, accuracy=Accuracy(10))
    assert "Hits: none at 10 pixels all over the picture, in float64" in as_lines(report)
    figures = strict(as_json(report))["accuracy"]
    assert figures["hits"] == 0
    assert figures["distance"]["worst_bound"] is None


def test_the_table_leaves_out_what_was_not_done():
    lines = as_lines(Report(camera=camera_facts(camera()), frame=1))
    assert not any(line.startswith(("Reference check", "Hits", "Step", "Left out")) for line in lines)


def test_facts_of_a_pinhole_by_hand():
    facts = camera_facts(camera())
    assert facts["eye"] == [1, 2, 3]
    assert [facts[axis] for axis in "uvw"] == [[1, 0, 0], [0, 1, 0], [0, 0, -1]]
    assert facts["raster"] == [64, 48]
    # 36 mm behind 50 mm: 2 atan(18 / 50) across, three quarters of the tangent up
    assert facts["field_of_view"] == pytest.approx([39.5977527, 30.2191502])
    assert facts["d"] == pytest.approx(50 / 18)
    assert facts["aspect"] == pytest.approx(0.75)


@pytest.mark.parametrize("settings", [{}, {"pixel_aspect_y": 2.0}, {"sensor_fit": "VERTICAL"}, {"resolution_y": 99}])
def test_facts_are_the_lectures_ray(settings):
    cam = camera(**settings)
    facts = camera_facts(cam)
    x, y = (2 * cam.raster.columns() / 64 - 1), (2 * cam.raster.rows() / cam.raster.height - 1)
    parts = zip((x, facts["aspect"] * y, facts["d"]), (facts[axis] for axis in "uvw"), strict=True)
    ray = sum(np.multiply.outer(np.broadcast_to(factor, cam.raster.shape), axis) for factor, axis in parts)
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    np.testing.assert_allclose(ray, cam.rays().directions, atol=1e-15)


@pytest.mark.parametrize("settings", [{}, {"shift_x": 0.3, "shift_y": -0.2}, {"pixel_aspect_x": 1.5}])
def test_facts_hold_opencvs_matrix(settings):
    cam = camera(**settings)
    point = np.array([1.7, 2.4, -2.0])  # camera frame (0.7, 0.4, -5): OpenCV's axes turn y and z round
    across, down, depth = np.array(camera_facts(cam)["K"]) @ [0.7, -0.4, 5.0] / 5.0
    assert depth == 1
    x, y = cam.project(point)
    # the center of the top left pixel is OpenCV's (0, 0) and our (1/2, height - 1/2)
    assert (across, down) == pytest.approx((x - 0.5, cam.raster.height - 0.5 - y))


def test_facts_of_an_orthographic_camera_by_hand():
    facts = camera_facts(camera(type="ORTHO", ortho_scale=8.0))
    assert facts["frame"] == [8.0, 6.0]
    assert "K" not in facts


def test_the_numbers_of_the_index_passes_have_names():
    ball = np.array([SPHERE], np.uint8)
    shapes = Shapes(
        kind=np.concatenate((ball, ball, ball + 3, ball, ball)),
        center=np.zeros((5, 3)),
        axes=np.tile(np.eye(3), (5, 1, 1)),
        object_index=np.array([7, 7, 7, 0, 7], np.int32),
        material_index=np.array([2, 2, 2, 0, 3], np.int32),
        color=np.ones((5, 4), np.float32),
        name_index=np.array([0, 0, 0, 1, 2], np.int32),
        names=("Dust", "Moon", "Ball"),
        materials=((3, "Red"), (2, "Gray"), (2, "Also Gray")),
    )
    assert indices_of(shapes) == {
        "object_index": {"0": ["Moon"], "7": ["Dust", "Ball"]},
        "material_index": {"2": ["Also Gray", "Gray"], "3": ["Red"]},
        "shape_index": [
            {"first": 0, "count": 2, "object": "Dust", "kind": "SPHERE"},
            {"first": 2, "count": 1, "object": "Dust", "kind": "MESH"},
            {"first": 3, "count": 1, "object": "Moon", "kind": "SPHERE"},
            {"first": 4, "count": 1, "object": "Ball", "kind": "SPHERE"},
        ],
    }
    assert indices_of(no_shapes()) == {"object_index": {}, "material_index": {}, "shape_index": []}


def test_a_report_makes_the_camera_again(report):
    text = as_json(report)
    document = strict(text)
    assert document["version"] == VERSION
    assert document["conventions"]["K"].startswith("as OpenCV")
    assert document["indices"]["Layer"]["shape_index"][0]["object"] == "Sphere"
    assert np.array_equal(document["camera"]["world_to_opencv"], camera().opencv_from_world)
    for asked in ({}, {"frame": 1.5}):
        assert camera_from_json(text, **asked).rays().directions.tobytes() == camera().rays().directions.tobytes()
    with pytest.raises(InputError, match=r"this report is of frame 1\.5, not 2"):
        camera_from_json(text, 2)
    with pytest.raises(InputError, match=r"whose time is an image.*export a camera"):
        camera_from_json(as_json(replace(report, record=None)))


def test_the_tables_of_several_layers_stand_apart(report):
    other = replace(report, indices={"Other": {"shape_index": []}})
    assert sorted((report + other).indices) == ["Layer", "Other"]
