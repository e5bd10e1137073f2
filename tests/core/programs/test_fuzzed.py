"""Files that were cut off, doubled, or had their numbers and kinds changed: each is a lens, or refused in one line."""

import random
import re
from time import thread_time

import pytest

from camera_ray_caster.core.programs.reading.lenses import lenses_of
from camera_ray_caster.core.records import InputError

from .test_formats import SAID
from .test_other_programs import FILES

TEXTS = [text for _, text, *_ in SAID] + [text for text, *_ in FILES.values()]
XML = """<?xml version="1.0"?>
<opencv_storage>
<image_width>640</image_width><image_height>480</image_height>
<K type_id="opencv-matrix"><rows>3</rows><cols>3</cols><dt>d</dt><data>300 0 320.5 0 301 239.25 0 0 1</data></K>
<D type_id="opencv-matrix"><rows>1</rows><cols>5</cols><dt>d</dt><data>-0.1 0.02 0.001 -0.002 0.</data></D>
</opencv_storage>
"""
TEXTS += [XML]
WORDS = "nan", ".nan", "1e999", "-1", "0", "true", "null", '"x"', "[]", "{}", "[1, [2]]", '{"a": 1}', "9" * 400, "", "~"
LONG = 10 << 20
"""Characters of a line."""


def changed(chance, text):
    """A text with one change."""
    kind = chance.randrange(5)
    if kind == 0:
        return text[: chance.randrange(len(text))]
    if kind == 1:
        return text + chance.choice(("", "\n", "---\n")) + text
    if kind == 2:
        words = re.findall(r"-?\d[\d.e+-]*", text)
        return text.replace(chance.choice(words), chance.choice(WORDS), chance.choice((1, 99)))
    if kind == 3:
        lines = text.splitlines(keepends=True)
        lines.insert(chance.randrange(len(lines)), chance.choice(lines))
        return "".join(lines)
    where = chance.randrange(len(text))
    return text[:where] + chance.choice("[]{}:,-'\"!&*#|>%<>\\\n\t \0") + text[where + chance.randrange(2) :]


def assert_read_or_refused(path, content):
    path.write_bytes(content)
    begin, message = thread_time(), ""
    try:
        lenses = lenses_of(str(path), "", (640, 480))
        assert lenses or b"[]" in content  # a list of cameras may be empty
    except InputError as refusal:
        message = str(refusal)
    assert thread_time() - begin < 5
    assert "\n" not in message
    assert len(message) < 1000


@pytest.mark.parametrize("seed", [0, *(pytest.param(seed, marks=pytest.mark.full) for seed in range(1, 40))])
def test_a_changed_file_is_read_or_refused_in_one_line(tmp_path, seed):
    chance = random.Random(seed)
    for text in TEXTS:
        assert_read_or_refused(tmp_path / "lens", changed(chance, text).encode())


@pytest.mark.full
@pytest.mark.parametrize("piece", ["1, ", "[", "a: 1 ", '"', "'", "# ", "<a>", "//", "- ", "0", '{"a":', "\0", "x:"])
def test_a_line_of_ten_megabytes_ends_within_five_seconds(tmp_path, piece):
    assert_read_or_refused(tmp_path / "lens", (piece * (LONG // len(piece))).encode())


@pytest.mark.full
@pytest.mark.parametrize("begin", ["K: [", '{"K": [', "<opencv_storage><K>", "1 PINHOLE ", "{'LENSMODEL_': ["])
def test_a_long_line_of_each_format_ends_within_five_seconds(tmp_path, begin):
    assert_read_or_refused(tmp_path / "lens", (begin + "1, " * (LONG // 3)).encode())
