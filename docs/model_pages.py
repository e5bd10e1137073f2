"""Pages of the camera models, each made from the model's file: its docstring, formula, settings, and a picture."""

import inspect
import re
from functools import cache
from pathlib import Path

import numpy as np
from make import pages  # in scripts/, beside the table of models

import camera_ray_caster as crc
from camera_ray_caster.core.camera.camera import Camera
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.model import GROUPS, Model
from camera_ray_caster.core.exports import EXPORT_FORMATS, Shot
from camera_ray_caster.core.sets.png import png, srgb

PICTURES = Path("blend_scenes", "pictures")
"""The gallery, which has a picture of each model, named as the model's file but for those of SHOWN_BY."""
SHOWN_BY = {
    "PERSP": "pinhole", "ORTHO": "isometric", "STEREOGRAPHIC_PANORAMA": "little_planet", "SCANNER": "street_scanner",
}  # fmt: skip
SIZE = 480, 320
NEEDED = {
    "slit_1": "[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]",
    "slit_2": "[(0.0, 0.0, 2.0), (0.0, 1.0, 0.0)]",
    "path": "[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]",
    "ray_directions": 'crc.camera("FISHEYE_EQUIDISTANT", (64, 48)).rays().directions',
}
"""Settings that have no default, in Python: lines are a point and a direction, or the points of a path."""

INDEX = """\
# Camera models

{count} models. Each page has the formula, the settings with their units and ranges, and where the model ends. The
[table of all models](../../addon/camera_ray_caster/core/cameras/README.md) is one page to search in; it has
[the time of each pixel](../../addon/camera_ray_caster/core/cameras/README.md#the-time-of-each-pixel), too. A model of
your own is [25 lines](../tutorials/camera_of_your_own.md).
"""
ALL = "```{toctree}\n:hidden:\nAll in one table </addon/camera_ray_caster/core/cameras/README>\n```\n"
WRITERS = """
## Which format represents which model

With the models' defaults.

| format | represents |
|---|---|
"""
LESSON = "[Try it in the browser](../lesson/index.html#v=1&model={key}): drag a pixel, turn the settings.\n\n"
ANGLES = "Angles are given in degrees here, and in radians in Python.\n\n"
PAGE = """\
# {label}

{description}.

![What this camera sees]({picture})

{lesson}Key `{key}`; {rays}; [{file}](../../{path}). With its defaults, it is written by {writers}.

## In Python

```python
import camera_ray_caster as crc

camera = crc.camera("{key}", (640, 480){given})
rays = camera.rays()  # origins and directions, (480, 640, 3); valid, where there is a ray
```

## Formula

From the pixel (x, y), y up, to the ray, in the camera's axes u (right), v (up) and w (ahead); W and H are the frame's
width and height in pixels.

{steps}

## Settings

{units}{settings}

## What it assumes

{text}
"""


def write(root: Path, folder: Path) -> None:
    """Write a page for each model and the page that lists them into a folder, docs/cameras."""
    folder.mkdir(exist_ok=True)
    for model in MODELS:
        (folder / f"{name_of(model)}.md").write_text(page(model, root, folder), encoding="utf-8")
    (folder / "index.md").write_text(index(root, folder), encoding="utf-8")


def name_of(model: type[Model]) -> str:
    """Return the name of a model's page."""
    return model.key.lower()


def index(root: Path, folder: Path) -> str:
    """Return the page that lists the models by group, with their descriptions."""
    parts = [INDEX.format(count=len(MODELS))]
    for group in GROUPS:
        models = [model for model in MODELS if model.group == group]
        rows = "".join(
            f"| ![]({picture(one, root, folder)}) | [{one.label}]({name_of(one)}.md) | {one.description} |\n"
            for one in models
        )
        names = "\n".join(map(name_of, models))
        parts.append(f"## {group}\n\n| | | |\n|---|---|---|\n{rows}\n```{{toctree}}\n:hidden:\n{names}\n```\n")
    return "\n".join((*parts, ALL))


