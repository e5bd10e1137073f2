"""What stands beside the pixel on a phone, the box of the camera obscura, numbers as they are typed, units of times."""

import pytest

from camera_ray_caster.core.web.page import SIZE
from camera_ray_caster.core.web.room import EYE

from .chromium import browser, open_drawn, settled
from .test_page import SCREENS, by_id, fresh, mouse, numbers, ray, shown, state

pytestmark = pytest.mark.full


def test_the_ray_stands_beside_the_pixel_while_a_finger_drags_it(page):
    width, height = SCREENS["phone"]
    with browser(width, height) as driver:
        open_drawn(driver, page)
        tag = by_id(driver, "tag")
        assert not tag.is_displayed()
        mouse(driver).move_to_element(by_id(driver, "picture")).click_and_hold().move_by_offset(-90, 30).perform()
        settled(driver, lambda tab: tag.is_displayed() and abs(state(tab)["x"] - SIZE[0] / 2) > 90)
        assert numbers(tag.text)[:3] == pytest.approx(ray(driver)[3:], abs=1e-2)
        label, cross, frame = (by_id(driver, name).rect for name in ("tag", "cross", "frame"))
        assert label["x"] >= frame["x"]
        assert label["x"] + label["width"] <= frame["x"] + frame["width"]
        middle = cross["x"] + cross["width"] / 2, cross["y"] + cross["height"] / 2
        assert not (abs(label["x"] + label["width"] / 2 - middle[0]) < label["width"] / 2
                    and abs(label["y"] + label["height"] / 2 - middle[1]) < label["height"] / 2)  # fmt: skip
        assert by_id(driver, "space").rect["y"] - (frame["y"] + frame["height"]) < 150, "the second view comes next"
        mouse(driver).release().perform()
        settled(driver, lambda _: not tag.is_displayed())


def test_the_camera_obscura_shows_its_box_and_the_image_upside_down_behind_the_hole(opened, page):
    fresh(opened, page, "#v=1&model=CAMERA_OBSCURA&x=320&y=180")
    settled(opened, lambda tab: state(tab)["model"] == "CAMERA_OBSCURA" and shown(tab, "pixel"))
    for view in ("outside", "side", "above"):
        opened.find_element("css selector", f"[data-view={view}]").click()
        settled(opened, lambda tab: {"hole", "wall"} <= {label["text"] for label in label_texts(tab)})
        assert "eye" not in {label["text"] for label in label_texts(opened)}
    opened.find_element("css selector", "[data-view=outside]").click()
    slope = 3.0 * SIZE[1] / SIZE[0] / 2.0 / 2  # half of the wall's height over the box's depth

    def color(up):
        point = [0.13, EYE + 0.875 * up * slope * 1.4, 3.0 + 1.4]  # behind the hole, between the lines of the grid
        script = ("const [x, y] = window.lesson.place(arguments[0]), g = document.getElementById('space');"
                  "return [...g.getContext('2d').getImageData(Math.round(x), Math.round(y), 1, 1).data]")  # fmt: skip
        return opened.execute_script(script, point)

    settled(opened, lambda tab: color(1)[0] > color(1)[2] + 4)  # the floor, at the top of the wall
    assert color(-1)[2] > color(-1)[0] + 10, "the back wall, at its bottom"


def label_texts(driver):
    """The labels of the second view."""
    return driver.execute_script("return window.lesson.labels()")


def test_a_number_is_typed_with_a_point_or_a_comma(opened, page):
    from selenium.webdriver.common.keys import Keys

    fresh(opened, page)
    box = opened.find_element("css selector", "#view input[aria-label^=Walk]")
    for text, value in (("1,5", 1.5), ("2.25", 2.25)):
        box.send_keys(Keys.CONTROL, "a")
        box.send_keys(text, Keys.ENTER)
        settled(opened, lambda tab, value=value: state(tab)["walk"] == value)
    box.send_keys(Keys.CONTROL, "a")
    box.send_keys("1,5,2", Keys.ENTER)
    assert "must be from" in by_id(opened, "message").text
    assert state(opened)["walk"] == 2.25
    script = """const box = arguments[0];
    for (const text of ["2", "x"]) { box.value = text; box.dispatchEvent(new Event("change")); }
    return new Promise((done) => requestAnimationFrame(() => setTimeout(done, 0)));"""
    opened.execute_script(script, box)  # both before the picture of the first is drawn
    assert "must be from" in by_id(opened, "message").text


def test_times_have_units(opened, page):
    fresh(opened, page, "#v=1&model=PERSP&times=rows&time=0.25")
    settled(opened, lambda tab: shown(tab, "time of the pixel"))
    assert shown(opened, "time of the pixel").endswith(" s")
    labels = [label.text for label in opened.find_elements("css selector", "#view label")]
    assert "Time (s)" in labels
    assert "Time over the picture (s)" in labels
