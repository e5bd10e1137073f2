"""The rules of the house, read from the source itself: who may import whom, and what every file must have."""

import ast
import graphlib
import importlib
import sys
import tomllib
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "addon" / "camera_ray_caster"
MODULES = sorted(PACKAGE.rglob("*.py"))
SOURCES = [*MODULES, *sorted((ROOT / "scripts").rglob("*.py")), *sorted((ROOT / "tests").rglob("*.py"))]

# What a part of the package may import of the package: the longest name that fits counts. The lowest layer comes first.
LOW = {
    "core.conventions", "core.other_names", "core.tuning", "core.materials", "core.mesh",
    "core.shape_records", "core.records", "core.arguments", "core.memory", "core.maths", "core.units",
}  # fmt: skip
FILES = {"core.openexr", "core.programs", "core.text_forms"}
RAYS = LOW | {"core.lenses", "core.cameras", "core.camera"} | FILES
HITS = RAYS | {"core.scene", "core.motion", "core.shapes", "core.errors", "core.casting"}
READ = {"core", "blender.properties", "blender.process", "blender.read"}
RENDER = READ | {"blender.cycles", "blender.faces", "blender.verification", "blender.output"}
DOOR = RENDER | {"blender.engine", "blender.rig"}
MAY_IMPORT = {
    "core.conventions": set(),
    "core.tuning": set(),
    "core.mesh": {"core.tuning"},
    "core.materials": {"core.materials"},
    "core.shape_records": {"core.materials", "core.mesh", "core.other_names"},
    "core.records": {"core.conventions", "core.shape_records"},
    "core.other_names": set(),
    "core.arguments": {"core.other_names", "core.records"},
    "core.memory": {"core.records"},
    "core.names": {"core.records"},
    "core.file_set": {"core.records"},
    "core.units": set(),
    "core.version": set(),
    "core.maths": {"core.conventions", "core.maths"},
    "core.lenses": LOW | {"core.lenses"},
    "core.cameras": LOW | {"core.lenses", "core.cameras"},
    "core.openexr": {"core.memory", "core.openexr", "core.records"},
    "core.text_forms": {"core.memory", "core.records", "core.text_forms"},
    "core.programs": LOW | FILES | {"core.cameras"},
    "core.camera": RAYS,
    "core.shapes": LOW | {"core.shapes"},
    "core.errors": RAYS | {"core.shapes", "core.errors"},
    "core.casting": HITS,
    "core.any_rays": HITS | {"core.any_rays"},
    "core.scene": RAYS,
    "core.cast": HITS | {"core.any_rays"},
    "core.clouds": HITS | {"core.any_rays", "core.cast", "core.clouds"},
    "core.annotations": HITS | {"core.any_rays", "core.cast", "core.version", "core.annotations"},
    "core.faces": RAYS | {"core.faces"},
    "core.shaders": RAYS | {"core.shaders"},
    "core.motion": RAYS | {"core.motion"},
    # a witness that knew a camera model's formula would be no witness
    "core.report.sample": LOW,
    "core.report.witness": LOW | {"core.report.sample"},
    "core.report.verification": LOW | {"core.report.sample", "core.report.witness"},
    "core.report": HITS | {"core.cast", "core.exports", "core.report", "core.version"},
    "core.lesson": HITS | {"core.cast", "core.lesson"},
    "core.exports": RAYS | {"core.exports", "core.file_set", "core.motion", "core.names", "core.version"},
    "core.sets": HITS | {"core.cast", "core.file_set", "core.annotations", "core.exports", "core.names", "core.sets"},
    "core.library": HITS | {
        "core.any_rays", "core.cast", "core.clouds", "core.exports", "core.lesson", "core.library", "core.names",
    },
    "core.web": RAYS | {"core.library", "core.shaders", "core.web"},
    "core": {"core"},
    "blender.verification.blender_witness": LOW,
    # Blender's data are read at the bottom, rendered and written in the middle; the doors stand on top
    "blender.properties": {"core", "blender.properties"},
    "blender.process": {"core", "blender.process"},
    "blender.read": READ,
    "blender.cycles": READ | {"blender.cycles"},
    "blender.faces": READ | {"blender.cycles", "blender.faces"},
    "blender.verification": READ | {"blender.cycles", "blender.verification"},
    "blender.output": READ | {"blender.output"},
    "blender.engine": RENDER | {"blender.engine"},
    "blender.rig": {"core", "blender.properties", "blender.read"},
    "blender.gallery": {"core"},
    "blender.view3d": READ | {"blender.output", "blender.view3d"},
    "blender.terminal": DOOR | {"blender.terminal"},
    "blender.ui": DOOR | {"blender.gallery", "blender.view3d", "blender.ui"},
    "blender.ui.cast_all": DOOR | {"blender.terminal", "blender.ui"},
    "blender": {"blender", "core"},
    "": {"blender", "core"},
}
BLENDER = {
    "bpy", "bpy_extras", "mathutils", "bl_math", "gpu", "gpu_extras", "blf", "bmesh", "imbuf", "addon_utils",
    "bl_operators", "bl_ui",
}  # fmt: skip
CYCLES = {"cycles", "_cycles", "oslquery", "OpenImageIO"}
"""Blender's Cycles, which is an add-on of its own."""
DASK = {"dask", "distributed"}
SHARED_NAMES = {"Constants", "Witness"}
"""Protocols that core writes down, and the class of the same name that has it."""
PARTS_OF_A_PROGRAM = "looks", "read", "poses", "rays", "note", "hint", "pair", "write", "refusal"
"""Functions of a program's file: the contract, ``parts.program``, tells what they do."""
PARTS_OF_A_WINDOW = ("register",)
"""As above: ``blender.registration.MODULES`` tells what they do."""
TESTS_OF_THEIR_OWN = {"core/truth", "blender/add_a_camera"}
"""Rooms of tests that no room of the package has: the exact rays of 60 digits, and a model that is added and taken away
again.
"""
OUTSIDE = {
    "core": {"numpy"},
    "core.sets.set_reader": {"numpy", "OpenImageIO"},  # a program of its own, which is copied into sets
    "blender": {"numpy"} | BLENDER,
    "blender.cycles": {"numpy"} | BLENDER | CYCLES,
    "blender.terminal.farm": BLENDER | DASK,
    "": set(),
}


