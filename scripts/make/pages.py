"""The pages of camera models and of files, made from what models, programs and formats declare."""

from __future__ import annotations

import inspect
import math
import re
from pathlib import Path

from camera_ray_caster.core.camera import pixel_time
from camera_ray_caster.core.cameras import MODELS
from camera_ray_caster.core.cameras.model import GROUPS, Model
from camera_ray_caster.core.cameras.parts import port_settings
from camera_ray_caster.core.cameras.parts.settings import OWN, Choice, Coefficients, Setting
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.programs import PROGRAMS
from camera_ray_caster.core.programs.parts.program import ProgramFiles
from camera_ray_caster.core.sets import SET_FORMATS

HEAD = """\
# Camera models

Made by `python scripts/make_docs.py` from what each model declares in its file. The camera's axes u, v and w are right,
up and ahead; W and H are the frame's width and height in pixels, (x, y) the pixel coordinates, y up. A star marks
Blender's own settings; of a calibrated lens they count only if Lengths In (`calibration_unit`) is `MILLIMETERS`. Angles
are stored in radians and given in degrees here.
"""

TIMES = """
## The time of each pixel

With any model each pixel may have its own time: `time_mode` is one of these.
"""

PORTS = """
## Behind glass

Any model whose rays leave one eye may be behind glass: `port` is one of these. Distances are from the outer face.
"""

FILES = """\
# Files of cameras

Made by `python scripts/make_docs.py` from [their files](__init__.py).

## Calibrations

Files are read by Load Calibration, next to the camera's model, by `--calibration FILE` and by `crc.load_calibration`.
They are recognized by their content, whatever their names are.

* A file that does not state the size of its pictures is taken to be for the size of the frame; a message says so.
  `crc.load_calibration` needs `size=` then.
* If an OpenCV file has four coefficients and no model name, choose the model with `--model`.
* A file may be compressed by gzip, and hold several cameras, by name, in a list or in lines of JSON. Camera in File
  (`--calibration-camera`) chooses one.

## Cameras with poses

File > Import > Cameras, and `--rig FILE ...` of `cast.py`, `dataset.py` and `export.py`, add the cameras of files
with their lenses, names and poses; `--rig` does not change the .blend. The cameras are children of one empty, which
is the coordinate system of the file:

* **The world**, with a keyframe for each image: COLMAP (a folder, images.txt or images.bin), nerfstudio, Metashape
  (with the scale of the chunk; of a georeferenced project east, north and up about the middle of its cameras),
  Meshroom, Polycam (y up), BOP (millimeters become meters) and this add-on. Of HOT3D the world, or the headset.
* **The body of a rig**: Kalibr (the IMU, or the first camera), EuRoC, OKVIS, maplab, Basalt and Project Aria; camera
  00 of KITTI. A trajectory of TUM, EuRoC, KITTI or ARKitScenes moves the empty.
* **Folders** of Polycam, of a clip of HOT3D or of ARKitScenes (its .pincam files and .traj) have a keyframe for each
  file.

The frame of a pose is that in the picture's name, CAMERA_FRAME or FRAME_CAMERA, or the number of the image; the first
of several times, and KITTI's first pose, are frame 1. Images of the same name in several folders are of cameras named
after these. Words behind the frames that are those of single pictures, such as titles, name no cameras. If other images
with the same name use different lens models or the same frame, they are split into NAME-1, NAME-2, ... If each frame
uses exactly one camera, timeline markers switch between them.

* `--rig FILE` without `--frames` casts and exports each camera in the frames of its own poses.
* `--rig-parent NAME` makes the empty a child of an object. If that is a camera, the coordinates of the file are those
  of its view: x right, y down, z ahead.
* Lenses stay linked to the file, with all digits; a lens that changes has keyframes. Blender rounds positions by up
  to 6e-8 of their size, and rotations by 1e-7 rad.
* The custom property `resolution` of a camera object is the size of its pictures, in all commands without
  `--resolution`.

## Programs

Exports are written by `scripts/export.py --format`, File > Export and `crc.export`. The last column says what the
files do not contain, and what is refused in one line.

| program | files | reads | writes | not contained, or refused |
|---|---|---|---|---|
"""

SETS = """
## Finished data sets

`export.py FOLDER --format KEY --output OUT` exports the set that `cast.py` or `dataset.py` made in a folder, with its
sizes and frames: its cameras in each of the formats above, or the whole set in one of the formats below.

* They read the passes of NPZ and EXR files: depth or distance, and combined, shape_index or normal if the format has
  them.
* They read the annotations of `--annotations`: of each object its visible and its whole (amodal) mask, its category,
  and the pose and size of a box in its own axes.
* `--models FILE.blend`, the file of the set, adds the models of `bop-scenes`: a PLY in millimeters for each category,
  as the viewport evaluates its last object at its last frame, with normals and the colors of materials. Diameters are
  then those of the models, not of the boxes. Symmetries are the rotations about the axes of a model, and those of a
  cube, that map its vertices, normals and colors onto themselves. Objects that were cast as exact spheres or planes are
  cast anew as the meshes that their models are: depths, masks, boxes and poses agree with the models, pictures are as
  they were. With Exact Shapes off, a set has meshes from the beginning.
* `--cameras NAME ...` and `--frames A:B` choose pictures of the set: cameras of other lenses than a format has are left
  out so. The views of a stereo scene are two cameras, such as Cam_L and Cam_R.
* `--validation 0.2` splits a set: of the frames, that part, evenly spaced, is for validation, with all its cameras.
* With a render border, pictures, depths, normals and masks have the full frame, empty outside of the border, and so do
  lenses; with Crop to Border they have the border alone.
* Lengths are millimeters in `bop-scenes` and `depth16`, meters in Kalibr, TUM, KITTI and EuRoC, by the scene's Unit
  Scale, and Blender units in all others; depths of `nerfstudio-scene` are thousandths of them.

| key | |
|---|---|
"""

