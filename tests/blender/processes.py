"""How tests run another Blender of the kind that they run in."""

import os
import subprocess
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[2]
SOURCE = ROOT / "addon" / "camera_ray_caster"


def run(*command, folder=None, **environment):
    """Run a program to its end and return what it printed; a failure shows everything that it said."""
    done = subprocess.run(
        command,
        cwd=folder,
        env=os.environ | environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


def blender_command(script):
    """The words that run a script in another Blender of this kind: pip's bpy has no program of its own."""
    if not bpy.app.binary_path:
        return [sys.executable, "-P", script, "--"]  # -P: modules beside the script are not to stand before Blender's
    options = ["--background", "--factory-startup", "--python-exit-code", "1"]
    return [bpy.app.binary_path, *options, "--python", script, "--"]


def script_command(name, scene):
    """The words that run a script of the project on a scene: in pip's bpy, or in another Blender of this kind."""
    script = str(ROOT / "scripts" / name)
    if not bpy.app.binary_path:
        return [sys.executable, script, str(scene)]
    return [bpy.app.binary_path, "--background", "--factory-startup", str(scene), "--python", script, "--"]


def extension_tool(*arguments):
    """Blender's own program for extensions: it lies beside the add-on that manages them, in bpy and in Blender."""
    (folder,) = bpy.utils.script_paths(subdir="addons_core/bl_pkg/cli")
    return run(sys.executable, os.path.join(folder, "blender_ext.py"), *map(str, arguments))
