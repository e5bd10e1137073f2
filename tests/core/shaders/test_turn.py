"""Pictures that Cycles renders turned: its rolling shutter gives every pixel its time, and they come back upright."""

import numpy as np
import pytest

from camera_ray_caster.core.shaders.turn import Turn, shutter_of

from ..cameras.model_examples import camera

CLOCKS = [("ROWS", 1, 9), ("ROWS", 9, 1), ("COLUMNS", -3, 4.5), ("COLUMNS", 4.5, -3)]
BORDER = {"use_border": True, "border_min_x": 0.1, "border_max_x": 0.55, "border_min_y": 0.3}

EFFORT = {"time_tolerance": 0.1, "time_evaluations": 4}


@pytest.mark.parametrize(("mode", "start", "end"), CLOCKS)
@pytest.mark.parametrize("settings", [{}, BORDER], ids=["frame", "border"])
def test_every_pixel_has_its_time_and_comes_back_to_its_place(mode, start, end, settings):
    cam = camera("PERSP", {"time_mode": mode, "time_start": start, "time_end": end} | EFFORT | settings)
    turn = Turn.of(cam.pixel_time)
    begin, frames = shutter_of(cam.pixel_time, cam.raster)
    theirs = turn.raster(cam.raster)
    row = np.arange(theirs.y0, theirs.y1)[:, None] + np.zeros(theirs.shape)
    time = begin + frames * (theirs.height - row) / theirs.height  # the rule of Cycles, type Top-Bottom
    expected = np.broadcast_to(cam.pixel_time.frame_at(cam.raster.columns(), cam.raster.rows()), cam.raster.shape)
    np.testing.assert_allclose(turn.back(time), expected, atol=1e-12)
    # the shader's place of each of Cycles' pixels is that of our pixel
    place = theirs.columns() / theirs.width + 0 * row, theirs.rows() / theirs.height + 0 * row
    x, y = (eval(text, {"place": place}) for text in turn.places)
    ours = cam.raster.columns() / cam.raster.width, cam.raster.rows() / cam.raster.height
    np.testing.assert_allclose(turn.back(x), np.broadcast_to(ours[0], cam.raster.shape), atol=1e-15)
    np.testing.assert_allclose(turn.back(y), np.broadcast_to(ours[1], cam.raster.shape), atol=1e-15)
