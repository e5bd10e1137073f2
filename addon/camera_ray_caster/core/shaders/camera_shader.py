"""A camera as a shader of Cycles: its own rays, recorded and written in OSL.

Cycles gives such a shader a point of the aperture and a place on the raster, 0 .. 1 over the full frame from its bottom
left, to which it has added the camera's shift in fractions of the frame. The shader returns a ray in a camera space
with the view along +Z, x right, y up. Cycles handles the camera's pose and the render border as usual.
Reference: Blender manual, Cycles, Open Shading Language, Cameras.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any
from zlib import crc32

import numpy as np

from ..camera.camera import Camera
from ..cameras.model import Model
from ..conventions import EPS32
from ..maths.recording import Parameter, Record, record
from .osl import Inputs, OslWriter
from .turn import UPRIGHT, Turn
from .writer import Term

MARK = "// Camera Ray Caster, from a {} camera. Inputs by place: {}. Checksum: {:08x}"
MARKED = re.compile(r"// Camera Ray Caster, from a (\w+) camera\. Inputs by place: ([\d ]*)\. Checksum: (\w{8})")

TEXT = """\
// {label}: {description}
// Written by the add-on, as are the values of the inputs: what is changed here does not last.

{helpers}shader camera(
    float frame_width = 0 [[ string help = "Pixels" ]],
    float frame_height = 0 [[ string help = "Pixels" ]],
    float frame_shift_x = 0 [[ string help = "What Cycles has moved the raster by, in widths of the frame" ]],
    float frame_shift_y = 0 [[ string help = "What Cycles has moved the raster by, in heights of the frame" ]],
{inputs}    output point position = 0,
    output vector direction = 0,
    output color throughput = 1)
{{
    point place = camera_shader_raster_position() - point(frame_shift_x, frame_shift_y, 0);
    float x = ({x}) * frame_width, y = ({y}) * frame_height;
{aperture}{lines}
    if ({none}) {{
        throughput = 0;
    }} else {{
        position = point({o[0]}, {o[1]}, -{o[2]});
        direction = normalize(vector({d[0]}, {d[1]}, -{d[2]}));{light}
    }}
}}
"""

APERTURE = """\
    point opening = 0;
    float size = 0;
    getattribute("cam:aperture_position", opening);
    getattribute("cam:aperture_size", size);
    float across = size > 0 ? opening[0] / size : 0, up = size > 0 ? opening[1] / size : 0;
"""
HOLE = """\
    float across = noise("hash", 1048576.0 * place[0], 1048576.0 * place[1]);
    float up = noise("hash", 1048576.0 * place[1], 1048576.0 * place[0]);
"""
"""OSL for a point of the aperture.

