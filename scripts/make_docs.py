"""Write the pages of camera models and of files, the picture of the house, and the lesson for a browser.

    python scripts/make_docs.py
    python scripts/make_docs.py --check    # writes nothing; exit status 1 if one is not up to date

Needs numpy only.
"""

from __future__ import annotations

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CAMERAS = ROOT / "addon" / "camera_ray_caster" / "core" / "cameras"

TABLE = ROOT / "tests" / "core" / "test_architecture.py"
"""The test that says who may import whom."""


def rounded(text: str) -> str:
    """Return a page with numbers of many digits rounded: versions of numpy differ in the last ones."""
    return re.sub(r"\d+\.\d{9,}(e-?\d+)?", lambda found: f"{float(found[0]):.11g}", text)


def main() -> int | str:
    """Write the pages, or with --check return an error message if one is not up to date."""
    sys.path.insert(0, str(ROOT / "addon"))
    from arguments import Parser  # in this folder
    from make import architecture, pages

    from camera_ray_caster.core.web.page import lesson_page

    parser = Parser(prog="make_docs.py", description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing; exit status 1 if it is not up to date")
    texts = {
        CAMERAS / "README.md": pages.models(),
        CAMERAS.parent / "programs" / "README.md": pages.files(),
        ROOT / "docs" / "pictures" / "architecture.svg": architecture.picture(TABLE),
        ROOT / "docs" / "lesson" / "index.html": lesson_page(),
    }
    if not parser.parse_args().check:
        for path, text in texts.items():
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return 0
    stored = {path: path.read_text(encoding="utf-8") if path.exists() else "" for path in texts}
    old = [path for path, text in texts.items() if rounded(stored[path]) != rounded(text)]
    return f"{old[0].relative_to(ROOT)} is not up to date: run scripts/make_docs.py" if old else 0


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
