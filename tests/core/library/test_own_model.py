"""A camera model of somebody's own: added, cast, held to the contract by one command, and refused where it is none."""

import subprocess
import sys
from pathlib import Path

import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.cameras import MODELS

ROOT = Path(__file__).parents[3]
FILE = Path(__file__).with_name("equal_area.py")
USE = f"""
import sys, numpy as np
sys.path[:0] = [{str(ROOT / "addon")!r}, {str(FILE.parent)!r}]
import camera_ray_caster as crc
from equal_area import EqualArea
crc.register_model(EqualArea)
crc.register_model(EqualArea)
camera = crc.camera("EQUAL_AREA", (64, 32), equal_area_top=1.2)
angles = crc.cast(camera, crc.spheres((0, 0, -3)), "solid_angle", dtype=float)["solid_angle"]
rays = camera.rays()
pixels = np.stack(np.meshgrid(np.arange(64), np.arange(32)), -1) + 0.5
off = camera.project(rays.origins + 3 * rays.directions) - pixels
print(len(crc.models()), np.ptp(angles) / angles.mean(), np.abs(off).max())
try: crc.camera("EQUAL_AREAS", (64, 32))
except crc.InputError as error: print(error)
"""


def test_a_model_is_added_once_and_is_like_the_others():
    done = subprocess.run([sys.executable, "-c", USE], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    numbers, refusal = done.stdout.splitlines()
    count, spread, off = map(float, numbers.split())
    assert count == len(MODELS) + 1
    assert spread < 1e-12  # equal areas, by the solid angles that follow from its formula
    assert off < 1e-9
    assert "did you mean EQUAL_AREA" in refusal


@pytest.mark.full
def test_one_command_holds_it_to_the_contract():
    words = ["-q", "-m", "", "-n", "0", "-p", "no:cacheprovider", "--model", FILE]
    rooms = ["tests/core/cameras/test_model.py", "tests/core/cameras/test_declarations.py", "tests/core/truth"]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *map(str, words), *rooms],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stdout
    assert int(done.stdout.split(" passed")[0].split()[-1]) > 12


def test_contributing_shows_this_file():
    shown = f"```python\n{FILE.read_text(encoding='utf-8')}```\n"
    assert shown in (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


def defined(**names):
    """A model with these names over what it needs."""
    needed = {"key": "OWN", "label": "Own", "description": "A test's", "group": "Panorama", "FORMULA": ()}
    return type("Own", (crc.Model,), {"rays": lambda self, x, y: None, **needed, **names})


@pytest.mark.parametrize(
    ("model", "message"),
    [
        (lambda: "OWN", "'OWN' is not a camera model"),
        (lambda: type("Bare", (crc.Model,), {}), "model Bare has no key, label, description, group, FORMULA, rays"),
        (lambda: defined(group="Panoramas"), "group of model OWN"),
        (lambda: defined(number=1), "number 1 of model OWN is another model's"),
        (lambda: defined(number="1000"), "number of model OWN is '1000'"),
        (lambda: defined(label=None), "label of model OWN is None"),
        (lambda: defined(key="own\n"), "must be capitals, digits and _"),
        (lambda: defined(key="PERSP"), "key PERSP is that of a model of the package"),
    ],
)
def test_what_is_no_model_is_one_line_and_adds_nothing(model, message):
    before = list(MODELS)
    with pytest.raises(crc.InputError, match=message):
        crc.register_model(model())
    assert before == MODELS


@pytest.mark.parametrize(
    ("planar", "message"), [(False, "it must be of length 1, or have z = -1 and planar"), (True, "it must have z = -1")]
)
def test_directions_of_another_length_are_named(planar, message):
    before = list(MODELS)
    rays = lambda self, x, y: ((0.0, 0.0, 0.0), (0.2 * x - 5, 0.2 * y - 4, -2.0))  # noqa: E731
    try:
        crc.register_model(defined(rays=rays, planar=planar))
        with pytest.raises(crc.InputError, match=message):
            crc.camera("OWN", (50, 40))
    finally:
        MODELS[:] = before