Cycles samples the aperture of its own depth of field, whose size for custom cameras differs from ours. It does not know
the hole of a camera obscura: for that, the shader uses noise of the place in the pixel.
"""


@dataclass(frozen=True)
class CameraShader:
    """The text of a shader and the values of its inputs. Cameras with the same formula have the same text."""

    source: str
    values: Mapping[str, float]
    places: frozenset[int]
    """Places of the unnamed constants that are inputs; see ``osl.Inputs``."""
    textures: Mapping[str, np.ndarray]
    """Images that the shader reads, by the paths of their EXR files: (rows, columns, 3) float32, from the bottom."""


@dataclass(frozen=True)
class Mark:
    """Information in the first line of a shader."""

    blender_type: str
    """Type of the camera before it became a custom camera: PERSP, ORTHO or PANO."""
    places: frozenset[int]


def read_mark(source: str) -> Mark | None:
    """Return the mark in the first line of a text; None if the text is not a shader of ours, or was edited."""
    line, _, code = source.partition("\n")
    match = MARKED.fullmatch(line)
    if match is None or int(match[3], 16) != crc32(code.encode()):
        return None
    return Mark(match[1], frozenset(map(int, match[2].split())))


def camera_shader(
    camera: Camera,
    blender_type: str,
    shift: tuple[float, float],
    places: frozenset[int] = frozenset(),
    turn: Turn = UPRIGHT,
    folder: str = "",
) -> CameraShader:
    """Return the shader that gives Cycles the rays of a camera for all of its pixels and aperture, at one time.

    blender_type: the type for ``read_mark``. shift: Cycles' shift of the raster, in fractions of the frame. places:
    constants that are inputs in any case, for cameras whose settings change. turn: the transformation from Cycles'
    raster to the camera's. folder: of ``textures``. The rays are those of ``Camera.sample_rays`` in float32. Raises
    NotRecordable for a model with operations that cannot be recorded, and InputError for a table that is too large.
    """
    model, inputs = camera.model, Inputs(places)
    writer = OslWriter(inputs, folder=folder)
    outputs = writer.write(ray_record(camera), [Term("x"), Term("y"), Term("across"), Term("up")])
    none = writer.either(*(term.none for term in outputs)) or writer.NO
    texts = [term.text for term in outputs]
    (width, height), opening = model.size, camera.aperture
    frame = {"frame_width": width, "frame_height": height, "frame_shift_x": shift[0], "frame_shift_y": shift[1]}
    settings = {name: value for name, value in inputs.values.items() if name not in frame}
    x, y = turn.places
    code = TEXT.format(
        label=model.label,
        description=model.description,
        helpers="".join(f"{text}\n" for text in writer.helper_texts()),
        inputs="".join(f"    float {name} = 0,\n" for name in settings),
        aperture="" if opening is None else HOLE if opening.is_hole else APERTURE,
        lines="\n".join((*writer.tables, *writer.lines)),
        none=none,
        x=x,
        y=y,
        o=texts[:3],
        d=texts[3:6],
        light=f"\n        throughput = color({', '.join(texts[6:])});" if texts[6:] else "",
    )
    used = " ".join(map(str, sorted(inputs.used)))
    values = {**{name: float(value) for name, value in frame.items()}, **settings}
    source = f"{MARK.format(blender_type, used, crc32(code.encode()))}\n{code}"
    return CameraShader(source, values, frozenset(inputs.used), writer.textures)


def ray_record(camera: Camera) -> Record:
    """Return the record of a ray, origin and direction in the camera's frame, as a function of pixel and aperture. One
    or three more numbers are its light, if that is not the same for all rays.

    Its four inputs are the pixel coordinates x and y, and a point of the aperture in radii, or for a hole two numbers
    in [0, 1). The fields of the model are parameters.
    """
    width, height = camera.model.size
    size = Parameter(width, "frame_width"), Parameter(height, "frame_height")
    model = named(camera.model, size=size)
    chief_ray = replace(camera, model=model).camera_rays if _is_sheared(camera) else model.rays
    opening = _named(camera.aperture, "aperture")

    def ray(x, y, across, up):
        origin, direction = chief_ray(x, y)
        if opening is not None:
            lens = opening.radius * across, opening.radius * (-up if opening.is_mirrored else up)
            point = opening.points(across, up) if opening.is_hole else lens
            origin, direction = model.through(opening, (origin, direction), x, y, point)
            carried = model.light(opening, x, y, point)
            lights = carried if isinstance(carried, tuple) else () if carried is None else (carried,)
            return *origin, *direction, *lights
        return *origin, *direction

    return record(ray, 4)


def _is_sheared(camera: Camera) -> bool:
    """Whether the camera's axes are not perpendicular in float32: lengths then depend on the direction."""
    return bool(np.abs(camera.pose.basis.T @ camera.pose.basis - np.eye(3)).max() > 16 * EPS32)


def named(model: Model, **fields_kept: Any) -> Model:
    """Return a model with its numbers as parameters named after their fields, except the ``fields_kept`` fields."""
    return replace(_named(model), **fields_kept)


def _named(item: Any, name: str = "") -> Any:
    """Return a model, or a part of a model, with its numbers as parameters named after their fields."""
    if is_dataclass(item) and not isinstance(item, type):
        parts = {field.name: f"{name}_{field.name}".strip("_") for field in fields(item)}
        return replace(item, **{field: _named(getattr(item, field), full) for field, full in parts.items()})
    if isinstance(item, tuple):
        return tuple(_named(entry, f"{name}_{index}") for index, entry in enumerate(item))
    return Parameter(item, name) if isinstance(item, float) else item
