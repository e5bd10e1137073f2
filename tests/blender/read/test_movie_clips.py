"""The distortion of movie clips that a camera was tracked from is named, where the camera does not have it."""

import numpy as np

from camera_ray_caster.blender.engine.reading import read_as_rendered
from camera_ray_caster.core.sets.png import png


def test_the_distortion_of_a_clip_is_named(blender, camera_scene, tmp_path):
    (tmp_path / "plate.png").write_bytes(png(np.zeros((24, 32, 3), np.uint8)))

    def noted():
        return [note for name, note in read_as_rendered(camera_scene).shapes.notes if name == "plate.png"]

    clip, data = blender.data.movieclips.load(str(tmp_path / "plate.png")), camera_scene.camera.data
    lens = clip.tracking.camera
    shown = data.background_images.new()
    shown.source, shown.clip = "MOVIE_CLIP", clip
    assert not noted()
    lens.distortion_model, lens.k1, lens.k2 = "POLYNOMIAL", -0.2, 0.05
    (note,) = noted()
    assert f"(Polynomial, k1 = -0.2, k2 = 0.05), and camera '{camera_scene.camera.name}' casts without" in note
    lens.distortion_model, lens.brown_p2 = "BROWN", 0.01
    data.background_images.clear()
    assert not noted()
    camera_scene.active_clip = clip
    assert "(Brown, p2 = 0.01)" in noted()[0]
    data.camera_ray_caster.model = "OPENCV_PINHOLE"
    assert not noted()
