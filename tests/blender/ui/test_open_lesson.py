"""Open Lesson: a page with the scene's camera and the clicked pixel, beside the .blend, which a browser opens."""

import re
import shutil
import subprocess
import webbrowser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender.view3d import pixel_lessons

PIXEL = 21, 5
ROUNDING = 5e-7
"""Of the page's numbers, which have six digits."""


@pytest.fixture
def asked(blender, monkeypatch):
    """The addresses that a browser is asked for; two pixels are clicked."""
    opened = []
    monkeypatch.setattr(webbrowser, "open", lambda address, *more: opened.append(address) or True)
    pixel_lessons.clicked.choose([(1, 1), PIXEL])
    yield opened
    pixel_lessons.forget()


@pytest.fixture
def fisheye(scene):
    """The scene, with a calibrated fisheye."""
    settings = scene.camera.data.camera_ray_caster
    settings.model = "OPENCV_FISHEYE"
    settings.calibration_width, settings.calibration_height = 24, 16
    settings.fx, settings.fy, settings.cx, settings.cy, settings.k1 = 9.5, 9.25, 11.0, 7.0, 0.03
    scene.camera.name = "Left: eye"
    return scene


def page_of(asked):
    """The page that a browser was asked for, once."""
    (address,) = asked
    parts = urlsplit(address)
    assert (parts.scheme, parts.netloc, parts.query, parts.fragment) == ("file", "", "", "")
    return Path(unquote(parts.path))


def test_the_page_is_written_beside_the_file_and_opened(blender, asked, fisheye, tmp_path):
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a scene #1.blend"))
    for _ in range(2):  # the second time it is written again
        asked.clear()
        assert blender.ops.camera_ray_caster.open_lesson() == {"FINISHED"}
        page = page_of(asked)
        assert page == tmp_path / "a scene #1_Left_ eye_lesson.html"
        text = page.read_text(encoding="utf-8")
    assert '"OPENCV_FISHEYE"' in text
    assert "9.25" in text
    assert re.findall(r"""(?:src|href)=["']?(?!data:)[^"' >]+""", text) == []  # it is one file
    assert sorted(path.suffix for path in tmp_path.iterdir()) == [".blend", ".html"]


def test_without_a_file_it_is_in_the_home_folder(asked, fisheye, blender, tmp_path, monkeypatch):
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    pixel_lessons.forget()
    assert blender.ops.camera_ray_caster.open_lesson() == {"FINISHED"}
    page = page_of(asked)
    assert page == tmp_path / "untitled_Left_ eye_lesson.html"
    assert "{x: 12.5, y: 8.5}" in page.read_text(encoding="utf-8"), "without a pixel it begins in the middle"


def test_a_folder_that_cannot_be_written_is_named(asked, fisheye, blender, tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setattr(Path, "home", lambda: tmp_path / "file")
    with pytest.raises(RuntimeError, match="file"):
        blender.ops.camera_ray_caster.open_lesson()
    assert asked == []
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_without_a_camera_it_is_gray(asked, scene, blender):
    scene.camera = None
    assert not blender.ops.camera_ray_caster.open_lesson.poll()


@pytest.mark.full
def test_a_browser_shows_the_same_ray(asked, fisheye, blender, tmp_path):
    """All six digits that the page shows are those of the camera that was read."""
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("needs Chromium: apt-get install chromium")
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "scene.blend"))
    blender.ops.camera_ray_caster.open_lesson()
    words = [chromium, "--headless=new", "--no-sandbox", f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom"]
    done = subprocess.run([*words, page_of(asked).as_uri()], capture_output=True, text=True, timeout=300)
    text = re.sub(r"</?span>", "", done.stdout)
    shown = dict(re.findall(r"<dt>(.*?)</dt><dd>(.*?)</dd>", text))
    assert shown["pixel"] == f"x = {PIXEL[0] + 0.5}, y = {PIXEL[1] + 0.5}"
    camera = crc.read_camera(fisheye)
    _, direction = camera.model.rays(PIXEL[0] + 0.5, PIXEL[1] + 0.5)
    numbers, remark = shown["direction r"].replace("−", "-").removeprefix("(").split(")")
    assert remark.strip() == "of unit length"
    shown_direction = [float(number) for number in numbers.split(",")]
    np.testing.assert_allclose(shown_direction, [float(number) for number in direction], rtol=0, atol=ROUNDING)
    assert "OpenCV Fisheye" in done.stdout
