"""The lesson as a page: one HTML file, which needs no server, no other file and no other host.

It holds the programs of all models and the files of ``page_files``.
"""

import json
import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from ..camera.asked_size import within
from ..camera.camera import Camera
from ..cameras import MODELS
from ..cameras.model import GROUPS, Model
from ..cameras.parts.parameters import parameters_of
from ..cameras.real_lens import RealLens
from ..library.cameras import camera
from ..records import InputError, Shapes
from ..shaders.glsl import GlslWriter
from ..shaders.javascript import RUNTIME
from .camera_program import Program, program_of
from .figures import FIGURES
from .page_scene import scene_data
from .room import SCENE
from .split import functions, glsl

SIZE = 640, 360
"""Width and height in pixels of the page's own cameras; of those with a shape of their own, the largest."""

SIZES = {"SCANNER": (512, 64)}
"""Frames of models whose rows are few."""

LINES = {
    "slit_1": ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
    "slit_2": ((0.0, -1.0, 0.5), (0.0, 1.0, 0.5)),
    "path": ((-2.0, 0.0, 0.0), (2.0, 0.0, 0.0)),
}
"""The objects of the page's own cameras, in their frames."""

ACROSS, UP = (side.round(2) for side in np.meshgrid(np.linspace(-0.8, 0.8, 5), np.linspace(-0.45, 0.45, 4)))
SQUARE = (ACROSS**2 + UP**2).round(2)
TABLES_OF = {
    "RAY_TABLE": {
        "ray_directions": np.stack((ACROSS + UP / 10, UP, SQUARE / 4 - 1), axis=-1).round(2),
        "ray_interpolation": "LINEAR",  # which takes half the text
    },
}
"""The tables of the page's own cameras: the rays of a lens that was measured at five times four places."""

HELD = {
    "RAY_TABLE": ("ray_axes", "ray_interpolation", "ray_block_columns", "ray_block_rows", "ray_slide"),
    "REAL_LENS": (
        "lens_focus", "focus_distance", "aperture_fstop", "lens_state", "lens_wavelength", "lens_vignetting",
        "lens_falloff", "lens_color", "tau_x", "tau_y",
    ),
}  # fmt: skip
"""Settings that are no knobs: each of their variants holds the table, or the traced lens, again."""

FILES = Path(__file__).with_name("page_files")
SCRIPTS = "formula", "mathml", "scene", "picture", "space", "state", "own", "glass", "main"
TABLES = {"prepare": "PREPARE", "rays": "RAYS", "values": "VALUES"}
"""Names of the lists of functions, by the functions that ``functions`` gives."""


def lesson_page(
    camera: Camera | None = None, pixel: tuple[int, int] | None = None, shapes: Shapes | None = None
) -> str:
    """Return the text of the page.

    camera: a camera with which the page begins, with its own frame, settings and lines; default the page's pinhole.
    shapes: the scene in which that camera stands: see ``page_scene``; default the page's room.
    pixel: column and row, from the bottom left, of that camera's pixel; default one of the page's.

    Raises NotRecordable for a camera whose model cannot be recorded.
    """
    tables = _Tables()
    models = [tables.entry(program) for program in own_programs()]
    key = models[0]["key"]
    if camera is not None:
        mine = tables.entry(program_of(camera))
        key = f"THIS_{mine['key']}"
        models.insert(0, mine | {"key": key, "label": f"This camera ({mine['label']})", "group": "In Blender"})
    scene = SCENE if camera is None or shapes is None else scene_data(camera, shapes)
    pixel_text = "" if pixel is None else f", {{x: {pixel[0] + 0.5!r}, y: {pixel[1] + 0.5!r}}}"
    parts = [
        RUNTIME,
        f"const HELPERS = {_data(''.join(GlslWriter.HELPERS.values()))};",
        f"const SCENE = {_data(scene)}, FIGURES = {_data(FIGURES)};",
        *("\n".join((f"const {name} = [", ",\n".join(tables.texts[name]), "];")) for name in TABLES.values()),
        f"const GLSL = {_data(tables.texts['GLSL'])};",
        f"const MODELS = {_data(models)};",
        *((FILES / f"{name}.js").read_text(encoding="utf-8") for name in SCRIPTS[:-1]),
        f"const START = Object.assign(freshState(MODELS.find((one) => one.key === {_data(key)})){pixel_text});",
        (FILES / "main.js").read_text(encoding="utf-8"),
    ]
    page = (FILES / "index.html").read_text(encoding="utf-8")
    style = (FILES / "page.css").read_text(encoding="utf-8")
    return page.replace("/*STYLE*/", style.rstrip()).replace("/*SCRIPT*/", "\n".join(parts).rstrip())


