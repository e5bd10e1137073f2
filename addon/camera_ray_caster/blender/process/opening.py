"""Opening a .blend without running its Python, unless the user allows it."""

from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from ...core.records import InputError


@dataclass(frozen=True)
class StyleModule:
    """A Freestyle style module of the open file, and the script that was taken from it."""

    scene: Any
    layer: str
    index: int
    script: Any

    @property
    def settings(self):
        """Freestyle's settings of its view layer."""
        return self.scene.view_layers[self.layer].freestyle_settings

    def has(self, script) -> None:
        """Set the module's script, or None."""
        self.settings.modules[self.index].script = script

    @property
    def is_on(self) -> bool:
        """Whether Blender would run it in the current evaluation."""
        on = self.scene.render.use_freestyle and self.scene.view_layers[self.layer].use_freestyle
        return on and self.settings.mode == "SCRIPT" and self.settings.modules[self.index].use


_withheld: list[StyleModule] = []


def open_file(path: Path, enable_autoexec: bool = False) -> None:
    """Open a .blend; ``enable_autoexec`` lets its scripts run: drivers in Python, texts that register, style modules.

    Raises InputError if there is no such file or this Blender cannot open it.
    """
    try:
        is_file = path.is_file()
    except (OSError, ValueError):  # no permission; a null character
        is_file = False
    if not is_file:
        raise InputError(f"there is no file {str(path)!r}: give the path of a .blend file")
    with refused_as_input(f"{str(path)!r} is not a .blend file that this Blender can open: "):
        bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), use_scripts=enable_autoexec)
    _withheld.clear()
    if not enable_autoexec:
        withhold_style_modules()


@contextmanager
def refused_as_input(words: str = "") -> Iterator[None]:
    """Raise InputError, with these words and Blender's, if an operator fails inside the context. What is printed on
    standard output, such as Python's copy of the error, is dropped.
    """
    try:
        with redirect_stdout(None):
            yield
    except RuntimeError as error:
        raise InputError(words + reported(error)) from error


def reported(error: Exception) -> str:
    """Return the first line of an operator's error, without the label "Error: "."""
    return str(error).strip().splitlines()[0].removeprefix("Error: ")


def not_run() -> tuple[str, ...]:
    """Return a warning, in a tuple, if Blender did not run some scripts of the open file; else ()."""
    modules = [f"Freestyle style module {module.script.name!r}" for module in _withheld if module.is_on]
    if not (bpy.app.autoexec_fail or modules):
        return ()
    first = " ".join((bpy.app.autoexec_fail_message or modules[0]).splitlines())
    return (
        f"scripts in the file were not run, so the picture may differ: --enable-autoexec runs the scripts ({first})",
    )


def withhold_style_modules() -> None:
    """Remove the scripts of Freestyle's style modules: Blender 5.0 runs them even with ``use_scripts=False``.

    The modules cannot just be switched off: keys and drivers would switch them on. None can set a script.
    """
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            for index, module in enumerate(layer.freestyle_settings.modules):
                if module.script is not None:
                    _withheld.append(StyleModule(scene, layer.name, index, module.script))
                    _withheld[-1].has(None)


@contextmanager
def scripts_given_back() -> Iterator[None]:
    """Restore the scripts of the style modules inside the context, so that a file is saved with them."""
    for module in _withheld:
        module.has(module.script)
    try:
        yield
    finally:
        for module in _withheld:
            module.has(None)


def give_back() -> None:
    """Restore the scripts of the style modules: the file that is open may stay open in Blender."""
    with scripts_given_back():
        _withheld.clear()
