"""A headless Chromium with WebGL in software, which opens the page from the file system."""

import shutil
from contextlib import contextmanager

import pytest

ARGUMENTS = (
    "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--hide-scrollbars",
)  # fmt: skip


def open_drawn(driver, address):
    """Open the page at an address and wait until its first drawing is done: before, the numbers are empty."""
    driver.get(address)
    settled(driver)


def settled(driver, condition=lambda driver: True):
    """Wait until a condition holds and the page is drawn: its state comes at once, all that it shows a frame later."""
    from selenium.webdriver.support.ui import WebDriverWait

    def holds(driver):
        return is_drawn(driver) and condition(driver) and is_drawn(driver)

    WebDriverWait(driver, 180, 0.1).until(holds)


def is_drawn(driver):
    """Whether the page's picture and numbers are those of its state."""
    return driver.execute_script("return window.lesson.isDrawn()")


@contextmanager
def browser(width=1400, height=1000, *more, downloads=None):
    """A browser with a window of this size; the console has to be empty of errors when it closes."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="needs selenium")
    programs = shutil.which("chromium"), shutil.which("chromedriver")
    if not all(programs):
        pytest.skip("needs Chromium: apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = programs[0]
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    for argument in (*ARGUMENTS, f"--window-size={width},{height}", *more):
        options.add_argument(argument)
    driver = webdriver.Chrome(options=options, service=webdriver.ChromeService(programs[1]))
    try:
        size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        if downloads is not None:
            behavior = {"behavior": "allow", "downloadPath": str(downloads)}
            driver.execute_cdp_cmd("Browser.setDownloadBehavior", behavior)
        yield driver
        assert [line["message"] for line in driver.get_log("browser") if line["level"] == "SEVERE"] == []
    finally:
        driver.quit()
