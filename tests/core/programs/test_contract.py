"""The contract of programs: each has samples, which no other program takes for its own and which survive any damage."""

import ast
import json
import re
from functools import cache
from itertools import chain
from pathlib import Path

import numpy as np
import pytest

from camera_ray_caster.core import programs
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.names import frame_digits
from camera_ray_caster.core.programs import PROGRAMS, program_of
from camera_ray_caster.core.programs.parts.document import Document
from camera_ray_caster.core.programs.parts.lens import FRAME_SIZE
from camera_ray_caster.core.programs.parts.program import CameraRecord
from camera_ray_caster.core.programs.reading.camera_poses import placed_in
from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

from ...tiers import examples

SAMPLES = Path(__file__).parent / "samples"
"""Files MODULE.ENDING or MODULE.WORD.ENDING of each program."""
MODULES = {module.PROGRAM.name: name for name, module in vars(programs).items() if hasattr(module, "PROGRAM")}
FRAME = (640, 480)
ODD = None, True, "x", "", -1.5, 1e300, [], [1], [[1, 2], [3]], {}, {"a": 1}, [{"a": 1}], [None]
"""What an entry may be in place of what it should be."""
MOST = 20
"""Entries of a sample that are damaged, at even distances."""


def samples_of(program):
    """The samples of a program, by name."""
    return sorted(SAMPLES.glob(f"{MODULES[program.name]}.*"))


def document(path, key=""):
    """The document of a file."""
    return Document(str(path), FRAME, key)


READERS = [program for program in PROGRAMS if program.name in MODULES and program.looks is not None]
each_program = pytest.mark.parametrize("program", READERS, ids=lambda program: MODULES[program.name])


@pytest.mark.one_for_each("program")
@each_program
def test_a_sample_is_of_its_program_and_of_no_other(program):
    samples = samples_of(program)
    assert samples, f"give a sample: {SAMPLES / MODULES[program.name]}.ENDING"
    for path in samples:
        names = [
            other.name for other in PROGRAMS if other.recognizes(document(path)) and other.general == program.general
        ]
        assert names == [program.name], f"{path.name} looks like {names or 'no program'}: see looks in its file"
        assert program_of(document(path)) is program
    lenses = [lens for path in samples for lens in read(path, lenses_of)]
    assert all(lens.refusal is None for lens in lenses)
    assert bool(lenses) == (program.read is not None)
    assert any(read(path, poses_of) for path in samples) == (program.poses is not None)
    assert any(len(read(path, rays_of)) for path in samples) == (program.rays is not None)


def poses_of(path, *_):
    """The poses of a file."""
    return placed_in(document(path), 1.0)


def rays_of(path, *_):
    """The rays of a scanner without rows and columns; none of other files."""
    program = program_of(document(path))
    return [] if program is None or program.rays is None else program.rays(document(path))


def read(path, reader):
    """What a reader returns of a file; nothing of one that it refuses in one line."""
    try:
        return reader(str(path), "OPENCV_PINHOLE", FRAME)
    except InputError as refusal:
        message = str(refusal)
        assert "\n" not in message
        assert len(message) < 1000
        return []


@pytest.mark.one_for_each("program")
@each_program
def test_a_damaged_sample_ends_in_a_lens_or_in_one_line(program, tmp_path):
    for path in samples_of(program):
        for content in damaged(path):
            file = tmp_path / path.name
            file.unlink(missing_ok=True)  # to truncate it takes six times as long as a new file
            file.write_bytes(content)
            for lens in read(file, lenses_of):
                assert lens.refusal is None or "\n" not in str(lens.refusal)
            read(file, poses_of)
            read(file, rays_of)


