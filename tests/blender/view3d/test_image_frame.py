"""Where the camera's pixels are in an Image Editor, by hand: tests/gui clicks on them in a window."""

from types import SimpleNamespace

import numpy as np
import pytest

from camera_ray_caster.blender.output import images
from camera_ray_caster.blender.view3d.camera_frame import image_frame
from camera_ray_caster.core.records import Raster

ZOOM, LEFT, BOTTOM = 3.0, -70.0, 25.0
"""Pixels of the region to one of the image, and where in the region its bottom left corner is."""


def editor(image):
    """What an Image Editor tells of itself that shows this image."""

    def region_to_view(x, y):
        return (x - LEFT) / (ZOOM * image.size[0]), (y - BOTTOM) / (ZOOM * image.size[1])

    view2d = SimpleNamespace(region_to_view=region_to_view)
    return SimpleNamespace(space_data=SimpleNamespace(image=image), region=SimpleNamespace(view2d=view2d))


@pytest.mark.parametrize(
    ("size", "expected"),
    [
        ((40, 30), (LEFT, BOTTOM, LEFT + 120, BOTTOM + 90)),
        ((20, 12), (LEFT - 15, BOTTOM - 21, LEFT + 105, BOTTOM + 69)),  # the window alone, which starts at 5, 7
        ((80, 60), (LEFT, BOTTOM, LEFT + 240, BOTTOM + 180)),  # cast at twice the resolution
    ],
)
def test_the_frame_is_where_the_image_has_it(blender, size, expected):
    raster = Raster(width=40, height=30, pixel_aspect=1.0, x0=5, y0=7, x1=25, y1=19)
    image = blender.data.images.new(images.image_name("depth"), *size, float_buffer=True)
    np.testing.assert_allclose(image_frame(editor(image), raster), expected, rtol=0, atol=1e-9)


def test_other_images_have_no_frame(blender):
    raster = Raster(width=8, height=8, pixel_aspect=1.0, x0=0, y0=0, x1=8, y1=8)
    assert image_frame(editor(None), raster) is None
    assert image_frame(editor(blender.data.images.new("Wood", 8, 8)), raster) is None
    shown = blender.data.images.new(images.VIEW, 8, 8)
    assert image_frame(editor(shown), raster) is not None
