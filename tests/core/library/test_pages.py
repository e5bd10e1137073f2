"""The pages in docs/: their code runs where only numpy is installed, and their links lead to what exists."""

import re
from pathlib import Path

import pytest

from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.programs import PROGRAMS

from .test_program import ADDON, run

ROOT = ADDON.parent
DOCS = sorted((ROOT / "docs").glob("*.md")) + sorted((ROOT / "docs" / "tutorials").glob("*.md"))
WITH_BLENDER = {"python.md", "data_set.md", "strange_camera_in_cycles.md"}
"""Their code is run by tests/blender/test_readme.py and tests/scripts/test_tutorials.py."""
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)
PAGES = [page for page in DOCS if page.name not in WITH_BLENDER and BLOCK.search(page.read_text(encoding="utf-8"))]


def test_there_are_pages_with_code():
    assert {page.stem for page in PAGES} >= {"accuracy", "camera_of_your_own", "conventions", "formats", "lesson"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_code_of_a_page_runs(page, tmp_path):
    code = "\n".join(BLOCK.findall(page.read_text(encoding="utf-8")))
    run(f"import os\nos.chdir({str(tmp_path)!r})\n" + code)


def test_links_between_pages_lead_to_what_exists():
    """As a viewer of files follows them: without the pages that the site makes."""
    folders = ".", "scripts", "listing", "blend_scenes", "addon/**"
    pages = [*DOCS, *(page for folder in folders for page in ROOT.glob(f"{folder}/*.md"))]
    broken = {}
    for page in pages:
        text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
        broken[page.relative_to(ROOT)] = [link for link in LINK.findall(text) if not leads_somewhere(page, link)]
    assert {page: links for page, links in broken.items() if links} == {}


def leads_somewhere(page: Path, link: str) -> bool:
    """Whether a link is an address of the web, by its form, or a file, and a heading in it."""
    if ":" in link:
        return bool(re.fullmatch(r"(https://[\w-]+(\.[\w-]+)+(/\S*)?|mailto:\S+@\S+)", link))
    path, _, anchor = link.partition("#")
    file = (page.parent / path).resolve() if path else page
    if not file.exists() or not file.is_relative_to(ROOT):
        return False
    headings = HEADING.findall(file.read_text(encoding="utf-8")) if anchor else []
    return not anchor or anchor in {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_a_link_to_nothing_is_seen():
    page = ROOT / "docs" / "python.md"
    for link in ("conventions.md#pixels", "../README.md", "https://www.blender.org/"):
        assert leads_somewhere(page, link), link
    for link in ("convention.md", "conventions.md#pixel", "../../README.md", "http:/blender", "https://blender"):
        assert not leads_somewhere(page, link), link


def test_the_numbers_of_the_pages_are_those_of_today():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    read = sum(any((program.read, program.poses, program.rays)) for program in PROGRAMS)
    assert re.findall(r"\*\*(\d+) camera models\*\*", readme) == [str(len(MODELS))]
    assert re.findall(r"\[(\d+) programs\]", readme) == [str(read)]
    assert re.findall(r"writes (\d+)\.", readme) == [str(len(EXPORT_FORMATS))]
    manifest = (ADDON / "camera_ray_caster" / "blender_manifest.toml").read_text(encoding="utf-8")
    assert f'tagline = "{len(MODELS)} ' in manifest
