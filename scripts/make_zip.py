"""Build the extension: the add-on, its license, and the gallery with a picture of each scene.

    python scripts/make_zip.py            into dist/
    python scripts/make_zip.py FOLDER

Standard library only. The tests have Blender validate and install what it builds.
"""

from __future__ import annotations

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
import tomllib
import zipfile
from argparse import RawDescriptionHelpFormatter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "addon" / "camera_ray_caster"
SCENES = ROOT / "blend_scenes"


def content() -> dict[str, Path]:
    """Return the files of the extension by their names in the zip, sorted."""
    sources = [path for path in PACKAGE.rglob("*") if path.is_file()]
    files = {path.relative_to(PACKAGE).as_posix(): path for path in sources if path.parent.name != "__pycache__"}
    for path in (*SCENES.glob("*.blend"), *SCENES.glob("*.npz")):
        files[f"gallery/{path.name}"] = path
        picture = SCENES / "pictures" / f"{path.stem}.png"
        if path.suffix == ".blend" and picture.is_file():
            files[f"gallery/pictures/{picture.name}"] = picture
    return dict(sorted((files | {"LICENSE": ROOT / "LICENSE"}).items()))


def build(folder: Path) -> Path:
    """Write the zip into a folder, named as Blender's builder names it, and return its path.

    The same files give the same bytes: no times are stored.
    """
    manifest = tomllib.loads((PACKAGE / "blender_manifest.toml").read_text(encoding="utf-8"))
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{manifest['id']}-{manifest['version']}.zip"
    begun = path.with_suffix(".part")
    try:
        with zipfile.ZipFile(begun, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, file in content().items():
                archive.writestr(zipfile.ZipInfo(name), file.read_bytes(), zipfile.ZIP_DEFLATED)
        begun.replace(path)
    finally:
        begun.unlink(missing_ok=True)
    return path


def main() -> int:
    """Build the extension and print where it is."""
    from arguments import Parser

    parser = Parser(prog="make_zip.py", description=__doc__, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "dist", help="default: dist/")
    path = build(parser.parse_args().folder)
    print(f"{path}, {path.stat().st_size / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
