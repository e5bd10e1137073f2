"""Formulas run by node, as JavaScript."""

import json
import shutil
import subprocess

import numpy as np
import pytest

from camera_ray_caster.core.maths.recording import Record
from camera_ray_caster.core.shaders.javascript import RUNTIME, JavaScriptWriter
from camera_ray_caster.core.shaders.writer import Term

NUMBERS = "(key, value) => typeof value === 'number' && !Number.isFinite(value) ? String(value) : value"


class Literals:
    """Constants and parameters as literals."""

    number = staticmethod(JavaScriptWriter.literal)

    @staticmethod
    def named(name, value):
        """The value of a parameter."""
        return JavaScriptWriter.literal(value)


def node(program):
    """What an expression of a program is worth, by node: a list whose numbers may be NaN and infinite."""
    if shutil.which("node") is None:
        pytest.skip("needs node: apt-get install nodejs")
    run = subprocess.run(["node", "-"], input=program, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return json.loads(run.stdout)


def evaluated(record: Record, *inputs):
    """The outputs of a record at inputs (n,), as (outputs, n), by node."""
    names = [f"x{k}" for k in range(len(inputs))]
    writer = JavaScriptWriter(Literals())
    terms = writer.write(record, [Term(name) for name in names])
    places = json.dumps(np.transpose(inputs).tolist())
    body = "\n".join((*writer.tables, *writer.lines, f"return [{', '.join(term.text for term in terms)}];"))
    program = (
        f"{RUNTIME}\nconst run = ({', '.join(names)}) => {{\n{body}\n}};\n"
        f"console.log(JSON.stringify({places}.map((at) => run(...at)), {NUMBERS}));"
    )
    return np.array([[float(str(value)) for value in row] for row in node(program)]).T
