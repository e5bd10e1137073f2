"""Sphinx's settings: the site is made of the Markdown pages where they stand, and of pages made from the code.

    make docs

The folder of sources is the repository, so that links between pages are the same here as in any viewer of files.
"""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "addon"), str(ROOT / "scripts"), str(ROOT / "docs")]

from camera_ray_caster import __version__  # noqa: E402  (found by the line above)

project = "Camera Ray Caster"
copyright = "the authors of Camera Ray Caster, GPL-3.0-or-later"
version = release = __version__

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode", "site_pages"]
root_doc = "docs/index"
include_patterns = [
    "docs/**.md",
    "README.md", "CONTRIBUTING.md", "CHANGELOG.md", "addon/README.md", "scripts/README.md", "blend_scenes/README.md",
    "addon/camera_ray_caster/core/programs/README.md", "addon/camera_ray_caster/core/cameras/README.md",
    "addon/camera_ray_caster/blender/read/README.md",
]  # fmt: skip
exclude_patterns = [".venv*", "out", "dist", "build", "docs/lesson"]

myst_heading_anchors = 3
myst_enable_extensions = ["html_image"]
smartquotes = False  # u' is a name in a formula

autodoc_member_order = "bysource"
autodoc_typehints = "none"
add_module_names = False

html_theme = "furo"
html_title = f"Camera Ray Caster {version}"
PAGE_FILES = "../addon/camera_ray_caster/core/web/page_files"
html_static_path = ["_static", f"{PAGE_FILES}/formula.js", f"{PAGE_FILES}/mathml.js"]
html_css_files = ["site.css"]
html_js_files = [(name, {"defer": ""}) for name in ("formula.js", "mathml.js", "set_formulas.js")]
html_copy_source = False
html_theme_options = {"sidebar_hide_name": False}
pygments_style, pygments_dark_style = "tango", "github-dark"