CONTENTS = "\n| group | models |\n|---|---|\n"
COLUMNS = "| setting | unit | range | default | label: meaning |\n|---|---|---|---|---|\n"


def models() -> str:
    """Return the page of models: a section for each group of models, and a section for pixel times."""
    groups = {group: those for group in GROUPS if (those := [model for model in MODELS if model.group == group])}
    sections = [f"\n## {group}\n" + "".join(map(section, those)) for group, those in groups.items()]
    labels = {group: [model.label for model in those] for group, those in groups.items()}
    labels["The time of each pixel"] = [item.label for item in pixel_time.MODE.items]
    labels["Behind glass"] = [item.label for item in port_settings.PORT.items[1:]]
    contents = "".join(f"| {group} | {', '.join(map(link, those))} |\n" for group, those in labels.items())
    modes, ports = choices(pixel_time.MODE, pixel_time.SETTINGS), choices(port_settings.PORT, port_settings.SETTINGS)
    return "".join((HEAD, CONTENTS, contents, *sections, TIMES, *modes, PORTS, *ports))


def choices(choice: Choice, settings: dict[str, tuple[Setting, ...]]) -> list[str]:
    """Return a section for each item of a choice, with the settings that it reads."""
    return [
        f"\n### {item.label}\n\n`{item.key}`: {item.text}.\n" + table(settings[item.key])
        for item in choice.items
        if item.key in settings and (settings[item.key] or choice is pixel_time.MODE)
    ]


def link(title: str) -> str:
    """Return a link to the section of a title, as viewers of Markdown name them."""
    name = re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")
    return f"[{title}](#{name})"


def files() -> str:
    """Return the page of files: a row for each program."""
    sets = "".join(f"| `{key}` | {set_format.description} |\n" for key, set_format in SET_FORMATS.items())
    return FILES + "".join(map(program_row, PROGRAMS)) + SETS + sets


def program_row(program: ProgramFiles) -> str:
    """Return a program as a row of the table; it writes what its export's table of models says."""
    keys = {each.key: each for each in EXPORT_FORMATS}
    export = keys.get(program.export.key) if program.export else None
    writes = "" if export is None else f"`{export.key}`: {export.description}".replace("<", "\\<")
    return f"| {program.name} | {program.files} | {program.reads} | {writes} | {program.lost} |\n"


def section(model: type[Model]) -> str:
    """Return the section of a model: its description, assumption, settings and formula."""
    steps = "\n".join(f"* {step.words}: `{step.symbols}`" for step in model.FORMULA)
    file = Path(inspect.getfile(model)).name
    return f"""
### {model.label}

`{model.key}` in [{file}]({file}): {model.description}.{assumption(model)}
{table(model.SETTINGS)}
{steps}
"""


def assumption(model: type[Model]) -> str:
    """Return the assumption stated in the docstring of the model's file, in one line, or "" if there is none."""
    text = inspect.getdoc(inspect.getmodule(model)) or ""
    match = re.search(r"^Assumption: (.+?)(?=^\w+: |^\s*$|\Z)", text, re.MULTILINE | re.DOTALL)
    return f" Assumption: {' '.join(match[1].split())}".replace("``", "`") if match else ""


def table(settings: tuple[Setting, ...]) -> str:
    """Return the table of the settings, or "" without settings."""
    return "\n" + COLUMNS + "".join(map(row, settings)) if settings else ""


def row(setting: Setting) -> str:
    """Return a setting as a row of the table."""
    name = f"`{setting.name}`" + ("" if setting.owner == OWN else " *")
    unit, span, default = KINDS[setting.kind](setting)
    return f"| {name} | {unit} | {span} | {default} | {setting.label}: {setting.text} |\n"


def number(setting) -> tuple[str, str, str]:
    """Return the unit, the range and the default of a number; degrees are named in the unit only."""
    ends = setting.low, setting.high
    span = "" if ends == (-math.inf, math.inf) else setting.range_in_words(*setting.limits(*ends))
    words = span, setting.in_words(float(setting.default))
    return "degrees" if setting.unit == "angle" else setting.unit, *(word.replace(" degrees", "") for word in words)


def choice(setting) -> tuple[str, str, str]:
    """Return the unit, the range and the default of a choice."""
    return "", ", ".join(f"`{item.key}`" for item in setting.items), f"`{setting.default}`"


def text(setting) -> tuple[str, str, str]:
    """Return the unit, the range and the default of a text, which may have the numbers of a polynomial."""
    kind = "numbers" if isinstance(setting, Coefficients) else "text"
    return "", kind, f"`{setting.default}`" if setting.default else "none"


KINDS = {
    "FLOAT": number,
    "INT": number,
    "ENUM": choice,
    "BOOLEAN": lambda setting: ("", "on or off", "on" if setting.default else "off"),
    "VECTOR": lambda setting: ("", f"{len(setting.default)} numbers", str(setting.default)),
    "TEXT": text,
    "FILE": lambda setting: ("", "a file or none", "none"),
    "OBJECT": lambda setting: ("", " or ".join(setting.types).lower(), "none"),
    "IMAGE": lambda setting: ("", "an image", "none"),
    "VECTORS": lambda setting: ("", "(rows, columns, 3)", "none"),
}
"""Functions that return the unit, the range and the default in words, by kind of setting."""
