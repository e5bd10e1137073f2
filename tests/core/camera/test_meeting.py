"""Points in pictures whose pixels have times of their own."""

import numpy as np

from .test_pixel_time import ROWS, camera, moving, shapes


def test_a_camera_at_rest_is_not_searched_for_points(monkeypatch):
    """Though shapes move and many frames are evaluated, a point is projected once; what is seen at no time is NaN."""
    cam, _, motion = moving(lambda f: (camera(ROWS), shapes(((0.1 * (f - 15), 0, -5), 1.2))), 10, 20)
    points = np.random.default_rng(4).uniform(-3, 3, (200, 3)) - [0, 0, 5]
    assert not motion.is_still
    asked, camera_at = [], type(motion).camera_at
    monkeypatch.setattr(type(motion), "camera_at", lambda self, frame: asked.append(frame) or camera_at(self, frame))
    pixels, at_once = cam.project(points), camera({}).project(points)
    assert len(asked) == 1
    seen = (at_once[:, 1] >= 0) & (at_once[:, 1] <= 48)
    assert 0 < seen.sum() < 200
    assert np.array_equal(pixels[seen], at_once[seen])
    assert np.isnan(pixels[~seen]).all()