def damaged(path):
    """A sample cut off, with words that are others, and with entries of other types and names."""
    whole = path.read_bytes()
    yield from (whole[: len(whole) * k // 12] for k in range(12))
    if b"\0" in whole:
        return
    text = whole.decode()
    words = list(re.finditer(r"[-+\w.]+", text))
    for word in words[:: 1 + len(words) // examples(MOST)]:
        for other in ("x", "", "1e999", "-1", "nan"):
            yield (text[: word.start()] + other + text[word.end() :]).encode()
    try:
        tree = document(path).raw
    except InputError:
        return
    places = list(entries(tree))
    for route in places[:: 1 + len(places) // examples(MOST)]:
        for value in ODD:
            yield json.dumps(changed(tree, route, lambda owner, key, value=value: {key: value})).encode()
        yield json.dumps(changed(tree, route, lambda owner, key: {})).encode()
        yield json.dumps(changed(tree, route, lambda owner, key: {f"{key}_": owner[key]})).encode()


def entries(tree, path=()):
    """The places of all entries of mappings in a tree."""
    items = tree.items() if isinstance(tree, dict) else enumerate(tree) if isinstance(tree, list) else ()
    for key, value in items:
        if isinstance(tree, dict):
            yield (*path, key)
        yield from entries(value, (*path, key))


def changed(tree, path, change):
    """A tree with another entry at a place."""
    key, *inside = path
    if isinstance(tree, list):
        return [changed(entry, inside, change) if k == key else entry for k, entry in enumerate(tree)]
    if not inside:
        return {name: entry for k in tree for name, entry in (change(tree, k) if k == key else {k: tree[k]}).items()}
    return {name: changed(entry, inside, change) if name == key else entry for name, entry in tree.items()}


WRITERS = [
    program for program in READERS if program.export is not None and program.export.files and program.export.models
]


@pytest.mark.one_for_each("program")
@pytest.mark.parametrize("program", WRITERS, ids=lambda program: MODULES[program.name])
def test_what_is_read_and_written_and_read_is_the_same_to_the_bit(program, tmp_path):
    """Samples have numbers that stay as they are: halves, and turns by right angles."""
    lenses = [lens for path in samples_of(program) for lens in read(path, lenses_of)]
    placed = [pose for path in samples_of(program) for pose in read(path, poses_of)]
    assert lenses
    records = []
    for number, lens in enumerate(lenses):
        views = [entry for entry in placed if entry.camera == lens.name] or [None]
        for frame, entry in enumerate(views, 1):
            name = f"camera{number}"
            pose = np.eye(4) if entry is None else entry.pose
            rolling = None if entry is None else entry.rolling
            records.append(CameraRecord(name, f"{name}_{frame_digits(frame)}", lens, pose, frame, rolling=rolling))
    able = [record for record in records if program.export.refusal(record) is None]
    assert able
    for name, content in program.export.files(able):
        (tmp_path / name).write_text(content)
    files = sorted(tmp_path.iterdir())
    again = list(chain.from_iterable(read(path, lenses_of) for path in files))
    settings = {repr(plain(lens)) for lens in again}
    assert settings == {repr(plain(record.lens)) for record in able}
    if placed and program.poses is not None:
        poses = list(chain.from_iterable(read(path, poses_of) for path in files))
        assert sorted(map(numbers, poses)) == sorted(map(numbers, able))


def numbers(camera):
    """The pose, and the rolling shutter, as text."""
    return repr((camera.pose.tolist(), camera.rolling and (*camera.rolling[:2], camera.rolling.pose.tolist())))


def plain(lens):
    """The model and the settings of a lens that are not 0, in one order."""
    return lens.model, sorted((name, value) for name, value in lens.settings.items() if value or name in FRAME_SIZE)


def test_every_export_of_a_program_is_a_format():
    keys = {program.export.key for program in PROGRAMS if program.export is not None}
    assert keys == {export.key for export in EXPORT_FORMATS}


SHARED = {"OpenCV", "CAHVOR", "Velodyne", "Ouster", "this add-on"}
"""Names that camera models and devices have, too, and the add-on's own."""
ADDON = Path(programs.__file__).parents[2]
MOST_FILES = 3


@cache
def code_of_files():
    """The code of each file of the add-on, without docstrings and comments, as text; but for what users type."""
    paths = [path for path in ADDON.rglob("*.py") if not {"presets", "other_names.py"} & {*path.parts}]
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in paths]
    for tree in trees:
        for node in ast.walk(tree):
            body = getattr(node, "body", None)
            if isinstance(body, list):  # not the one of a lambda
                node.body = [statement for statement in body if not is_text(statement)] or [ast.Pass()]
    return [ast.unparse(tree) for tree in trees]


def is_text(statement):
    """Whether a statement is a text alone, as docstrings are."""
    return isinstance(statement, ast.Expr) and isinstance(getattr(statement.value, "value", None), str)


@pytest.mark.one_for_each("name")
@pytest.mark.parametrize("name", [program.name for program in PROGRAMS if program.name not in SHARED])
def test_a_program_is_named_in_few_files(name):
    """Its own file, the list of programs, and one more: what others do for it follows from its record. Docstrings may
    refer to its documentation. Longer names (KITTI-360) and endings of files (.nvm) are others.
    """
    word = re.compile(rf"(?<![A-Za-z.]){re.escape(name)}(?![A-Za-z]|-\w)", re.IGNORECASE)
    assert 1 <= sum(bool(word.search(code)) for code in code_of_files()) <= MOST_FILES
