"""Casts into file systems of many sizes, each full at another moment: FOLDER OLD.blend NEW.blend SIZE... (in KB).

Run as root of a mount namespace of its own (unshare): each file system is a tmpfs that only this process sees. Prints a
JSON list, for each size how the cast of NEW over the files of OLD ended. With COMMANDS in place of the sizes, how other
commands ended on a small disk.
"""

import contextlib
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def state(folder):
    """What is in a folder, hidden or not: names and bytes."""
    return {path.name: path.read_bytes() if path.is_file() else b"folder" for path in folder.iterdir()}


@contextlib.contextmanager
def mounted(folder, size):
    """A file system of that size."""
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}k", "none", str(folder)], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def said_by(commands, name, *words):
    """Return the status of a command and what is on standard error, by C code, too."""
    kept = os.dup(2)
    with tempfile.TemporaryFile("w+") as output, contextlib.redirect_stderr(output):
        os.dup2(output.fileno(), 2)
        try:
            status = commands.main(name, list(map(str, words)), f"{name}.py")
        finally:
            os.dup2(kept, 2)
            os.close(kept)
        output.flush()
        output.seek(0)
        return status, output.read()


def of_commands(commands, folder, plain, compressed):
    """What other commands say on a disk that takes next to nothing, and what they leave there."""
    out = "--output", folder
    for name, *words in (
        ("to_cycles", plain, "--output", folder / "copy.blend"),
        ("to_cycles", compressed, "--output", folder / "copy.blend"),
        *(("export", plain, "--format", key, *out) for key in ("stmap", "npz", "json", "colmap")),
        ("cast", plain, "--format", "npz", *out),
        ("dataset", plain, "--frames", "1:1", *out),
    ):
        with mounted(folder, 4 if name == "export" else 16):
            status, output = said_by(commands, name, *words)
            yield {"command": name, "status": status, "said": output, "left": sorted(state(folder))}


def tried(commands, folder, old, new, size):
    """Cast into a file system of that size that holds the old files."""
    with mounted(folder, size):
        for path in old.iterdir():
            shutil.copy(path, folder)
        before = state(folder)
        status, output = said_by(commands, "cast", new, "--output", folder)
        after = state(folder)
        return {
            "size": size,
            "status": status,
            "said": output,
            "names": sorted(after),
            "same": sorted(name for name in before if after.get(name) == before[name]),
            "whole": b"IEND" in after["scene.png"][-12:],
            "exr": len(after["scene.exr"]),
            "report": json.loads(after["report.json"])["pixels"],
        }


def main(folder, old, new, *sizes):
    """Try every size and print what came of it."""
    import camera_ray_caster
    from camera_ray_caster.blender.terminal import commands

    printed = os.fdopen(os.dup(1), "w")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    camera_ray_caster.register()
    with contextlib.redirect_stdout(io.StringIO()):
        if sizes == ("COMMANDS",):
            outcomes = list(of_commands(commands, Path(folder), old, new))
        else:
            outcomes = [tried(commands, Path(folder), Path(old), Path(new), int(size)) for size in sizes]
    print(json.dumps(outcomes), file=printed, flush=True)
    os._exit(0)  # bpy 4.5 may hang in its own clean-up


if __name__ == "__main__":
    main(*sys.argv[1:])
