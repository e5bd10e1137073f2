"""The page by real mouse and keyboard events: drag, knob, link, figures, screens, bad links, without WebGL."""

import json
import re
from itertools import combinations

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.web.figures import FIGURES
from camera_ray_caster.core.web.page import SIZE, lesson_page

from .chromium import browser, open_drawn, settled

pytestmark = pytest.mark.full

LIMIT = 1_000_000
"""Bytes of the page."""
SCREENS = {"phone": (390, 844), "tablet": (820, 1180), "projector": (1280, 720), "large": (1920, 1080)}

BAD = {
    "v=1&model=%3Cscript%3Ealert(1)%3C/script%3E": "does not have",
    "v=1&model=PERSP&lens=NaN": "must be a number",
    "v=1&model=PERSP&lens=1e999": "must be a number",
    "v=1&model=PERSP&lens=-5": "must be from",
    "v=1&model=PERSP&x=641": "must be from",
    "v=1&model=PERSP&sensor_fit=ROUND": "must be one of AUTO, HORIZONTAL, VERTICAL",
    "v=1&model=PERSP&lens": "must be a number",
    "v=1&model=PERSP&constructor=1": "does not have",
    "v=1&model=__proto__": "does not have",
    "v=99&model=PERSP": "version",
    "model=PERSP": "version",
    "nothing": "version",
    "v=1&model=PERSP&own=" + "x" * 1_000_000: "too long",
}


def shown(driver, name):
    """A row of the numbers."""
    script = "return [...document.querySelectorAll('#numbers dt')].find((node) => node.textContent === arguments[0])"
    return driver.execute_script(f"{script}?.nextSibling.textContent", name)


def numbers(text):
    """The numbers in a text."""
    return [float(number) for number in re.findall(r"-?\d+\.?\d*(?:e[-+]?\d+)?", text)]


def ray(driver):
    """The ray of the pixel, all its digits."""
    return driver.execute_script("return window.lesson.ray()")


def state(driver):
    """The page's state."""
    return driver.execute_script("return window.lesson.state()")


def mouse(driver):
    """A chain of mouse events."""
    from selenium.webdriver import ActionChains

    return ActionChains(driver, duration=40)


def fresh(driver, page, link=""):
    """Open the page anew with a link."""
    driver.get("about:blank")
    open_drawn(driver, page + link)


def by_id(driver, name):
    """An element."""
    return driver.find_element("id", name)


def test_the_page_is_one_file_of_less_than_a_megabyte():
    text = lesson_page()
    assert len(text.encode()) < LIMIT
    assert not re.search(r"\beval\(|innerHTML|outerHTML|document\.write|new Function|\bimport\b.*from|fetch\(", text)
    assert not re.search(r'(src|href)="', text)


def test_a_drag_in_the_picture_moves_the_ray(opened, page):
    fresh(opened, page)
    canvas = by_id(opened, "picture")
    mouse(opened).move_to_element(canvas).click_and_hold().move_by_offset(80, -40).release().perform()
    settled(opened, lambda tab: shown(tab, "pixel") != "x = 448, y = 198")
    at = state(opened)
    assert (at["x"], at["y"]) != (448, 198)
    expected = crc.camera("PERSP", SIZE).model.rays(at["x"], at["y"])[1]
    assert ray(opened)[3:] == pytest.approx(list(expected), rel=1e-14)
    assert numbers(shown(opened, "direction r")) == pytest.approx(list(expected), rel=1e-5)
    assert numbers(shown(opened, "back to the pixel"))[:2] == pytest.approx([at["x"], at["y"]], rel=1e-5)


@pytest.mark.parametrize("key", ["FISHEYE_EQUIDISTANT", "OPENCV_FISHEYE", "PUSHBROOM"])
def test_three_cameras_answer_the_exercise(opened, page, key):
    """Given (x, y) on the screen, what is the ray?"""
    fresh(opened, page, f"#v=1&model={key}&x=300.5&y=120.25")
    settled(opened, lambda tab: state(tab)["model"] == key and shown(tab, "direction r"))
    lines = {"slit_1": [(-1, 0, 0), (1, 0, 0)]} if key == "PUSHBROOM" else {}
    frame = (360, 360) if key == "FISHEYE_EQUIDISTANT" else SIZE  # a circle
    origin, direction = crc.camera(key, frame, **lines).model.rays(300.5, 120.25)
    assert ray(opened) == pytest.approx([float(number) for number in (*origin, *direction)], abs=1e-13)
    values = opened.execute_script("return document.querySelectorAll('#steps .numbers').length")
    assert values >= 2


