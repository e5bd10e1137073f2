"""A camera written on the page: its grammar, its refusals, its error map and its file for Python."""

import subprocess
import sys

import numpy as np
import pytest

from .chromium import browser, open_drawn, settled
from .test_page import by_id, fresh, numbers, ray, shown, state

pytestmark = pytest.mark.full

REFUSED = {
    "": "give one to",
    "d": "line 1: write: name = formula",
    "d = (x, y)": "three numbers",
    "d = (x, y, z)": "line 1: z is not known",
    "d = x": "the last line must be the direction",
    "d = (x, y, -": "line 1: the formula ends too early",
    "d = (x, y, -1": 'line 1: ")" is missing at the end',
    "d = (x, y, alert(1))": "line 1: alert is not known: the functions are sin, cos, tan",
    "a = x^3\nd = (a, 2, 3)": 'line 1: "^" is no part of a formula: write a power as a**3',
    "a = 1,5\nd = (a, 2, 3)": "line 1: write 1.5 in place of 1,5",
    "d = (x, 0,5 y, -1)": "line 1: write 0.5 in place of 0,5",
    "x = 1\nd = (1, 2, 3)": "line 1: x is taken",
    "d = (x; y; 1)": '";" is no part of a formula',
    "d = (x, y, `1`)": "no part of a formula",
    "d = (x.constructor, y, 1)": "no part of a formula",
    "<script>alert(1)</script>": "write: name = formula",
    "d = (sin(x, y), 0, 1)": "sin takes 1 number",
    "a = " + "(" * 60 + "1" + ")" * 60 + "\nd = (1, 2, 3)": "too many parentheses",
    "d = (1, 2, 3)\n" * 20: "give one to",
    "a = 1" + "1" * 500 + "\nd = (1, 2, 3)": "at most 400 letters",
}

FISHEYE = "a = (2 x - W) / H\nb = (2 y - H) / H\nr = max(sqrt(a² + b²), 0.000001)\nd = (a, b, -1 / tan(r)) / r"
MOVED = "a = x / W\no = (3 a, 0, 0)\nd = (0.1, y / H - 0.5, -1) + 0.2 (0, 0, 1) × (1, a, 0)"

VECTORS = "a = (2 x - W) / H\nb = (2 y - H) / H\nd = a (1, 0, 0) + b (0, 1, 0) - (0, 0, 1) + 1 / (9, 9, -9)"


def written(driver, text):
    """Write a text into the editor by keys."""
    box = by_id(driver, "own")
    driver.execute_script("arguments[0].value = ''; arguments[0].scrollIntoView({block: 'center'})", box)
    box.send_keys(text)


@pytest.mark.parametrize("text", REFUSED)
def test_what_is_no_formula_is_refused_in_a_line(opened, text):
    written(opened, text)
    by_id(opened, "own-use").click()
    error = by_id(opened, "own-error").text
    assert REFUSED[text] in error
    assert "\n" not in error
    assert len(error) < 160


@pytest.mark.parametrize("text", [FISHEYE, MOVED, VECTORS])
def test_a_camera_is_cast_mapped_and_written_for_python(page, tmp_path, text):
    with browser(downloads=tmp_path) as driver:
        open_drawn(driver, page)
        written(driver, text)
        by_id(driver, "own-use").click()
        settled(driver, lambda tab: by_id(tab, "label").text == "My camera")
        assert by_id(driver, "own-error").text == ""
        at, cast = state(driver), ray(driver)
        assert numbers(shown(driver, "back to the pixel"))[2] < 1e-6
        by_id(driver, "own-map").click()
        map_text = by_id(driver, "map-text").text
        assert "0 do not" in map_text
        by_id(driver, "own-python").click()
        file = tmp_path / "my_camera.py"
        settled(driver, lambda _: [path.name for path in tmp_path.iterdir()] == [file.name] and file.stat().st_size)
    program = (
        "import sys, numpy as np; sys.path.insert(0, sys.argv[1]); import my_camera, camera_ray_caster as crc\n"
        "camera = crc.camera('MY_CAMERA', (640, 360))\n"
        f"print(*[float(part) for vector in camera.model.rays({at['x']!r}, {at['y']!r}) for part in vector])\n"
        "pixels = np.array([[100.0, 80.0], [500.0, 300.0]])\n"
        "origins, directions = camera.model.rays(*pixels.T)\n"
        "points = np.stack([np.broadcast_to(o + 3 * d, 2) for o, d in zip(origins, directions)], axis=-1)\n"
        "print(*camera.model.project(points).ravel())\n"
    )
    run = subprocess.run([sys.executable, "-c", program, str(tmp_path)], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    again, pixels = (np.array(line.split(), float) for line in run.stdout.splitlines())
    assert again == pytest.approx(cast, abs=1e-13)
    assert pixels == pytest.approx([100, 80, 500, 300], abs=1e-6)


def test_an_own_camera_is_in_the_link_and_survives_a_reload(opened, page):
    fresh(opened, page, "#v=1&model=FISHEYE_EQUIDISTANT")
    settled(opened, lambda tab: state(tab)["model"] == "FISHEYE_EQUIDISTANT" and shown(tab, "pixel"))
    written(opened, MOVED)
    by_id(opened, "own-use").click()
    settled(opened, lambda tab: "own=" in tab.execute_script("return location.hash"))
    before, link = ray(opened), opened.execute_script("return location.hash")
    opened.refresh()
    settled(opened, lambda tab: by_id(tab, "label").text == "My camera")
    assert ray(opened) == before
    assert by_id(opened, "own").get_attribute("value") == MOVED
    fresh(opened, page, link)
    settled(opened, lambda tab: by_id(tab, "label").text == "My camera" and shown(tab, "pixel"))
    assert ray(opened) == before
    by_id(opened, "reset").click()
    settled(opened, lambda tab: by_id(tab, "label").text != "My camera")
    settled(opened, lambda tab: "own=" not in tab.execute_script("return location.hash"))


def test_a_link_with_a_bad_formula_gets_one_line(opened, page):
    fresh(opened, page)
    opened.execute_script("location.hash = 'v=1&model=PERSP&own=d%20%3D%20(alert(1)%2C%20y%2C%201)'")
    settled(opened, lambda tab: "alert is not known" in by_id(tab, "message").text)
    assert by_id(opened, "label").text == "Perspective"
