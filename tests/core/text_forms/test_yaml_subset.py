"""YAML as calibration tools write it: OpenCV's, Kalibr's, ROS's; and texts that would take a careless reader hours."""

import gzip
import os

import pytest
import yaml

from camera_ray_caster.core.records import InputError
from camera_ray_caster.core.text_forms import content
from camera_ray_caster.core.text_forms.content import content_of, decoded, entries_of
from camera_ray_caster.core.text_forms.yaml_subset import DEEPEST, YamlError, parse

MEGABYTE = 1 << 20


def text_of(path):
    """The text of a file."""
    return decoded(content_of(path), path)


KALIBR = """cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07,
    1.9e-04, 1.7e-05]   # k1 k2 p1 p2
  distortion_model: radtan
  T_cn_cnm1:
  - [1.0, 0.0]
  - [0.0, 1.0]
  rostopic: "/cam0/image_raw # not a comment"
cam1:
  resolution: [752, 480]
"""

ROS = """image_width: 640
camera_name: 'narrow: stereo'
camera_matrix:
  rows: 3
  cols: 3
  data: [ 438.783367, 0.000000, 305.593336,
          0.000000, 437.302876, 243.738352,
          0.000000, 0.000000, 1.000000]
tags: {pose: here, list: [a, b]}
points:
- x: 1
  y: 2
- x: 3
"""


def test_kalibrs_camera_chains():
    assert parse(KALIBR) == {
        "cam0": {
            "cam_overlaps": ["1"],
            "camera_model": "pinhole",
            "distortion_coeffs": ["-0.28", "0.07", "1.9e-04", "1.7e-05"],
            "distortion_model": "radtan",
            "T_cn_cnm1": [["1.0", "0.0"], ["0.0", "1.0"]],
            "rostopic": "/cam0/image_raw # not a comment",
        },
        "cam1": {"resolution": ["752", "480"]},
    }


def test_roses_camera_info():
    parsed = parse(ROS)
    assert parsed["camera_name"] == "narrow: stereo"
    assert parsed["camera_matrix"]["data"][5] == "243.738352"
    assert parsed["tags"] == {"pose": "here", "list": ["a", "b"]}
    assert parsed["points"] == [{"x": "1", "y": "2"}, {"x": "3"}]


@pytest.mark.parametrize("indent", ["", "  "])
def test_nested_lists_as_yaml_dump_writes_them(indent):
    lines = "- - 300.0", "  - 0.0", "- - 0.0", "  - -301.0", "-   - k: 1", "      m: 2"
    rows = "".join(f"{indent}{line}\n" for line in lines)
    nested = [["300.0", "0.0"], ["0.0", "-301.0"], [{"k": "1", "m": "2"}]]
    assert parse(f"K:\n{rows}width: 640\n") == {"K": nested, "width": "640"}


def test_tags_directives_and_values_that_are_missing():
    text = '%YAML:1.0\n---\nK: !!opencv-matrix\n   rows: 3\nname:\nnone: ""\n...'
    assert parse(text) == {"K": {"rows": "3"}, "name": "", "none": ""}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("just words", "line 1 is not an entry"),
        ("a: 1\n   b: 2", "line 2 has an indentation"),
        ("a: [1, 2", "line 1 opens a bracket that is not closed"),
        ("a: [1, 2}", "line 1 has a closing bracket without a matching opening bracket"),
        ("a: {1}", "line 1 has a value without a name"),
        ("a: |\n  text", "line 1 has a value that is not read"),
        ("a: " + "[" * (DEEPEST + 1), "nested deeper"),
        ("".join(f"{' ' * k}a:\n" for k in range(DEEPEST + 1)), "nested deeper"),
        ("a:\n" + "- " * (DEEPEST + 1), "nested deeper"),
        ("a: 1\n- 1", "line 2 has an indentation"),
    ],
)
def test_what_is_not_read_is_refused_with_its_line(text, says):
    with pytest.raises(YamlError, match=says):
        parse(text)