def test_a_knob_changes_the_numbers_and_the_picture(opened, page):
    fresh(opened, page)
    before = by_id(opened, "steps").text
    knob = by_id(opened, "lens-range")
    opened.execute_script("arguments[0].scrollIntoView({block: 'center'})", knob)
    mouse(opened).move_to_element(knob).click_and_hold().move_by_offset(60, 0).release().perform()
    settled(opened, lambda tab: by_id(tab, "steps").text != before)
    lens = state(opened)["values"]["lens"]
    assert lens != 50
    x, y = state(opened)["x"], state(opened)["y"]
    expected = crc.camera("PERSP", SIZE, lens=lens).model.rays(x, y)[1]
    assert ray(opened)[3:] == pytest.approx(list(expected), rel=1e-13)


def test_a_link_holds_the_state(opened, page):
    fresh(opened, page, "#v=1&model=FISHEYE_EQUIDISTANT&fisheye_fov=2.5&x=300&y=100&times=rows&turn=0.5")
    settled(opened, lambda tab: state(tab)["model"] == "FISHEYE_EQUIDISTANT")
    from selenium.webdriver.common.keys import Keys

    by_id(opened, "picture").send_keys(Keys.ARROW_RIGHT, Keys.SHIFT, Keys.ARROW_UP)
    by_id(opened, "share").click()
    first, link = state(opened), opened.execute_script("return location.hash")
    assert (first["x"], first["y"]) == (301, 110)
    fresh(opened, page, link)
    settled(opened, lambda tab: state(tab)["model"] == "FISHEYE_EQUIDISTANT")
    assert state(opened) == first


@pytest.mark.parametrize("link", BAD)
def test_a_bad_link_gets_one_line(opened, page, link):
    fresh(opened, page)
    opened.execute_script("location.hash = arguments[0]", link)
    settled(opened, lambda tab: by_id(tab, "message").text)
    text = by_id(opened, "message").text
    assert BAD[link] in text
    assert len(text) < 200
    assert "\n" not in text
    assert state(opened)["model"] == "PERSP"
    assert not opened.execute_script("return document.querySelectorAll('#message *').length")


def test_a_link_is_read_though_the_page_writes_its_own_before_it(opened, page):
    """The address is written a quarter of a second after a change, which may lie between a link and its event."""
    fresh(opened, page)
    script = "location.hash = arguments[0]; history.replaceState(null, '', '#v=1&model=PERSP&lens=40')"
    opened.execute_script(script, "v=1&model=FISHEYE_EQUIDISTANT&x=300")
    settled(opened, lambda tab: state(tab)["model"] == "FISHEYE_EQUIDISTANT")
    assert state(opened)["x"] == 300


def test_figures_are_states_of_the_page(opened, page):
    fresh(opened, page)
    for number, figure in enumerate(FIGURES):
        button = opened.find_elements("css selector", "#figures button")[number]
        opened.execute_script("arguments[0].scrollIntoView()", button)
        button.click()
        settled(opened, lambda tab, figure=figure: state(tab)["model"] == figure["model"] and shown(tab, "pixel"))
        assert by_id(opened, "caption").text == figure["text"]
        assert by_id(opened, "message").text == ""
        labels = opened.execute_script("return window.lesson.labels()")
        for label, other in combinations(labels, 2):
            assert abs(label["x"] - other["x"]) >= label["half"] + other["half"] or abs(label["y"] - other["y"]) >= 13
        assert len(labels) >= 4


def test_every_model_can_be_chosen_and_its_steps_have_numbers(opened, page):
    fresh(opened, page)
    without, worked_out = [], set()
    for key in opened.execute_script("return window.lesson.models"):
        opened.execute_script("location.hash = arguments[0]", f"v=1&model={key}")
        settled(opened, lambda tab, key=key: state(tab)["model"] == key and shown(tab, "pixel"))
        assert by_id(opened, "message").text == ""
        shown_numbers = [line.text for line in opened.find_elements("css selector", "#steps .numbers")]
        if not shown_numbers:
            without.append(key)
        direction = np.array(ray(opened)[3:])
        page_text = by_id(opened, "numbers").text + by_id(opened, "steps").text
        assert not re.search(r"[1-9]\d*\.\d{8}|\b0\.0*[1-9]\d{7}|\de-1\d", page_text), "no digits of rounding"
        assert opened.find_elements("css selector", "#steps math"), key
        for line in shown_numbers:  # the formula with its numbers ends at the ray that the picture has
            r = numbers(line.rpartition("= (")[2]) if line.startswith("r = ") else []
            if len(r) == 3:
                assert np.cross(r, direction) / np.linalg.norm(r) == pytest.approx([0, 0, 0], abs=2e-5), (key, line)
                assert np.dot(r, direction) > 0, (key, line)
                worked_out.add(key)
    assert without == []
    assert {"PERSP", "OPENCV_FISHEYE", "EQUIRECTANGULAR"} < worked_out


