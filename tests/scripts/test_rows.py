"""cast.py --rows: NPZ files with the top row first, which data sets read as others."""

import json
import runpy

import numpy as np

import camera_ray_caster as crc
from camera_ray_caster.core.sets import read_set

from .running import refused


def test_arrays_with_the_top_row_first_are_those_of_top_down_and_sets_say_so(command, scene, tmp_path):
    words = ("--camera", "Side", "--frame", "1", "--passes", "depth,flow_forward,ray_direction,valid", "--dataset")
    for rows in "bottom", "top":
        assert command("cast", scene, *words, "--rows", rows, "--output", tmp_path / rows).returncode == 0
        (stem,) = (path.stem for path in (tmp_path / rows).glob("*_0001.npz"))
        assert json.loads((tmp_path / rows / f"{stem}.json").read_text())["made"]["rows"] == rows
    for name in stem, f"{stem[:-5]}_rays":
        with np.load(tmp_path / "bottom" / f"{name}.npz") as file, np.load(tmp_path / "top" / f"{name}.npz") as turned:
            expected = crc.top_down(dict(file))
            assert turned.files == list(expected)
            for key, image in expected.items():
                assert np.array_equal(turned[key], image, equal_nan=image.dtype.kind == "f")
                assert key in ("valid", "flow_forward") or not np.array_equal(image, file[key]), "it shows which is up"
    (bottom,), (top,) = (read_set(tmp_path / rows) for rows in ("bottom", "top"))
    ours, theirs = (dict(views(tmp_path / rows))[stem] for rows in ("bottom", "top"))
    for key in "depth", "flow_forward", "valid":
        assert np.array_equal(top.pixels(key), bottom.pixels(key), equal_nan=key == "flow_forward")
        assert np.array_equal(theirs[key], ours[key], equal_nan=key == "flow_forward")
    assert "--rows applies to NPZ files only" in refused(command("cast", scene, "--rows", "top"))


def views(folder):
    """Names and passes of a set, by the reader that was written into it."""
    return ((name, passes) for name, _, passes in runpy.run_path(folder / "reader.py")["views"](folder))
