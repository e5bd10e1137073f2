"""A record of a formula, written in the shading language of WebGL 2: GLSL ES 3.0, float32.

GLSL need not have NaN and may compute its own functions with few digits, arc tangents to 4096 units in the last place:
HELPERS replace these.
References: The OpenGL ES Shading Language 3.00, chapters 4.5 and 8; Vulkan, Precision and Operation of SPIR-V
Instructions (which WebGL often runs on); S. Moshier, Cephes (atanf), whose polynomial is used.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from .writer import C_FUNCTIONS, C_HELPERS, Writer

OWN = {
    "tan": """\
float tangent(float x)
{
    return sine(x) / cosine(x);
}
""",
    "arctan": """\
float arcTangent(float x)
{
    float y = abs(x);
    bool far = y > 2.41421356, middle = y > 0.414213562;
    float z = far ? -1.0 / y : middle ? (y - 1.0) / (y + 1.0) : y, s = z * z;
    float rest = ((8.05374449538e-2 * s - 1.38776856032e-1) * s + 1.99777106478e-1) * s - 3.33329491539e-1;
    return sign(x) * ((far ? 1.57079633 : middle ? 0.785398163 : 0.0) + (rest * s * z + z));
}
""",
    "arctan2": """\
float arcTangent2(float y, float x)
{
    float most = max(abs(x), abs(y)), least = min(abs(x), abs(y));
    float turn = most > 0.0 ? arcTangent(least / most) : 0.0;
    turn = abs(y) > abs(x) ? 1.57079633 - turn : turn;
    turn = x < 0.0 ? 3.14159265 - turn : turn;
    return y < 0.0 ? -turn : turn;
}
""",
    "arcsin": """\
float arcSine(float x)
{
    return arcTangent2(x, sqrt((1.0 - x) * (1.0 + x)));
}
""",
    "arccos": """\
float arcCosine(float x)
{
    return arcTangent2(sqrt((1.0 - x) * (1.0 + x)), x);
}
""",
    "hypot": """\
float hypotenuse(float x, float y)
{
    float most = max(abs(x), abs(y));
    return most > 0.0 ? most * length(vec2(x, y) / most) : 0.0;
}
""",
    "expm1": """\
float expMinus1(float x)
{
    float sum = 0.5 + x * (1.66666667e-1 + x * (4.16666667e-2 + x * 8.33333333e-3));
    return abs(x) < 0.1 ? x * (1.0 + x * sum) : exp(x) - 1.0;
}
""",
    "power": """\
float power(float x, float y)
{
    float odd = y - 2.0 * floor(0.5 * y);
    return x == 0.0 ? (y == 0.0 ? 1.0 : 0.0) : x < 0.0 && odd == 1.0 ? -pow(-x, y) : pow(abs(x), y);
}
""",
}


@dataclass
class GlslWriter(Writer):
    """Writer of the statements of a GLSL function."""

    HELPERS = {name: text for name, text in C_HELPERS.items() if name != "rint"} | OWN
    NEEDED_BY = {
        "cos": ("sin",), "tan": ("sin", "cos"), "arctan2": ("arctan",), "arcsin": ("arctan", "arctan2"),
        "arccos": ("arctan", "arctan2"),
    }  # fmt: skip
    FUNCTIONS = C_FUNCTIONS | {
        "rint": "roundEven({})", "tan": "tangent({})", "arctan": "arcTangent({})", "arctan2": "arcTangent2({}, {})",
        "arcsin": "arcSine({})", "arccos": "arcCosine({})", "hypot": "hypotenuse({}, {})", "expm1": "expMinus1({})",
        "power": "power({}, {})",
    }  # fmt: skip

    def table_text(self, name: str, entries: Sequence[float]) -> str:
        count = len(entries)
        return f"    const float {name}[{count}] = float[{count}]({', '.join(map(self.literal, entries))});"
