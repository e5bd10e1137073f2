"""The program of forty lines, where numpy is all there is, and what a type checker and a reader see of the door."""

import pydoc
import re
import subprocess
import sys
from pathlib import Path

import pytest

import camera_ray_caster as crc

PROGRAM = Path(__file__).with_name("program.py")
ADDON = Path(crc.__file__).parents[1]
ONLY_NUMPY = f"""
import sys
class Refuse:
    def find_spec(self, name, path=None, target=None):
        known = {{"numpy", "camera_ray_caster"}} | sys.stdlib_module_names
        if name.partition(".")[0] not in known and not name.startswith("_sysconfigdata"):
            raise ModuleNotFoundError(name, name=name)
sys.meta_path.insert(0, Refuse())
sys.path.insert(0, {str(ADDON)!r})
"""
"""An environment in which nothing but numpy and the standard library can be imported."""


def run(code, *arguments):
    """Run Python's code in an environment without Blender; return what it prints."""
    words = [sys.executable, "-c", ONLY_NUMPY + code, *map(str, arguments)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_program_of_forty_lines(tmp_path):
    assert len(PROGRAM.read_text().splitlines()) <= 45
    printed = run(f"exec(compile(open({str(PROGRAM)!r}).read(), 'program', 'exec'))", tmp_path).splitlines()
    for name, line in zip(("fisheye", "scanner"), printed, strict=False):
        share, off = re.fullmatch(rf"{name}: (\d+)% hits, back within (\S+) pixels, \[2 [01]\]", line).groups()
        assert int(share) > 50
        assert float(off) < 1e-2  # the distance is float32, and the ground reaches far
    assert "OpenCV Fisheye" in "\n".join(printed)
    assert printed[-1] == "['camera.json']"
    assert {f"{crc.camera_from_json(tmp_path / 'camera.json', camera=name).name}" for name in ("fisheye", "scanner")}


def test_a_program_with_every_name(tmp_path):
    """A type checker reads it in tests/core/camera/test_description.py."""
    text = PROGRAM.with_name("every_name.py").read_text()
    assert [name for name in crc.__all__ if f"crc.{name}" not in text] == []
    output = run(f"exec(compile({text!r}, 'every_name', 'exec'))", tmp_path)
    assert "<Camera 'Camera', OPENCV_FISHEYE, 64 x 48" in output


def test_the_first_program_of_the_readme():
    readme = (ADDON.parent / "README.md").read_text(encoding="utf-8")
    first = re.search(r"^```python\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)[1]
    assert len(first.splitlines()) <= 8
    assert run(first).startswith("(480, 640) (480, 640, 3) [[")


def test_the_import_is_quick_and_brings_neither_numpy_nor_blender():
    """0.2 s are what a user may notice; here by processor time, at least of five."""
    code = (
        "import time; start = time.process_time()\nimport camera_ray_caster\n"
        "print(time.process_time() - start, 'numpy' in sys.modules, 'bpy' in sys.modules)"
    )
    runs = [run(code).split() for _ in range(5)]
    assert {tuple(words[1:]) for words in runs} == {("False", "False")}
    assert min(float(words[0]) for words in runs) < 0.2


def test_every_name_is_there_with_its_help():
    assert set(crc.__all__) == {name for name in dir(crc) if not name.startswith("_")}
    blenders = {"read_camera", "read_scene", "read_shapes", "verify"}
    for name in set(crc.__all__) - blenders:
        assert getattr(crc, name).__doc__, name
    assert re.fullmatch(r"\d+\.\d+\.\d+", crc.__version__)
    output = run("import camera_ray_caster as crc, pydoc; print(pydoc.render_doc(crc, renderer=pydoc.plaintext))")
    for name in set(crc.__all__) - blenders:
        assert re.search(rf"\b{name}\b", output), name


def test_what_needs_blender_says_so():
    code = "import camera_ray_caster as crc\ntry: crc.read_camera\nexcept AttributeError as error: print(error)"
    assert "needs Blender" in run(code)
    code = "import camera_ray_caster as crc\ncrc.unregister()\n"
    code += "try: crc.register()\nexcept ImportError as error: print(error)"
    assert run(code).strip() == "register needs Blender: call it there, or pip install bpy"
    with pytest.raises(AttributeError, match="camra"):
        _ = crc.camra


def test_help_of_a_function_is_a_page():
    assert "pixels" in pydoc.render_doc(crc.camera)
