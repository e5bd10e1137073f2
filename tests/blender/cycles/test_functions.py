"""What a shader's functions round, in Cycles itself: each by itself, at 65,536 arguments that float32 has exactly."""

import numpy as np
import pytest

from camera_ray_caster.blender.cycles.shader import set_shader
from camera_ray_caster.core.maths.recording import record
from camera_ray_caster.core.shaders.camera_shader import CameraShader
from camera_ray_caster.core.shaders.osl import Inputs, OslWriter
from camera_ray_caster.core.shaders.rounding import Rounded, rounded
from camera_ray_caster.core.shaders.writer import Term

from .cycles import cycles_colors

SIDE = 256
"""Pixels of the picture, each of which has arguments of its own."""

SHADER = """\
{helpers}shader camera(
    output point position = 0,
    output vector direction = vector(0, 0, 1),
    output color throughput = 1)
{{
    point place = camera_shader_raster_position();
    float column = floor(place[0] * 256), row = floor(place[1] * 256);
    float a = {a}, b = {b};
{lines}
    float value = {none} ? 0 : {value};
    throughput = color(max(value, 0), max(-value, 0), 1);
}}
"""

ANGLES = ((-8, 2**-12), (-1024, 2**-5), (-(2**-7), 2**-22))
EXPONENTS = ((-1, 2**-15), (-8, 2**-12), (-64, 2**-9), (-(2**-7), 2**-22))
ONE = {
    "sin": ANGLES, "cos": ANGLES, "tan": ANGLES, "sqrt": ((0, 2**-6),), "exp": EXPONENTS, "expm1": EXPONENTS,
    "sinh": EXPONENTS, "cosh": EXPONENTS, "tanh": EXPONENTS,
    "log": ((2**-16, 2**-16), (2**-12, 2**-12), (0.25, 0.25), (2**-40, 2**-40), (2**60, 2**60)),
    "log1p": ((-1 + 2**-16, 2**-15), (-(2**-10), 2**-25), (-(2**-20), 2**-4)),
    "arcsin": ((-1, 2**-15), (-(2**-10), 2**-25)), "arccos": ((-1, 2**-15), (-(2**-10), 2**-25)),
    "arctan": ((-16, 2**-11), (-1024, 2**-5), (-(2**-7), 2**-22)),
}  # fmt: skip
"""By operation ranges of arguments: the first one and the step to the next."""

PLANE = (-4, 2**-5), (-4, 2**-5)
RATIOS = ((-4, 2**-5), (2**-5, 2**-5)), ((-4095, 32), (5735 * 2**-13, 2**-12))
TWO = {
    "hypot": (PLANE, *RATIOS), "divide": RATIOS, "remainder": RATIOS, "arctan2": (PLANE, *RATIOS),
    "power": (((2**-6, 2**-6), (-4, 2**-5)), ((2, 2), (-7, 2**-4)), ((0.25, 2**-4), (-16, 2**-3))),
}  # fmt: skip
"""By operation ranges of both arguments."""

CASES = {name: [(operand, None) for operand in ranges] for name, ranges in ONE.items()} | TWO

NEAR = 0.2
"""Of its bound: how near to it an operation comes at least."""


@pytest.mark.parametrize("name", CASES)
def test_an_operation_rounds_as_much_as_is_said(osl, blender, name):
    function, ratios = getattr(np, name), []
    for first, second in CASES[name]:
        formula = record((lambda a, b: (function(a, b),)) if second else (lambda a, _: (function(a),)), 2)
        with np.errstate(all="ignore"):  # some arguments have no number
            k = np.arange(SIDE, dtype=float)
            index = k + (0 if second else SIDE) * k[:, None]
            a, b = first[0] + first[1] * index, (second[0] + second[1] * k[:, None]) if second else 0.0 * index
            (expected,) = rounded(formula, [Rounded(a), Rounded(b)])
            pixels = rendered(blender, formula, *(written(*of, number) for of, number in arguments(first, second)))
            error = np.abs(pixels - np.nan_to_num(expected.value))
            ratio = np.where(error > 0, error / expected.error, 0.0)
        where = np.unravel_index(np.argmax(ratio), ratio.shape)
        assert ratio[where] <= 1, f"at {a[where]}"
        ratios.append(ratio[where])
    assert max(ratios) >= NEAR


@pytest.mark.parametrize("name", ["rint", "floor"])
def test_whole_numbers_are_exact(osl, blender, name):
    formula = record(lambda a, _: (getattr(np, name)(a),), 2)
    pixels = rendered(blender, formula, written(-32, 2**-10, arguments(None, None)[0][1]), "0")
    assert np.array_equal(pixels, getattr(np, name)(np.arange(-32, 32, 2**-10).reshape(SIDE, SIDE)))


def arguments(first, second):
    """Return how both arguments are made, and of which number."""
    return (first, "column" if second else "(column + 256 * row)"), (second or (0, 0), "row")


def written(start, step, number):
    """Return an argument in a shader: no digit is lost."""
    return f"{float(start)!r} + {float(step)!r} * {number}"


def rendered(bpy, formula, a, b):
    """Return what Cycles makes of a formula, (SIDE, SIDE) float64; 0 where it gives no number."""
    writer = OslWriter(Inputs())
    (value,) = writer.write(formula, [Term("a"), Term("b")])
    helpers, none = "".join(f"{text}\n" for text in writer.helper_texts()), value.none or writer.NO
    text = SHADER.format(helpers=helpers, a=a, b=b, lines="\n".join(writer.lines), none=none, value=value.text)
    scene, data = bpy.context.scene, bpy.data.cameras.new("Functions")
    scene.camera = bpy.data.objects.new("Functions", data)
    scene.collection.objects.link(scene.camera)
    scene.render.resolution_x = scene.render.resolution_y = SIDE
    set_shader(data, CameraShader(text, {}, frozenset(), {}))
    colors = cycles_colors(scene)
    assert (colors[..., 2] == 1).all()
    return colors[..., 0] - colors[..., 1]
