"""How the tests run a script, and what they run it on."""

import io
import os
import re
import signal
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def script(name, *arguments, folder=None):
    """Run a script to its end."""
    words = [sys.executable, str(ROOT / "scripts" / f"{name}.py"), *map(str, arguments)]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=300, env=os.environ)


def in_this_process(name, *arguments):
    """Run a command of the registered add-on to its end, without the start of another Blender; it must succeed."""
    from camera_ray_caster.blender.terminal import commands

    errors = io.StringIO()
    with redirect_stderr(errors), redirect_stdout(io.StringIO()):
        status = commands.main(name, list(map(str, arguments)), name)
    assert (status, complaints(errors.getvalue())) == (0, [])


def start(*words, action=signal.SIG_DFL, **options):
    """Start a Python with the signals as a shell in front of a user hands them over: one in the background may not."""
    hear = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True} | options
    words = [sys.executable, *map(str, words)]
    return subprocess.Popen(words, preexec_fn=lambda: [signal.signal(number, action) for number in hear], **streams)


def complaints(stderr):
    """The lines on standard error that do not say how far a run is: on a busy machine those come, too."""
    return [line for line in stderr.splitlines() if not re.search(r"\d of \d+(, [\d:]+ (left|so far))?$", line)]


def small(bpy, path, **settings):
    """Save a small scene, opened in place of the one before: a sphere 5 below the camera "Top", which moves from x = 0
    at frame 1 to x = 1 at frame 2.
    """
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1)
    bpy.context.object.pass_index = 7
    for name in ("Side", "Top"):
        bpy.ops.object.camera_add(location=(0, 0, 5))
        bpy.context.object.name = name
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    for frame in (1, 2):
        scene.camera.location.x = frame - 1
        scene.camera.keyframe_insert("location", frame=frame)
    bpy.data.objects["Side"].location.y = 0.5
    scene.render.resolution_x, scene.render.resolution_y = 32, 24
    for name, value in settings.items():
        setattr(scene.render, name, value)
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def left(folder):
    """What is in a folder, hidden or not."""
    return sorted(path.name for path in folder.iterdir())


def refused(done):
    """The one line that a refusal is."""
    assert done.returncode == 2, done.stderr
    assert done.stdout == ""
    (line,) = done.stderr.splitlines()
    return line
