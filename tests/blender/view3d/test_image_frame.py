"""Where the camera's pixels are in an Image Editor, by hand: tests/gui clicks on them in a window."""

from types import SimpleNamespace

import numpy as np
import pytest

from camera_ray_caster.blender.output import image_datablocks
from camera_ray_caster.blender.view3d.camera_frame import image_frame
from camera_ray_caster.core.records import Raster

ZOOM, LEFT, BOTTOM = 3.0, -70.0, 25.0
"""Pixels of the region to one of the image, and where in the region its bottom left corner is."""


def editor(image, size=None, crops=False):
    """What an Image Editor tells of itself that shows this image; ``crops``: renders are of the border alone."""
    width, height = size or image.size if image else (1, 1)

    def region_to_view(x, y):
        return (x - LEFT) / (ZOOM * width), (y - BOTTOM) / (ZOOM * height)

    view2d = SimpleNamespace(region_to_view=region_to_view)
    scene = SimpleNamespace(render=SimpleNamespace(use_crop_to_border=crops))
    space_data, region = SimpleNamespace(image=image), SimpleNamespace(view2d=view2d)
    return SimpleNamespace(scene=scene, space_data=space_data, region=region)


RASTER = Raster(width=40, height=30, pixel_aspect=1.0, x0=5, y0=7, x1=25, y1=19)
WHOLE = LEFT, BOTTOM, LEFT + 120, BOTTOM + 90
WINDOW = LEFT - 15, BOTTOM - 21, LEFT + 105, BOTTOM + 69
"""Where the frame is around an image of the window alone, which starts at 5, 7."""


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ((40, 30), WHOLE),
        ((20, 12), WINDOW),
        ((80, 60), (LEFT, BOTTOM, LEFT + 240, BOTTOM + 180)),  # cast at twice the resolution
    ],
)
def test_the_frame_is_where_the_image_has_it(blender, size, expected):
    image = blender.data.images.new(image_datablocks.image_name("depth"), *size, float_buffer=True)
    np.testing.assert_allclose(image_frame(editor(image), RASTER), expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize(("crops", "size", "expected"), [(False, (40, 30), WHOLE), (True, (20, 12), WINDOW)])
def test_the_frame_of_a_render_is_where_the_scene_has_it(blender, camera_scene, crops, size, expected):
    camera_scene.render.engine = "CAMERA_RAY_CASTER"
    blender.ops.render.render()
    image = blender.data.images["Render Result"]
    assert tuple(image.size) == (0, 0)
    np.testing.assert_allclose(image_frame(editor(image, size, crops), RASTER), expected, rtol=0, atol=1e-9)


def test_other_images_have_no_frame(blender):
    assert image_frame(editor(None), RASTER) is None
    assert image_frame(editor(blender.data.images.new("Wood", 8, 8)), RASTER) is None
    shown = blender.data.images.new(image_datablocks.VIEW, 8, 8)
    assert image_frame(editor(shown), RASTER) is not None
