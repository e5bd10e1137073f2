"""The rules of the house, read from the source itself: who may import whom, and what every file must have."""

import ast
import graphlib
import importlib
import sys
import tomllib
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "addon" / "camera_ray_caster"
MODULES = sorted(PACKAGE.rglob("*.py"))
SOURCES = [*MODULES, *sorted((ROOT / "scripts").rglob("*.py")), *sorted((ROOT / "tests").rglob("*.py"))]

# What a part of the package may import of the package: the longest name that fits counts. The lowest layer comes first.
LOW = {"core.conventions", "core.tuning", "core.mesh", "core.records", "core.arguments", "core.memory", "core.maths"}
RAYS = LOW | {"core.cameras", "core.camera"}
HITS = RAYS | {"core.motion", "core.shapes", "core.errors", "core.casting"}
MAY_IMPORT = {
    "core.conventions": set(),
    "core.tuning": set(),
    "core.mesh": {"core.tuning"},
    "core.records": {"core.conventions", "core.mesh"},
    "core.arguments": {"core.records"},
    "core.memory": {"core.records"},
    "core.names": {"core.records"},
    "core.version": set(),
    "core.maths": {"core.conventions", "core.maths"},
    "core.cameras": LOW | {"core.cameras"},
    "core.camera": RAYS,
    "core.shapes": LOW | {"core.shapes"},
    "core.errors": RAYS | {"core.shapes", "core.errors"},
    "core.casting": HITS,
    "core.cast": HITS,
    "core.annotations": HITS | {"core.cast", "core.version", "core.annotations"},
    "core.shaders": RAYS | {"core.shaders"},
    "core.motion": RAYS | {"core.motion"},
    # a witness that knew a camera model's formula would be no witness
    "core.report.sample": LOW,
    "core.report.witness": LOW | {"core.report.sample"},
    "core.report.verification": LOW | {"core.report.sample", "core.report.witness"},
    "core.report": HITS | {"core.cast", "core.exports", "core.report", "core.version"},
    "core.exports": RAYS | {"core.exports", "core.motion", "core.names", "core.version"},
    "core": {"core"},
    "blender.verification.witness": LOW,
    "blender": {"blender", "core"},
    "": {"blender"},
}
BLENDER = {
    "bpy", "bpy_extras", "mathutils", "bl_math", "gpu", "gpu_extras", "blf", "bmesh", "imbuf", "addon_utils",
    "bl_operators", "bl_ui",
}  # fmt: skip
CYCLES = {"cycles", "_cycles", "oslquery", "OpenImageIO"}
"""Blender's Cycles, which is an add-on of its own."""
DASK = {"dask", "distributed"}
TESTS_OF_THEIR_OWN = {"core/truth", "blender/add_a_camera"}
"""Rooms of tests that no room of the package has: the exact rays of 60 digits, and a model that is added and taken away
again.
"""
OUTSIDE = {
    "core": {"numpy"},
    "blender": {"numpy"} | BLENDER,
    "blender.cycles": {"numpy"} | BLENDER | CYCLES,
    "blender.terminal.farm": BLENDER | DASK,
    "": set(),
}


def name_of(path):
    """The dotted name of a module inside the package; a folder's ``__init__`` has the folder's name."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(part for part in parts if part != "__init__")


NAMES = {name_of(path) for path in MODULES}


def imports(path):
    """(inside, outside): the package's modules that a file imports, and the top names of all others."""
    inside, outside = set(), set()
    folder = path.relative_to(PACKAGE).parts[:-1]
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            outside |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            outside.add(node.module.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            base = [*folder[: len(folder) - node.level + 1], *(node.module or "").split(".")]
            base = ".".join(filter(None, base))
            for alias in node.names:
                module = f"{base}.{alias.name}".lstrip(".")
                inside.add(module if module in NAMES else base)
    return inside, outside


def fits(name, part):
    """Whether a module is a part of the package or inside it."""
    return name == part or name.startswith(part + ".") or part == ""


def longest(name, table):
    """The entry of the longest part that a module is in."""
    return table[max((part for part in table if fits(name, part)), key=len)]


each_module = pytest.mark.parametrize("path", MODULES, ids=lambda path: name_of(path) or "__init__")
each_source = pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))


@each_module
def test_only_blender_imports_blender_and_nobody_the_package_by_name(path):
    _, outside = imports(path)
    allowed = longest(name_of(path), OUTSIDE) | sys.stdlib_module_names
    assert outside <= allowed, f"imports {outside - allowed}"


@each_module
def test_arrows_point_down(path):
    inside, _ = imports(path)
    allowed = longest(name_of(path), MAY_IMPORT)
    wrong = {name for name in inside if not any(fits(name, part) for part in allowed)}
    assert not wrong, f"imports {wrong}, may import only {sorted(allowed)}"


@each_source
def test_a_name_from_core_exists(path):
    """Scripts import while they run, some of them rarely: a name that was changed would be found late."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("camera_ray_caster.core"):
            module = importlib.import_module(node.module)
            for alias in node.names:
                assert hasattr(module, alias.name) or find_spec(f"{node.module}.{alias.name}"), f"{path}: {alias.name}"


def test_no_arrow_comes_back():
    graph = {name_of(path): imports(path)[0] for path in MODULES}
    graphlib.TopologicalSorter(graph).prepare()


@pytest.mark.parametrize("part", [part for part in MAY_IMPORT if "." in part])
def test_the_table_names_what_exists(part):
    assert part in NAMES


def test_a_room_of_tests_is_named_as_the_room_that_it_tests():
    tests = ROOT / "tests"
    folders = {path.parent.relative_to(tests) for room in ("core", "blender") for path in (tests / room).rglob("*.py")}
    others = {folder.as_posix() for folder in folders if not (PACKAGE / folder).is_dir()}
    assert others == TESTS_OF_THEIR_OWN


@each_source
def test_a_file_is_one_room(path):
    lines = path.read_text().splitlines()
    assert len(lines) <= 300
    assert ast.get_docstring(ast.parse(path.read_text())), "a module says in its first line what it is for"


@each_module
def test_what_is_public_is_described(path):
    nodes = ast.parse(path.read_text()).body
    public = [node for node in nodes if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name[0] != "_"]
    assert [node.name for node in public if not ast.get_docstring(node)] == []


@each_source
def test_no_exception_is_swallowed(path):
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ExceptHandler):
            assert node.type, f"line {node.lineno}: a bare except"
            wide = isinstance(node.type, ast.Name) and node.type.id in {"Exception", "BaseException"}
            raises = any(isinstance(inner, ast.Raise) for inner in ast.walk(node))
            assert raises or not wide, f"line {node.lineno}: catches everything and goes on"


def test_one_version():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    manifest = tomllib.loads((PACKAGE / "blender_manifest.toml").read_text())
    assert project["version"] == manifest["version"]
