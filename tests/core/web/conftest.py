"""The page in a file, and one browser that has it open."""

import pytest

from camera_ray_caster.core.web.page import lesson_page

from .chromium import browser, open_drawn


@pytest.fixture(scope="session")
def page(tmp_path_factory):
    """The address of the page."""
    path = tmp_path_factory.mktemp("lesson") / "index.html"
    path.write_text(lesson_page(), encoding="utf-8")
    return path.as_uri()


@pytest.fixture(scope="module")
def opened(page):
    """A browser with the page."""
    with browser() as driver:
        open_drawn(driver, page)
        yield driver
