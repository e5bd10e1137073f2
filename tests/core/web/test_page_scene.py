"""A scene from Blender in the page: balls, planes and meshes, in its scripts' cast and in its picture."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.web.page import lesson_page
from camera_ray_caster.core.web.page_scene import MOST_FACETS, PAGE, scene_data

from ..shapes.meshes import ball
from .chromium import browser, open_drawn, settled
from .test_page import shown

POSE = np.array([[0.8, 0.0, 0.6, 3.0], [0.6, 0.0, -0.8, -4.0], [0.0, 1.0, 0.0, 1.5], [0, 0, 0, 1]])
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]) * 1.8 + (1.4, -0.2, 0.1)
RED, GREEN = (0.8, 0.1, 0.1, 1.0), (0.1, 0.6, 0.2, 1.0)


def shapes():
    """A ball, an ellipsoid, a floor without an end, a wall, a tetrahedron."""
    return crc.join(
        crc.spheres([[0.3, 0.0, 0.7]], 0.7, color=RED, name="Ball"),
        crc.spheres([[0.0, 1.6, 1.2]], axes=np.diag([0.6, 0.3, 0.9]), name="Egg"),
        crc.planes([0.0, 0.0, 0.0], np.eye(3)[:, :2], infinite=True, name="Floor"),
        crc.planes([0.0, 4.0, 1.0], [[2.0, 0.0], [0.0, 0.0], [0.0, 1.0]], name="Wall"),
        crc.mesh(CORNERS, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], color=GREEN, name="Tetrahedron"),
    )


@pytest.mark.full
def test_the_page_of_a_scene_casts_what_our_cast_sees(tmp_path):
    camera = crc.camera("OPENCV_FISHEYE", (96, 64), POSE, fx=40.0, fy=40.0, calibration_width=96, calibration_height=64)
    path = tmp_path / "lesson.html"
    path.write_text(lesson_page(camera, (40, 30), shapes()), encoding="utf-8")
    images = crc.cast(camera, shapes(), passes=("distance", "shape_index", "combined"))
    names = np.array([*(shapes().names[k] for k in shapes().name_index), None])
    with browser() as driver:
        open_drawn(driver, path.as_uri())
        settled(driver, lambda tab: shown(tab, "pixel") == "x = 40.5, y = 30.5")
        seen = set()
        for y in range(1, 64, 6):
            for x in range(1, 96, 7):
                hit = driver.execute_script("return window.lesson.cast(arguments[0], arguments[1])", x + 0.5, y + 0.5)
                expected = names[images["shape_index"][y, x]]
                around = images["shape_index"][y - 1 : y + 2, x - 1 : x + 2]
                if expected == "Egg" or "Egg" in names[around] or np.ptp(around):
                    continue  # the egg is facets
                assert hit.get("name") == expected, (x, y)
                seen.add(expected)
                if expected is not None:
                    assert hit["t"] == pytest.approx(images["distance"][y, x], rel=1e-5)
        assert {"Ball", "Floor", "Tetrahedron"} <= seen
        script = "const g = document.getElementById('picture'); return [g.width, g.height]"
        wide, high = driver.execute_script(script)
        for name, strongest in (("Ball", 0), ("Tetrahedron", 1)):
            row, column = np.argwhere(names[images["shape_index"]] == name).mean(axis=0)
            color = driver.execute_script(
                "const gl = document.getElementById('picture').getContext('webgl2'), bytes = new Uint8Array(4);"
                "gl.readPixels(arguments[0], arguments[1], 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes); return [...bytes]",
                int((column + 0.5) / 96 * wide), int((row + 0.5) / 64 * high),
            )  # fmt: skip
            assert int(np.argmax(color[:3])) == strongest, (name, color)


def test_the_camera_and_exact_shapes_have_the_pages_axes():
    data = scene_data(crc.camera("PERSP", (64, 48), POSE), shapes())
    assert [shape["name"] for shape in data["spheres"]] == ["Ball"]
    assert [shape["name"] for shape in data["rectangles"]] == ["Floor", "Wall"]
    assert data["names"] == ["Egg", "Tetrahedron"]
    assert data["spheres"][0]["center"] == [0.3, 0.7, 0.0]
    assert data["camera"]["eye"] == [3.0, 1.5, 4.0]
    assert np.allclose(data["camera"]["w"], PAGE @ -POSE[:3, 2])
    assert (data["left_out"], data["coarser"]) == ([], [])


def test_fine_meshes_are_thinned_out_and_coarse_ones_stay():
    fine = ball(120, 240, 1.0)
    many = crc.join(shapes(), crc.mesh(fine.vertices.T, fine.triangles.T, name="Fine"))
    data = scene_data(crc.camera("PERSP", (64, 48), POSE), many)
    assert data["coarser"] == ["Fine"]
    assert data["left_out"] == []
    assert 1000 < data["triangles"] <= MOST_FACETS
