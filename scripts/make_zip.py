"""Build the extension: the add-on, its license, and the gallery with a picture of each scene.

    python scripts/make_zip.py            into dist/
    python scripts/make_zip.py FOLDER

Needs pip's bpy, which contains Blender's extension builder.
"""

from __future__ import annotations

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import shutil
import subprocess
import sys
import tempfile
from argparse import RawDescriptionHelpFormatter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SCENES = ROOT / "blend_scenes"


def stage(folder: Path) -> Path:
    """Copy the content of the extension into a new folder, and return the folder."""
    shutil.copytree(ROOT / "addon" / "camera_ray_caster", folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "LICENSE", folder)
    pictures = folder / "gallery" / "pictures"
    pictures.mkdir(parents=True)
    for table in SCENES.glob("*.npz"):
        shutil.copy(table, pictures.parent)
    for scene in SCENES.glob("*.blend"):
        shutil.copy(scene, pictures.parent)
        picture = SCENES / "pictures" / f"{scene.stem}.png"
        if picture.is_file():
            shutil.copy(picture, pictures)
    return folder


def main() -> int:
    """Build the extension and return the exit status of Blender's builder."""
    import bpy
    from arguments import Parser

    parser = Parser(prog="make_zip.py", description=__doc__, formatter_class=RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "dist", help="default: dist/")
    output = parser.parse_args().folder
    output.mkdir(parents=True, exist_ok=True)
    (tools,) = bpy.utils.script_paths(subdir="addons_core/bl_pkg/cli")
    with tempfile.TemporaryDirectory() as folder:
        words = ["build", "--source-dir", stage(Path(folder) / "extension"), "--output-dir", output]
        return subprocess.run([sys.executable, Path(tools) / "blender_ext.py", *words], check=False).returncode


if __name__ == "__main__":
    sys.exit(ends.run(__file__, main))