@cache
def own_programs() -> tuple[Program, ...]:
    """Return the programs of the package's models, by groups."""
    models = [model for model in page_models() if model.__module__.startswith(Model.__module__.rpartition(".")[0])]
    return tuple(own_program(model) for group in GROUPS for model in models if model.group == group)


def own_program(model: type[Model]) -> Program:
    """Return the program of a model as the page begins with it."""
    return program_of(example(model), HELD.get(model.key, ()))


def page_models() -> list[type[Model]]:
    """Return the models that the page has: all but those that need a file or an object that it does not have."""
    models = []
    for model in MODELS:
        try:
            example(model)
        except InputError:
            continue
        models.append(model)
    return models


def example(model: type[Model], **settings: Any) -> Camera:
    """Return the camera of a model with which the page begins, whose frame stretches nothing; ``settings`` are further
    ones.
    """
    lines = {setting.name: LINES[setting.name] for setting in model.SETTINGS if setting.name in LINES}

    def made(size: tuple[int, int]) -> Camera:
        return camera(model.key, size, **lines, **TABLES_OF.get(model.key, {}), **settings)

    if model.key in SIZES:
        return made(SIZES[model.key])
    shape = made(SIZE).model.shape
    return made(SIZE if shape is None else within(*SIZE, shape))


class _Tables:
    """Lists of functions, each of which is written once."""

    def __init__(self):
        self.texts: dict[str, list[str]] = {name: [] for name in (*TABLES.values(), "GLSL")}

    def place(self, name: str, text: str) -> int:
        """Return the place of a text in a list, to which it is added if it is new, without the spaces of no use."""
        text = packed(text)
        if text not in self.texts[name]:
            self.texts[name].append(text)
        return self.texts[name].index(text)

    def entry(self, program: Program) -> dict[str, Any]:
        """Return a program as the page has it."""
        model = program.lens
        variants = []
        for variant in program.variants:
            made = functions(variant.parts)
            places = {name: self.place(table, made[name]) for name, table in TABLES.items()}
            places["glsl"] = self.place("GLSL", glsl(variant.parts)[0])
            variants.append({"choices": variant.choices, "names": variant.names, **places})
        return {
            "key": model.key, "label": model.label, "group": model.group, "description": model.description,
            "size": model.size, "central": model.central, "planar": model.planar,
            "knobs": [vars(knob) for knob in program.knobs], "choices": program.choices,
            "options": program.options, "labels": {setting.name: setting.label for setting in model.SETTINGS},
            "fixed": [setting.label for setting in program.fixed],
            "constants": parameters_of(program.fixed, program.record),
            **({"glass": glass_of(model)} if isinstance(model, RealLens) else {}),
            "steps": [step._asdict() for step in model.steps], "variants": variants,
        }  # fmt: skip


def glass_of(model: RealLens) -> dict[str, Any]:
    """Return what the page's section of a lens is drawn and traced from, in mm of its file."""
    optics, window = model.optics, model.window
    rims = [surface.rim if surface.rim < np.inf else None for surface in optics.surfaces]
    surfaces = [vars(surface) | {"rim": rim} for surface, rim in zip(optics.surfaces, rims, strict=True)]
    return {
        "surfaces": surfaces,
        "stop": optics.stop, "film": float(model.film), "radius": float(model.radius), "wide": max(filter(None, rims)),
        "pupil": float(model.pupil), "unit": float(model.unit), "exit": optics.exit_pupil[0],
        "magnification": optics.entrance_pupil[1], "focal": optics.focal_length,
        "matrix": optics.whole.tolist(), "center": [float(window.center_x), float(window.center_y)],
        "pitch": [float(window.pitch_x), float(window.pitch_y)],
    }  # fmt: skip


def packed(text: str) -> str:
    """Return JavaScript or GLSL without the spaces and line ends that it does not need, unlike those of "a - -b": a
    seventh of the page.
    """
    text = re.sub(r" ?([=*/<>?:,;{}()\[\]+]|&&|\|\|) ?", r"\1", re.sub(r"\s*\n\s*", "", text))
    return re.sub(r" - (?!-)", "-", text)


def _data(value: Any) -> str:
    """Return JSON that may stand in a script of a page."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