def name_of(path):
    """The dotted name of a module inside the package; a folder's ``__init__`` has the folder's name."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(name for name in parts if name != "__init__")


NAMES = {name_of(path) for path in MODULES}
PRONOUNS = {*"one found own part place said told given rest it them what most more some which both".split()}  # noqa: SIM905
DEFINITIONS = ast.FunctionDef | ast.ClassDef


@pytest.fixture(scope="module")
def trees():
    """The parsed files, by path. They go with the last test here: garbage collectors walk through millions of nodes."""
    return {path: ast.parse(path.read_text()) for path in SOURCES}


def statements(node):
    """The statements in a node, at any depth; walking through expressions, too, takes ten times as long."""
    for name in ("body", "orelse", "finalbody", "handlers", "cases"):
        for child in getattr(node, name, ()):
            yield child
            yield from statements(child)


def imports(path):
    """(inside, outside): the package's modules that a file imports, and the top names of all others."""
    inside, outside = set(), set()
    folder = path.relative_to(PACKAGE).parts[:-1]
    for node in statements(ast.parse(path.read_text())):
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


@cache
def all_imports():
    """What each module imports, by name: see ``imports``."""
    return {name_of(path): imports(path) for path in MODULES}


def offenders(findings):
    """What was found against a rule, by module or file, where anything was."""
    return {str(where): finding for where, finding in findings.items() if finding}


def fits(name, package):
    """Whether a module is the package or inside it."""
    return name == package or name.startswith(package + ".") or package == ""


def longest(name, table):
    """The entry of the longest part that a module is in."""
    return table[max((room for room in table if fits(name, room)), key=len)]


def test_only_blender_imports_blender_and_nobody_the_package_by_name():
    findings = {}
    for name, (_, outside) in all_imports().items():
        findings[name] = outside - longest(name, OUTSIDE) - sys.stdlib_module_names
    assert offenders(findings) == {}


