"""What the window says that a render shows otherwise."""

import bpy
import pytest

from camera_ray_caster.blender.read.scene_cache import cached_scene

LENS = "Only rays through the center of the lens are shown"


@pytest.mark.parametrize(
    ("mode", "has_lens", "samples", "differences"),
    [
        ("NONE", False, 16, ()),
        (
            "ROWS",
            False,
            16,
            ("Every pixel is shown at frame 5; in a render, each pixel has its own time, from frame 1.024 to 24.98",),
        ),
        ("NONE", True, 16, (f"{LENS}; a render with 16 samples has depth of field",)),
        ("NONE", True, 1, (f"{LENS}, as in a render with 1 sample",)),
    ],
)
def test_it_says_where_a_render_differs(camera_scene, mode, has_lens, samples, differences):
    camera = camera_scene.camera.data
    camera_scene.frame_set(5)
    camera_scene.render.resolution_y = 500  # the middles of the first and the last row are 0.024 from frames 1 and 25
    camera.camera_ray_caster.time_mode, camera.dof.use_dof = mode, has_lens
    camera_scene.camera_ray_caster.samples = samples
    cached = cached_scene(bpy.context)
    assert cached.differences == differences
    assert cached.camera.pixel_time is None