@pytest.mark.parametrize("screen", SCREENS)
def test_it_fits_screens(page, screen):
    width, height = SCREENS[screen]
    with browser(width, height) as driver:
        open_drawn(driver, page)
        assert driver.execute_script("return document.documentElement.scrollWidth <= window.innerWidth")
        wide = driver.execute_script(
            "return [...document.querySelectorAll('main *')].filter((node) => node.getBoundingClientRect().right"
            " > window.innerWidth + 1).map((node) => node.id || node.tagName)"
        )
        assert wide == []
        figures = "[...document.querySelectorAll('#figures button')].map((node) => node.getBoundingClientRect().right)"
        assert max(driver.execute_script(f"return {figures}")) <= width
        canvas = by_id(driver, "picture")
        mouse(driver).move_to_element(canvas).click().perform()
        settled(driver, lambda tab: abs(state(tab)["x"] - SIZE[0] / 2) < 3)


def test_inputs_have_names_and_contrast_is_high(opened, page):
    fresh(opened, page)
    unnamed = opened.execute_script(
        "return [...document.querySelectorAll('input, select, textarea, canvas, button')].filter((node) =>"
        " !(node.labels?.length || node.getAttribute('aria-label') || node.textContent.trim())).map((node) => node.id)"
    )
    assert [name for name in unnamed if name != "map"] == []
    for theme in ("light", "dark"):
        opened.execute_script("document.documentElement.dataset.theme = arguments[0]", theme)
        colors = opened.execute_script(
            "const style = getComputedStyle(document.documentElement);"
            "return ['--card', '--ink', '--muted', '--bad', '--ray', '--accent']"
            ".map((name) => style.getPropertyValue(name).trim())"
        )
        card, *others = map(luminance, colors)
        for other in others:
            assert (max(card, other) + 0.05) / (min(card, other) + 0.05) >= 4.5  # WCAG 2.2, AA


def luminance(color):
    """Relative luminance of a color #rrggbb: WCAG 2.2."""
    parts = np.array([int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)])
    linear = np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)
    return linear @ (0.2126, 0.7152, 0.0722)


def test_without_webgl_the_numbers_are_there(page):
    with browser(1200, 900, "--disable-3d-apis") as driver:
        open_drawn(driver, page)
        assert "no WebGL" in by_id(driver, "blank").text
        mouse(driver).move_to_element(by_id(driver, "picture")).click().perform()
        settled(driver, lambda tab: abs(state(tab)["x"] - SIZE[0] / 2) < 3)
        assert numbers(shown(driver, "direction r"))[2] == -1
        by_id(driver, "own-use").click()
        assert by_id(driver, "own-error").text == ""


def test_nothing_is_asked_of_a_network(page):
    with browser() as driver:
        open_drawn(driver, page)
        for button in ("own-map", "own-use", "theme", "reset"):
            driver.execute_script("document.getElementById(arguments[0]).click()", button)
        events = [json.loads(line["message"])["message"] for line in driver.get_log("performance")]
        asked = {
            event["params"]["request"]["url"].partition(":")[0]
            for event in events if event["method"] == "Network.requestWillBeSent"
        }  # fmt: skip
        assert asked <= {"file", "data", "blob"}


def test_a_camera_of_blender_has_a_page_of_its_own(tmp_path):
    slits = {"slit_1": [(0, 0, 0), (1, 0, 0)], "slit_2": [(0, -1, 2), (0, 1, 2)]}
    camera = crc.camera("CROSS_SLIT", (96, 54), lens=20.0, **slits)
    path = tmp_path / "lesson.html"
    path.write_text(lesson_page(camera, (70, 12)), encoding="utf-8")
    with browser() as driver:
        open_drawn(driver, path.as_uri())
        settled(driver, lambda tab: shown(tab, "pixel") == "x = 70.5, y = 12.5")
        origin, direction = camera.model.rays(70.5, 12.5)
        assert ray(driver) == pytest.approx([float(number) for number in (*origin, *direction)], abs=1e-13)
