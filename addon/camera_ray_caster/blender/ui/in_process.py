"""Long work by a command of the terminal in a process of its own: the window shows its progress and can stop it.

The process reads the file as it is saved, or a copy if it has unsaved changes. The open scene is not changed.
"""

import os
import re
import sys
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from subprocess import DEVNULL, Popen
from tempfile import TemporaryDirectory

import bpy

from ...core.file_set import clear_up
from ...core.records import InputError
from ..properties.setting_labels import in_labels
from ..read.unique import unique_name
from .needs import Action
from .other_engine import show_in_sidebars, show_later

INTERVAL = 0.2
"""Seconds between two looks at the process."""
SHOWN = 10.0
"""Seconds that the status bar shows the result."""
BUSY = "Wait until the running work has ended, or stop it"
STOPPED = 130
"""Exit status of commands that were stopped."""
DISAGREES = "A camera's rays differ from a reference: see the reports"
PART = re.compile(r"(\d+) of (\d+)")
"""Progress in a line of a command."""
PROG, LOG = re.compile(r"^camera[-_]ray[-_]caster \w+: "), re.compile(r"\d\d:\d\d\.\d{3} ")
"""How a line of a command begins, and a line of Blender's log."""
PACKAGE = __name__.partition(".blender.")[0]
FOLDER = Path(__file__).parents[2]
"""The add-on's folder."""


class Work:
    """A running command: its process, and its output in a temporary folder."""

    def __init__(self, command: str, words: Sequence[str], folder: Path):
        self.command, self.folder, self.is_stopped = command, folder, False
        self.temporary = TemporaryDirectory(prefix="camera_ray_caster_", ignore_cleanup_errors=True)
        temporary, (program, environment) = Path(self.temporary.name), program_of()
        self.printed, self.errors = temporary / "output.txt", temporary / "errors.txt"
        scene = unique_name(bpy.context.scene, bpy.data.scenes)
        arguments = [str(saved_file(temporary)), f"--scene={scene}", f"--output={folder}", "--progress", *words]
        arguments += ["--enable-autoexec"] * (not bpy.app.autoexec_fail)
        with self.printed.open("w") as output, self.errors.open("w") as errors:
            self.process = Popen(
                [*program, command, *arguments], stdin=DEVNULL, stdout=output, stderr=errors,
                env=os.environ | environment,
            )  # fmt: skip

    @property
    def progress(self) -> str:
        """How much is done and what is left, or what the command has said last."""
        line = next(reversed(_lines(self.errors)), "Starting")
        match = PART.search(line)
        return line[match.start() :] if match else line

    @property
    def fraction(self) -> float:
        """The part that is done, 0 to 1."""
        parts = PART.findall("\n".join(_lines(self.errors)))
        return int(parts[-1][0]) / max(int(parts[-1][1]), 1) if parts else 0.0

    def stop(self) -> None:
        """Ask the process to end after the current tile or file; the second time, end it at once."""
        (self.process.kill if self.is_stopped else self.process.terminate)()
        self.is_stopped = True

    def result(self) -> str:
        """Return how the process has ended, in lines."""
        status, printed, errors = self.process.wait(), _lines(self.printed), _lines(self.errors)
        if self.is_stopped or status == STOPPED:
            if self.folder.is_dir():
                clear_up(self.folder)  # a process that was killed could not do it
            parts = PART.findall("\n".join(errors)) if self.command == "cast" else ()
            return f"Stopped: {' of '.join(parts[-1])} pictures are in {self.folder}" if parts else "Stopped"
        if status in (0, 1) and printed:
            if self.command == "cast":  # before this line stands the report of a single picture
                printed = printed[next((k for k, line in enumerate(printed) if line.startswith("Wrote")), 0) :]
            printed.sort(key=lambda line: not line.startswith("Wrote"))
            return "\n".join([DISAGREES] * status + printed)
        return in_labels(errors[-1]) if errors else f"Blender ended with status {status}"


def program_of() -> tuple[list[str], dict[str, str]]:
    """Return the command line that runs a command of this add-on, and its environment variables."""
    environment = {"PYTHONPATH": str(FOLDER.parent)}
    if not bpy.app.binary_path:  # pip's bpy
        return [sys.executable, "-m", FOLDER.name], environment
    run = ["--addons", PACKAGE, "--command", "camera_ray_caster"]
    if PACKAGE.startswith("bl_ext."):
        return [bpy.app.binary_path, *run], {}
    return [bpy.app.binary_path, "--python-use-system-env", *run], environment


def saved_file(folder: Path) -> Path:
    """Return the path of the open file, or of a copy with its unsaved changes in a folder."""
    path = Path(bpy.data.filepath)
    if bpy.data.filepath and not bpy.data.is_dirty:
        return path
    copy = folder / f"{path.stem or 'untitled'}.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(copy), copy=True)
    return copy


def _lines(path: Path) -> list[str]:
    """Return the lines of a file of what a command printed, without its name and without Blender's log."""
    lines = (PROG.sub("", line).strip() for line in path.read_text(encoding="utf-8", errors="replace").splitlines())
    return [line for line in lines if line and not LOG.match(line)]


_running: list[Work] = []
_ended: list[str] = []
"""How the latest work ended."""


def running() -> Work | None:
    """Return the work that is being done, or None."""
    return _running[0] if _running else None


def latest() -> str:
    """Return how the latest work ended, in lines; "" before the first."""
    return _ended[-1] if _ended else ""


def begin(command: str, words: Sequence[str], folder: Path) -> None:
    """Begin a command that writes into a folder; a timer looks after it, also when another file is opened.

    Raises InputError if the temporary folder, the copy of the file or the process cannot be made.
    """
    try:
        _running.append(Work(command, words, folder))
    except (OSError, RuntimeError) as error:
        raise InputError(f"the command cannot be started: {error}") from error
    bpy.app.timers.register(tick, first_interval=INTERVAL, persistent=True)


def tick() -> float | None:
    """Show the progress, or how the work has ended; called by a timer."""
    work = running()
    if work is None:
        return None
    if work.process.poll() is None:
        show_in_sidebars(work.progress)
        return INTERVAL
    try:
        _ended[:] = [work.result()]
    except InputError as error:
        _ended[:] = [in_labels(str(error))]
    forget()
    show_in_sidebars(latest().partition("\n")[0])
    show_later(None, SHOWN)
    return None


def forget() -> None:
    """End the process at once if it runs: the add-on is disabled, or Blender ends."""
    while _running:
        work = _running.pop()
        work.process.kill()
        work.process.wait()
        with suppress(InputError):
            clear_up(work.folder)
        work.temporary.cleanup()


@bpy.app.handlers.persistent
def forget_result(*_) -> None:
    """Forget how the latest work ended, since another file is opened."""
    _ended.clear()


class StopAll(Action, bpy.types.Operator):
    """Stop after the current tile, frame or file; pictures that are finished stay. Press again to end it at once"""

    bl_label = "Stop"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        for work in _running:
            work.stop()


CLASSES = (StopAll,)


def register(undo) -> None:
    undo.callback(_ended.clear)
    undo.add_handlers(forget_result, "load_post")
    undo.callback(forget)
