"""The Python of the README, as a reader runs it: block after block, in Blender's default scene. Run by a Blender.

Arguments: the README, and the folder of the package to import, or the zip of the extension to install and to use.
"""

import re
import sys
from pathlib import Path

import bpy

INSTALLED = "bl_ext.user_default.camera_ray_caster"
IMPORT = re.compile(r"^(\s*(?:import|from) )camera_ray_caster\b", re.MULTILINE)


def blocks(readme):
    """The blocks, each with the lines before it, so that an error names the README's own line."""
    text = Path(readme).read_text(encoding="utf-8")
    for block in re.finditer(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        yield "\n" * text.count("\n", 0, block.start(1)) + block[1]


def main(readme, package):
    """Run the blocks that are for this way of having the package."""
    is_installed = package.endswith(".zip")
    if is_installed:
        bpy.ops.extensions.package_install_files(filepath=package, repo="user_default", enable_on_install=True)
    else:
        sys.path.insert(0, package)
    names = {"__name__": "__main__"}
    count = 0
    for block in blocks(readme):
        if is_installed or INSTALLED.rpartition(".")[0] not in block:
            source = IMPORT.sub(rf"\g<1>{INSTALLED}", block) if is_installed else block
            exec(compile(source, readme, "exec"), names)
            count += 1
    modules = {name for name in sys.modules if name.split(".")[0] == "camera_ray_caster"}
    assert bool(modules) != is_installed, modules
    assert hasattr(bpy.types.Scene, "camera_ray_caster") == is_installed
    print(f"blocks run: {count}")


if __name__ == "__main__":
    main(*sys.argv[sys.argv.index("--") + 1 :])
