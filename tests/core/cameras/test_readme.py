"""The page of camera models, which is made from what they declare."""

import runpy
from pathlib import Path

from camera_ray_caster.core.camera import pixel_time
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.programs import PROGRAMS, READ

PAGES = runpy.run_path(str(Path(__file__).parents[3] / "scripts" / "make" / "pages.py"))


def test_every_model_and_every_setting_is_on_the_page():
    page = PAGES["models"]()
    for model in MODELS:
        start = page.index(f"### {model.label}\n")
        section = page[start : page.index("\n##", start)]
        assert f"`{model.key}`" in section
        for setting in model.SETTINGS:
            assert f"| `{setting.name}`" in section
        for step in model.FORMULA:
            assert f"{step.words}: `{step.symbols}`" in section
    assert all(f"`{mode}`" in page for mode in pixel_time.SETTINGS)


def test_every_export_and_every_program_is_on_the_page_of_files():
    page = PAGES["files"]()
    exports = {program.export.key for program in PROGRAMS if program.export}
    for export in EXPORT_FORMATS:
        assert export.key in exports, f"no program of core/programs has the export {export.key}"
    assert exports == {export.key for export in EXPORT_FORMATS}
    for program in PROGRAMS:
        assert f"| {program.name} | {program.files} | {program.reads} |" in page
        assert program.read is None or program.name in READ