def page(model: type[Model], root: Path, folder: Path) -> str:
    """Return the page of a model."""
    file = Path(inspect.getfile(model)).resolve()
    return PAGE.format(
        label=model.label,
        description=model.description,
        picture=picture(model, root, folder),
        lesson=LESSON.format(key=model.key) if f'"key":"{model.key}"' in lesson_text(root) else "",
        key=model.key,
        rays="parallel rays" if model.parallel else "rays from one eye" if model.central else "rays from many eyes",
        writers=", ".join(f"`{one.key}`" for one in EXPORT_FORMATS if one.refusal(shot_of(model)) is None),
        file=file.name,
        path=file.relative_to(root).as_posix(),
        given=given(model),
        steps="\n".join(f"1. {step.words}:\n\n       {step.symbols}\n" for step in model.FORMULA),
        units=ANGLES if any(getattr(one, "unit", "") == "angle" for one in model.SETTINGS) else "",
        settings=pages.table(model.SETTINGS).strip() or "It has none.",
        text=as_markdown(inspect.getdoc(inspect.getmodule(model))),
    )


def plain_camera(model: type[Model]) -> Camera:
    """Return a camera with the model's defaults at the origin."""
    return eval(f'crc.camera("{model.key}", {SIZE}{given(model)})', {"crc": crc})


@cache
def lesson_text(root: Path) -> str:
    """Return the page of the lesson for browsers; "" if there is none."""
    path = root / "docs" / "lesson" / "index.html"
    return path.read_text(encoding="utf-8") if path.is_file() else ""


def given(model: type[Model]) -> str:
    """Return the settings without a default as a call of ``crc.camera`` has them."""
    return "".join(f", {one.name}={NEEDED[one.name]}" for one in model.SETTINGS if one.name in NEEDED)


def shot_of(model: type[Model]) -> Shot:
    """Return a camera with the model's defaults as an export takes it."""
    return Shot("camera", 1.0, plain_camera(model))


def writers() -> str:
    """Return the table of the models that each export format represents."""
    text = WRITERS
    for one in EXPORT_FORMATS:
        able = [model.label for model in MODELS if one.refusal(shot_of(model)) is None]
        text += f"| `{one.key}` | {'all' if len(able) == len(MODELS) else ', '.join(able)} |\n"
    return text


def as_markdown(text: str) -> str:
    """Return a module's docstring as Markdown: its parts, such as "Formula: ...", begin paragraphs with bold words."""
    parts = re.split(r"(``.+?``)", text, flags=re.DOTALL)
    plain = [re.sub(r"([*_<\[\]|^$])", r"\\\1", part) for part in parts[::2]]
    text = "".join(a + b for a, b in zip(plain, [*parts[1::2], ""], strict=True))
    return re.sub(r"^(Assumption|Formula|Singular|Refused|References?): ", r"\n**\1.** ", text, flags=re.MULTILINE)


def picture(model: type[Model], root: Path, folder: Path) -> str:
    """Return the path of a model's picture from its page; cast the picture if the gallery has none."""
    stems = SHOWN_BY.get(model.key), Path(inspect.getfile(model)).stem, name_of(model)
    found = [root / PICTURES / f"{stem}.png" for stem in stems if stem]
    shown = next((path for path in found if path.is_file()), None)
    if shown is None:
        shown = folder / f"{name_of(model)}.png"
        shown.write_bytes(png(room_seen_by(model)))
    return Path("../..", shown.relative_to(root)).as_posix()


def room_seen_by(model: type[Model]) -> np.ndarray:
    """Return the picture that a model with its defaults has of some balls on the ground, (rows, columns, 4), uint8."""
    place = np.array([(x, -0.5, z) for x in (-4.0, -1.3, 1.3, 4.0) for z in (-8.0, -4.5, 4.5, 8.0)])
    ground = crc.planes((0.0, -1.0, 0.0), [[1, 0], [0, 0], [0, 1]], infinite=True)
    shapes = crc.join(crc.spheres(place, 0.5, color=0.5 + place[:, [0, 2, 1]] / (10, 20, 2)), ground)
    images = crc.cast(plain_camera(model), shapes, passes=("combined", "shape_index"), shading="GRID", samples=4)
    color = np.concatenate((srgb(images["combined"][..., :3]), 255 * (images["shape_index"] >= 0)[..., None]), axis=-1)
    return color[::-1].astype(np.uint8)
