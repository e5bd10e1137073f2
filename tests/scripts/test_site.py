"""The documentation site: built without Blender, with warnings as errors; its links, its pages of models and names."""

import html
import importlib
import os
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

import numpy as np
import pytest

import camera_ray_caster as crc

from .running import ROOT

pytestmark = pytest.mark.full
pytest.importorskip("sphinx", reason="the extra docs is not installed")

SECONDS = 120
"""Of the processors, for the whole site; it takes 20."""
BUILD = """
import sys
class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {"bpy", "mathutils", "bmesh", "gpu", "imbuf"}:
            raise ModuleNotFoundError(name, name=name)
sys.meta_path.insert(0, Refuse())
from sphinx.cmd.build import main
sys.exit(main(sys.argv[1:]))
"""
"""Sphinx where Blender cannot be imported."""


class Page(HTMLParser):
    """What a page links to, and where it can be linked to."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """Keep links and anchors."""
        values = dict(attrs)
        self.anchors |= {values[key] for key in ("id", "name") if values.get(key)}
        self.links += [values[key] for key in ("href", "src") if values.get(key)]


def children():
    """Seconds of the processors that the processes that this one has waited for have used."""
    return sum(os.times()[2:4])


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder of the built site."""
    folder = tmp_path_factory.mktemp("site")
    words = ["-q", "-W", "--keep-going", "-E", "-c", ROOT / "docs", "-d", folder / "doctrees", ROOT, folder / "site"]
    before = children()
    done = subprocess.run([sys.executable, "-c", BUILD, *map(str, words)], capture_output=True, text=True, timeout=600)
    assert (done.returncode, done.stderr) == (0, "")
    assert children() - before < SECONDS
    return folder / "site"


@pytest.fixture(scope="module")
def pages(site):
    """The pages by path."""
    return {path: Page(path.read_text(encoding="utf-8")) for path in site.rglob("*.html")}


def test_every_link_leads_somewhere(site, pages):
    broken = []
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                is_right = parts.scheme in {"https", "http", "data", "mailto"} and bool(parts.netloc or parts.path)
            else:
                target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
                is_right = target.exists() and target.is_relative_to(site)
                if is_right and parts.fragment and target in pages and target.parent.name != "lesson":  # a state
                    is_right = unquote(parts.fragment) in pages[target].anchors
            if not is_right:
                broken.append((path.relative_to(site).as_posix(), link))
    assert broken == []
    assert len(pages) > 50


def test_no_page_asks_another_host_for_anything(site):
    """Scripts, styles and fonts come with the site."""
    asked = re.compile(r'<(?:script|img|iframe)[^>]* src="(?:https?:)?//|<link[^>]* href="(?:https?:)?//')
    assert [path for path in site.rglob("*.html") if asked.search(path.read_text(encoding="utf-8"))] == []


def test_every_public_name_is_documented(pages, site):
    anchors = pages[site / "docs" / "api" / "index.html"].anchors
    assert {name for name in crc.__all__ if f"camera_ray_caster.{name}" not in anchors} == set()


@pytest.mark.parametrize("key", crc.models())
def test_every_model_has_its_page(key, site):
    """With its picture, all of its settings, its formula, and code that runs."""
    text = (site / "docs" / "cameras" / f"{key.lower()}.html").read_text(encoding="utf-8")
    assert re.search(r'<img alt="What this camera sees"[^>]* src="\.\./\.\./_images/\w+\.png"', text)
    assert [setting.name for setting in crc.models()[key].SETTINGS if f">{setting.name}<" not in text] == []
    page = html.unescape(text)
    assert [step for step in crc.models()[key].FORMULA if step.words not in page or step.symbols not in page] == []
    source = (ROOT / "docs" / "cameras" / f"{key.lower()}.md").read_text(encoding="utf-8")
    names = {}
    exec(re.search(r"^```python\n(.*?)^```$", source, re.MULTILINE | re.DOTALL)[1], names)
    assert names["rays"].directions.shape == (480, 640, 3)


def test_pages_of_models_open_the_lesson_with_the_model(site):
    lesson = (site / "docs" / "lesson" / "index.html").read_text(encoding="utf-8")
    pages = {
        key: (site / "docs" / "cameras" / f"{key.lower()}.html").read_text(encoding="utf-8") for key in crc.models()
    }
    links = {key: re.findall(r'href="\.\./lesson/index\.html#(.*?)"', text) for key, text in pages.items()}
    expected = {key: [f"v=1&amp;model={key}"] if f'"key":"{key}"' in lesson else [] for key in pages}
    assert links == expected
    assert sum(map(bool, links.values())) >= 34
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("needs Chromium: apt-get install chromium")
    address = (site / "docs" / "lesson" / "index.html").as_uri() + "#" + html.unescape(links["PUSHBROOM"][0])
    words = [chromium, "--headless=new", "--no-sandbox", f"--user-data-dir={site.parent / 'profile'}", "--dump-dom"]
    shown = subprocess.run([*words, address], capture_output=True, text=True, timeout=300).stdout
    assert '<span id="label">Pushbroom</span>' in shown


def test_the_start_leads_to_three_paths(site):
    text = (site / "docs" / "index.html").read_text(encoding="utf-8")
    paths = ["For computer vision", "For pictures", "For teaching"]
    assert re.findall(r"<h2>(.*?)<a", text) == [*paths, "Install"]
    assert "url=docs/index.html" in (site / "index.html").read_text(encoding="utf-8")


def test_a_model_that_the_gallery_does_not_show_is_cast(monkeypatch, tmp_path):
    for folder in ("docs", "scripts"):
        monkeypatch.syspath_prepend(str(ROOT / folder))
    pages = importlib.import_module("model_pages")
    monkeypatch.setitem(pages.SHOWN_BY, "FOV", None)
    monkeypatch.setattr(pages, "PICTURES", tmp_path.relative_to("/"))
    shown = pages.picture(crc.models()["FOV"], tmp_path, tmp_path)
    assert shown == "../../fov.png"
    assert (tmp_path / "fov.png").read_bytes().startswith(b"\x89PNG")
    colors = pages.room_seen_by(crc.models()["FOV"])
    assert colors.shape == (320, 480, 4)
    assert len(np.unique(colors.reshape(-1, 4), axis=0)) > 1000  # balls and ground, with a grid
