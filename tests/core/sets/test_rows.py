"""Sets whose files of passes have the top row first."""

import json

import numpy as np

import camera_ray_caster as crc
from camera_ray_caster.core.sets import read_set
from camera_ray_caster.core.sets.recast import with_meshes

from .test_sets import SHAPES, view


def test_views_cast_anew_have_their_rows_as_those_of_the_file(tmp_path):
    depths = []
    for rows in "bottom", "top":
        folder = tmp_path / rows
        folder.mkdir()
        view(folder, 1)
        report, passes = folder / "PERSP_0001.json", folder / "PERSP_0001.npz"
        facts = json.loads(report.read_text())
        facts["made"]["rows"], facts["exact"] = rows, ["Ball"]
        report.write_text(json.dumps(facts))
        if rows == "top":
            np.savez(passes, **crc.top_down(dict(np.load(passes))))
        (of_file,) = read_set(folder)
        (cast_anew,) = with_meshes([of_file], lambda frame: SHAPES)
        depths += [of_file.planar_depth(), cast_anew.planar_depth()]
    assert not np.array_equal(depths[0], depths[0][::-1])
    for depth in depths[1:]:
        np.testing.assert_allclose(depth, depths[0], rtol=1e-6)  # float32 in the file
