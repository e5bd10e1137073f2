"""Casts into file systems of many sizes, each full at another moment: FOLDER OLD.blend NEW.blend SIZE... (in KB).

Run as root of a mount namespace of its own (unshare): each file system is a tmpfs that only this process sees. Prints a
JSON list, for each size how the cast of NEW over the files of OLD ended.
"""

import contextlib
import io
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path


def state(folder):
    """What is in a folder, hidden or not: names and bytes."""
    return {path.name: path.read_bytes() if path.is_file() else b"folder" for path in folder.iterdir()}


def tried(commands, folder, old, new, size):
    """Cast into a file system of that size that holds the old files."""
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "none", str(folder)], check=True)
    try:
        for path in old.iterdir():
            shutil.copy(path, folder)
        before, said = state(folder), io.StringIO()
        with contextlib.redirect_stderr(said):
            status = commands.main("cast", [str(new), "--output", str(folder)], "cast.py")
        after = state(folder)
        return {
            "size": size,
            "status": status,
            "said": said.getvalue(),
            "names": sorted(after),
            "same": sorted(name for name in before if after.get(name) == before[name]),
            "whole": b"IEND" in after["scene.png"][-12:],
            "exr": len(after["scene.exr"]),
            "report": json.loads(after["report.json"])["pixels"],
        }
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def main(folder, old, new, *sizes):
    """Try every size and print what came of it."""
    import camera_ray_caster
    from camera_ray_caster.blender.terminal import commands

    printed = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    camera_ray_caster.register()
    with contextlib.redirect_stdout(io.StringIO()):
        found = [tried(commands, Path(folder), Path(old), Path(new), int(size)) for size in sizes]
    print(json.dumps(found), file=printed, flush=True)
    os._exit(0)  # bpy 4.5 may hang in its own clean-up


if __name__ == "__main__":
    main(*sys.argv[1:])