@pytest.mark.parametrize(
    "piece",
    [
        "a:\n ", "#", " #\n", "\n", '"', '\\"', "[", "a: [", "-\n", "data: [1,\n", "// ", "{", '{"a":', "'", "x: 1\n",
        "a.b-c", "- ", "x:\n - - - ",
    ],
)  # fmt: skip
def test_no_text_takes_more_than_linear_time(tmp_path, piece):
    """A quarter of a megabyte after each beginning: what takes the square of it would not end today."""
    path = tmp_path / "lens.yml"
    for begin in ("", '{"a": ', "K: [", '{"'):
        path.write_text((begin + piece * MEGABYTE)[: MEGABYTE // 4])
        message = ""
        try:
            entries_of(text_of(str(path)), "lens")
        except InputError as error:
            message = str(error)
        assert "\n" not in message
        assert len(message) < 500


def test_a_name_of_json_that_is_there_twice_is_found_in_linear_time():
    """To compare each of these names with each other would take minutes."""
    text = "{" + "".join(f'"a{k:05x}":0,' for k in range(80_000)) + '"zz":0,"zz":1}'
    with pytest.raises(InputError, match="it has 'zz' twice"):
        entries_of(text, "lens")


def test_a_path_that_no_report_can_name_is_refused(tmp_path):
    path = os.fsdecode(os.fsencode(tmp_path) + b"/lens\xff.yml")
    with open(path, "w") as file:
        file.write("a: 1")
    with pytest.raises(InputError, match=r"lens.udcff.yml' cannot be read: its path is not UTF-8"):
        text_of(path)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (b'{"K": ' + b"9" * 5000 + b"}", None),
        (b'{"K": ' + b"[" * 100_000 + b"}", "nested too deeply"),
        (b"\xff\xfe\x00", "not a text file"),
        (b"", "is empty"),
        (b"{}", "is empty"),
    ],
)
def test_files_that_break_careless_readers(tmp_path, text, says):
    path = tmp_path / "lens.json"
    path.write_bytes(text)
    if says is None:
        assert entries_of(text_of(str(path)), "lens") == {"K": float("inf")}
    else:
        with pytest.raises(InputError, match=says):
            entries_of(text_of(str(path)), "lens")


@pytest.mark.parametrize("packed", [False, True])
def test_a_file_that_takes_too_much_memory_is_refused_before_it_is_read(tmp_path, monkeypatch, packed):
    monkeypatch.setattr(content, "LARGEST", 2 * MEGABYTE)
    path = tmp_path / "lens.json"
    with (gzip.open if packed else open)(path, "wb") as file:
        file.write(bytes(2 * MEGABYTE + 1))
    with pytest.raises(InputError, match="larger than 2 MB"):
        text_of(str(path))


def test_reading_ends_when_its_time_is_over(monkeypatch):
    monkeypatch.setattr(content, "LONGEST_READING", 0.0)
    for text in ("a: 1\nb: 2\n", "<opencv_storage><a>1</a></opencv_storage>", "a: [1, 2]"):
        with pytest.raises(InputError, match="'lens' takes longer than 0 s to read: is it a calibration"):
            entries_of(text, "lens")


@pytest.mark.parametrize(
    "text",
    [
        "a:\n  [1, 2,\n   3]\nb:\n    {c: 1, d: [2]}\n", "a:\n  word\nb:\n - c:\n     [1]\n - 2\n",
        "- a: 1\n- [2, 3]\n- x\n",
        "0:\n  cam_K: [1.5, 0.0]\n'a b': 1\n\"c\": 2\nd e: 3\n", "a: 'it # is'\nb: x#y # z\nc: \"#\"\n",
        "cameras:\n     - {T_SC:\n        [1, 0,\n         1],\n        size: [752, 480], kind: x}\n     - {T: [2]}\n",
        *(KALIBR, ROS),
    ],
)  # fmt: skip
def test_the_subset_is_read_as_pyyaml_reads_it(text):
    assert parse(text) == yaml.load(text, yaml.BaseLoader)


def test_what_is_no_file_is_not_waited_for():
    with pytest.raises(InputError, match="it is a device, not a file"):
        entries_of(text_of("/dev/zero"), "lens")
    with pytest.raises(InputError, match="cannot be read"):
        entries_of(text_of("a\0b"), "lens")


def test_a_gzip_file_is_whole_or_refused(tmp_path):
    """Several members are one file, as for gunzip, and zeros may follow; a file that is cut off anywhere is refused."""
    path, first, second = tmp_path / "lens.gz", gzip.compress(b"a: 1\n"), gzip.compress(b"b: 2\n" * 50)
    for more in (b"", bytes(9)):
        path.write_bytes(first + second + more)
        assert text_of(str(path)) == "a: 1\n" + "b: 2\n" * 50
    for cut in range(3, len(first + second)):
        if cut != len(first):
            path.write_bytes((first + second)[:cut])
            with pytest.raises(InputError, match="damaged or cut off"):
                text_of(str(path))


@pytest.mark.parametrize(
    "text", ["[" + "1," * 100_000 + "1]", " [[" + "2.5," * 9 + "1], [3]]", "[" + "{}," * 300_000 + "{}]"]
)
def test_a_list_without_names_is_refused_at_once(text):
    with pytest.raises(InputError, match="list of"):
        entries_of(text, "lens")
