"""Names of files: of each camera and frame its own, and none that leads elsewhere."""

import pytest

from camera_ray_caster.core.names import file_names, frame_digits
from camera_ray_caster.core.records import InputError


def test_what_no_file_may_be_called_is_replaced():
    names = ["Camera", "Über 3.001", "../up", "a/b\\c:d", ".", "con\n", "end. "]
    assert file_names(names) == {
        "Camera": "Camera", "Über 3.001": "Über 3.001", "../up": "_._up", "a/b\\c:d": "a_b_c_d", ".": "_",
        "con\n": "con_", "end. ": "end",
    }  # fmt: skip


@pytest.mark.parametrize("name", ["CON", "nul", "aux.001", "Com1", "LPT9.x.y", "prn .z"])
def test_devices_of_windows_are_no_names_of_files(name):
    assert file_names([name]) == {name: f"_{name}"}
    assert file_names([f"{name[0]}{name}", "console", "nulls"])["console"] == "console"


@pytest.mark.parametrize("names", [("a/b", "a_b"), ("Left", "left"), ("x", "x "), ("é", "e\u0301"), ("É", "e\u0301")])
def test_two_cameras_never_have_one_file(names):
    with pytest.raises(InputError, match=r"would have the same name.*: rename one of them"):
        file_names(names)


def test_a_name_that_is_given_twice_is_one():
    assert file_names(["Camera", "Camera"]) == {"Camera": "Camera"}


@pytest.mark.parametrize(
    ("frame", "digits"),
    [
        *((1, "0001"), (12345, "12345"), (12.5, "0012.5"), (10, "0010"), (0, "0000")),
        *((-3, "-0003"), (-0.25, "-0000.25"), (-1e-9, "0000")),
    ],
)
def test_frames_have_four_digits_or_more(frame, digits):
    assert frame_digits(frame) == digits