def test_arrows_point_down():
    findings = {}
    for name, (inside, _) in all_imports().items():
        findings[name] = {other for other in inside if not any(fits(other, room) for room in longest(name, MAY_IMPORT))}
    assert offenders(findings) == {}


def test_a_name_from_core_exists(trees):
    """Scripts import while they run, some of them rarely: a name that was changed would be found late."""
    findings = {}
    for path, tree in trees.items():
        names = {
            (node.module, alias.name)
            for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("camera_ray_caster.core")
            for alias in node.names
        }
        findings[path] = {".".join(name) for name in names if not exists(*name)}
    assert offenders(findings) == {}


@cache
def exists(module, name):
    """Whether a module has a name, or a module of that name in it."""
    return hasattr(importlib.import_module(module), name) or bool(find_spec(f"{module}.{name}"))


def test_no_arrow_comes_back():
    graphlib.TopologicalSorter({name: inside for name, (inside, _) in all_imports().items()}).prepare()


def test_the_table_names_what_exists():
    assert {room for room in MAY_IMPORT if "." in room} <= NAMES


def test_a_room_of_tests_is_named_as_the_room_that_it_tests():
    tests = ROOT / "tests"
    folders = {path.parent.relative_to(tests) for room in ("core", "blender") for path in (tests / room).rglob("*.py")}
    others = {folder.as_posix() for folder in folders if not (PACKAGE / folder).is_dir()}
    assert others == TESTS_OF_THEIR_OWN


def test_a_file_is_one_room():
    assert offenders({path: max(0, len(path.read_text().splitlines()) - 300) for path in SOURCES}) == {}


def test_a_module_says_what_it_is_for_and_so_does_what_is_public_in_it(trees):
    assert [path for path, tree in trees.items() if not ast.get_docstring(tree)] == []
    findings = {}
    for path in MODULES:
        contract = PARTS_OF_A_PROGRAM if path.parent == PACKAGE / "core" / "programs" else PARTS_OF_A_WINDOW
        public = [node for node in trees[path].body
                  if isinstance(node, DEFINITIONS) and node.name[0] != "_" and node.name not in contract]  # fmt: skip
        findings[path] = [node.name for node in public if not (ast.get_docstring(node) or is_overload(node))]
    assert offenders(findings) == {}


def is_overload(node):
    return any(ast.unparse(decorator) == "overload" for decorator in node.decorator_list)


def test_a_class_has_a_name_of_its_own(trees):
    """One word, one meaning."""
    findings = {}
    for path in MODULES:
        for node in trees[path].body:
            if isinstance(node, ast.ClassDef):
                findings.setdefault(node.name, []).append(name_of(path))
    assert {name: where for name, where in findings.items() if len(where) > 1 and name not in SHARED_NAMES} == {}


def test_a_variable_is_no_pronoun(trees):
    """In the add-on and the scripts; tests may use them."""
    findings = {}
    for path in (path for path in SOURCES if not path.is_relative_to(ROOT / "tests")):
        names = {getattr(node, "id", None) or getattr(node, "arg", None) for node in ast.walk(trees[path])}
        findings[path] = names & PRONOUNS
    assert offenders(findings) == {}


def test_no_exception_is_swallowed(trees):
    """By a bare except, nor by one that catches everything and goes on."""
    findings = {}
    for path, tree in trees.items():
        handlers = [node for node in ast.walk(tree) if isinstance(node, ast.ExceptHandler)]
        findings[path] = [node.lineno for node in handlers if node.type is None or (is_wide(node) and not raises(node))]
    assert offenders(findings) == {}


def is_wide(handler):
    """Whether a handler catches every exception."""
    return isinstance(handler.type, ast.Name) and handler.type.id in {"Exception", "BaseException"}


def raises(handler):
    """Whether a handler raises an exception."""
    return any(isinstance(node, ast.Raise) for node in ast.walk(handler))


def test_one_version():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    manifest = tomllib.loads((PACKAGE / "blender_manifest.toml").read_text())
    assert project["version"] == manifest["version"]
    assert f"\nversion: {project['version']}\n" in (ROOT / "CITATION.cff").read_text()
    assert f"## [{project['version']}] - 20" in (ROOT / "CHANGELOG.md").read_text()
