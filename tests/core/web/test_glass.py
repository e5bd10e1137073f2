"""The section of a lens in the page, by real mouse and keyboard events, beside the paths that Step Through draws."""

import numpy as np
import pytest

from camera_ray_caster.core.cameras.real_lens import RealLens
from camera_ray_caster.core.lesson.lens_diagram import chief_path
from camera_ray_caster.core.web.page import example

from .chromium import settled
from .test_page import by_id, fresh, mouse, state

pytestmark = pytest.mark.full
LINK = "#v=1&model=REAL_LENS&x=500&y=300"


def seen(driver):
    return driver.execute_script("return window.lesson.glass()")


def test_the_section_has_the_ray_of_the_pixel_and_its_stop_and_film_are_dragged(opened, page):
    from selenium.webdriver.common.keys import Keys

    fresh(opened, page)
    assert not by_id(opened, "glass-card").is_displayed()
    fresh(opened, page, LINK)
    settled(opened, lambda tab: state(tab)["model"] == "REAL_LENS" and by_id(tab, "glass-card").is_displayed())
    model, first = example(RealLens).model, seen(opened)
    path = chief_path(model, 500, 300)
    height = np.hypot(*path.points[:, :2].T) / model.unit
    depth = path.points[:, 2] / model.unit + model.pupil
    points = np.array(first["chief"]["points"])
    np.testing.assert_allclose(points[:, 0], depth, rtol=0, atol=1e-10)
    np.testing.assert_allclose(np.abs(points[:, 1]), height, rtol=0, atol=1e-10)
    sines = [(np.sin(refraction.in_front), np.sin(refraction.at_back)) for refraction in path.refractions]
    np.testing.assert_allclose([sine[1:] for sine in first["chief"]["sines"]], sines, rtol=0, atol=1e-12)
    stop = len(model.optics.surfaces) - model.optics.stop
    reached = [
        path_of["points"][stop][1] / first["radius"] for path_of in first["fan"] if len(path_of["points"]) > stop
    ]
    assert len(reached) >= 6
    assert np.abs(np.subtract.outer(reached, [-0.95, -0.7, -0.45, -0.2, 0.2, 0.45, 0.7, 0.95])).min(axis=1).max() < 1e-9
    assert first["fNumber"] == pytest.approx(model.facts()["f_number"], rel=1e-12)
    assert f"f/{first['fNumber']:.3g}" in by_id(opened, "glass-text").text

    canvas = by_id(opened, "glass")
    opened.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
    canvas.send_keys(Keys.SHIFT, Keys.ARROW_DOWN)
    settled(opened, lambda tab: seen(tab)["radius"] == pytest.approx(0.8 * first["radius"]))
    assert seen(opened)["fNumber"] == pytest.approx(first["fNumber"] / 0.8)
    film = mouse(opened).move_to_element_with_offset(canvas, int(0.4 * canvas.size["width"]), 0).click_and_hold()
    film.move_by_offset(-8, 0).release().perform()
    settled(opened, lambda tab: seen(tab)["film"] < first["film"])
    nearer = seen(opened)
    assert nearer["focus"] < 0 or nearer["focus"] > first["focus"]  # the film nearer to the lens: farther things
    assert nearer["fNumber"] == pytest.approx(first["fNumber"] / 0.8)


def test_the_picture_follows_the_stop_and_the_film(opened, page):
    """With the stop almost closed it is that of the chief rays, times cos^4; with it open, edges are soft, the more so
    with the film out of focus.
    """
    from selenium.webdriver.common.keys import Keys

    fresh(opened, page, LINK)
    settled(opened, lambda tab: by_id(tab, "glass-card").is_displayed())
    opened.execute_script("window.lesson.fixLensQuality(12, 1)")  # by itself a busy machine draws fewer pixels
    canvas = by_id(opened, "glass")
    opened.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
    sharp = light_of(opened)
    canvas.send_keys(Keys.SHIFT, *18 * [Keys.ARROW_DOWN])
    settled(opened, lambda tab: seen(tab)["fNumber"] > 90)
    closed = light_of(opened)
    model, (height, width) = example(RealLens).model, closed.shape[:2]
    x, y = (np.arange(width) + 0.5) * model.size[0] / width, (np.arange(height) + 0.5) * model.size[1] / height
    a, b = model.window.plane_from_pixels(x, y[:, None])
    away = (model.film - model.optics.exit_pupil[0]) ** 2
    rows, columns, _ = (
        (np.arange(size) + 0.5) * whole / size for size, whole in zip(closed.shape, sharp.shape, strict=True)
    )
    expected = sharp[np.ix_(rows.astype(int), columns.astype(int))] * ((away / (away + a * a + b * b)) ** 2)[..., None]
    assert (np.abs(closed - expected).max(axis=2) < 0.02).mean() > 0.95  # but for edges, whose pixels are others

    opened.execute_script("window.lesson.fixLensQuality(48, 0.5)")  # no steps between the samples of a pixel
    canvas.send_keys(Keys.SHIFT, *24 * [Keys.ARROW_UP])
    settled(opened, lambda tab: seen(tab)["fNumber"] == pytest.approx(model.optics.widest_f_number))
    wide = light_of(opened)
    canvas.send_keys(Keys.SHIFT, *4 * [Keys.ARROW_LEFT])
    settled(opened, lambda tab: seen(tab)["film"] < model.film - 1.9)
    soft = light_of(opened)
    edges = [np.abs(np.diff(light.mean(axis=2)[len(light) // 2])).max() * light.shape[1] for light in (wide, soft)]

    assert edges[0] > 1.2 * edges[1]  # measured 3.5
    by_id(opened, "reset").click()
    settled(opened, lambda tab: seen(tab)["film"] == model.film)
    np.testing.assert_array_equal(light_of(opened), sharp)


def light_of(driver):
    """The picture in full, once it is drawn: linear, rows from the bottom."""
    settled(driver)
    size, data = driver.execute_script(
        "const canvas = document.getElementById('picture'), gl = canvas.getContext('webgl2');"
        "const bytes = new Uint8Array(4 * canvas.width * canvas.height);"
        "gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);"
        "return [[canvas.height, canvas.width], Array.from(bytes)]"
    )
    return (np.array(data, float).reshape(*size, 4)[..., :3] / 255) ** 2.2
