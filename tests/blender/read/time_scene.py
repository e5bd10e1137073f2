"""What tests ask of a scene whose pixels have each their own time: conftest.py builds it."""

import numpy as np

from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast

from .scene_parts import curves

SIZE = 48
PASSES = ("shape_index", "depth", "position", "valid")


def still(scene):
    """The picture that the scene has with one time for all pixels."""
    settings = scene.camera.data.camera_ray_caster
    before, settings.time_mode = settings.time_mode, "NONE"
    images = walked(scene)
    settings.time_mode = before
    return images


def walked(scene, **keywords):
    return cast(read_camera(scene, **keywords), read_shapes(scene), passes=PASSES, dtype=np.float64)


def key(item, path, *values, index=-1):
    """Key a property linearly: (frame, value) pairs."""
    for frame, value in values:
        if index < 0:
            exec(f"item.{path} = value", {"item": item, "value": value})
        else:
            getattr(item, path)[index] = value
        item.keyframe_insert(path, index=index, frame=frame)
    for curve in curves(item):
        curve.extrapolation = "LINEAR"
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def coordinates():
    """x, y (h, w) of the pixels' rays, and the frame of each row (h, 1)."""
    row = np.arange(SIZE) + 0.5
    return (row - SIZE / 2)[None] / 4, (row - SIZE / 2)[:, None] / 4, 1 + 24 * row[:, None] / SIZE


def disc(x, y, center_x, center_y=0.0, radius=1.0):
    """Which pixels are in a disc, and which are within 1e-4 of its edge, where float32 decides."""
    away = np.hypot(x - center_x, y - center_y) - radius
    return away <= 0, np.abs(away) < 1e-4


def same(images, expected, unsure):
    assert np.array_equal(images[~unsure], expected[~unsure])
    assert expected.any()


def gray(blender):
    """An image of 4 x 4 levels."""
    image = blender.data.images.new("Gray", 4, 4, float_buffer=True)
    image.pixels[:] = np.repeat(np.linspace(0, 1, 16), 4).tolist()
    return image


def drive(item, path, index, expression):
    driver = item.driver_add(path, index).driver
    driver.type, driver.expression = "SCRIPTED", expression


def fan(blender, turns):
    """A blade that a driver turns so many times a frame."""
    blender.ops.mesh.primitive_plane_add(size=2)
    blade = blender.context.object
    blade.scale = (2.5, 0.4, 1)
    drive(blade, "rotation_euler", 2, f"frame * {turns * 2 * np.pi!r}")
    return blade
