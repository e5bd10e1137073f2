"""The distortion of movie clips that a camera was tracked from is named, where the camera does not have it."""

import numpy as np
import pytest

from camera_ray_caster.blender.engine.render_evaluation import read_as_rendered
from camera_ray_caster.blender.read.scene_reader import read_camera
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


FOCAL, CENTER, SIZE = 40.0, (15.0, 13.0), (32, 24)
NAMES = "k1", "k2", "k3", "k4", "p1", "p2"


def bent(model, x, y, k1=0.0, k2=0.0, k3=0.0, k4=0.0, p1=0.0, p2=0.0):
    """The pixel, from the lower left corner, of a point at depth 1, by the models' formulas; of Nuke the point."""
    r = x * x + y * y
    if model == "DIVISION":
        return x / (1 + k1 * r + k2 * r * r), y / (1 + k1 * r + k2 * r * r)
    gain = 1 + k1 * r + k2 * r**2 + k3 * r**3 + k4 * r**4
    return (x * gain + p1 * (r + 2 * x * x) + 2 * p2 * x * y, y * gain + p2 * (r + 2 * y * y) + 2 * p1 * x * y)


@pytest.mark.parametrize(
    ("distortion", "terms", "key"),
    [
        ("POLYNOMIAL", {"k1": -0.2, "k2": 0.05, "k3": 0.01}, "OPENCV_PINHOLE"),
        ("DIVISION", {"k1": -0.2, "k2": 0.05}, "OPENCV_PINHOLE"),
        ("NUKE", {"k1": -0.1, "k2": 0.02}, "OCAM"),
        ("BROWN", {"k1": -0.2, "k2": 0.05, "k3": 0.01, "p1": 0.01, "p2": -0.02}, "OPENCV_PINHOLE"),
        ("BROWN", {"k1": -0.2, "k2": 0.05, "k3": 0.01, "k4": 0.02}, "RADIAL_POLYNOMIAL"),
    ],
)
def test_the_lens_of_a_clip_becomes_the_cameras(distortion, terms, key, blender, camera_scene, tmp_path):
    """The formulas are those of Blender: its compositor moves a picture of coordinates by them."""
    (tmp_path / "plate.png").write_bytes(png(np.zeros((SIZE[1], SIZE[0], 3), np.uint8)))
    clip = camera_scene.active_clip = blender.data.movieclips.load(str(tmp_path / "plate.png"))
    lens = clip.tracking.camera
    lens.focal_length_pixels, lens.distortion_model = FOCAL, distortion
    lens.principal_point_pixels = CENTER
    before = "" if distortion == "POLYNOMIAL" else f"{distortion.lower()}_"
    for name in NAMES:
        if hasattr(lens, before + name):
            setattr(lens, before + name, terms.get(name, 0.0))
    assert blender.ops.camera_ray_caster.lens_of_clip() == {"FINISHED"}
    camera = read_camera(camera_scene)
    assert (camera.model.key, camera.model.size) == (key, SIZE)
    x, y = 0.25, -0.15
    if distortion == "NUKE":
        scale = FOCAL / 16  # of the longer side's half
        r = (x * x + y * y) * scale**2
        pixel = (x, y)
        x, y = (value / (1 + terms["k1"] * r + terms["k2"] * r * r) for value in pixel)
    else:
        pixel = bent(distortion, x, y, **terms)
    direction = camera.pose.basis @ (x, y, -1.0)
    expected = [center + FOCAL * value for center, value in zip(CENTER, pixel, strict=True)]
    np.testing.assert_allclose(camera.project(camera.pose.eye + direction), expected, rtol=0, atol=2e-5)  # of float32
    camera_scene.active_clip = None
    with pytest.raises(RuntimeError, match="The scene and the camera have no movie clip"):
        blender.ops.camera_ray_caster.lens_of_clip()
