"""Lamps that project pictures: a wall that Cycles lights shows the place that the camera's own projection gives."""

import numpy as np
import pytest

from camera_ray_caster import InputError, cast, read_camera, read_shapes
from camera_ray_caster.blender.cycles import add_projector

SIZE, WALL, FAR = 48, 6.0, 1.5


@pytest.fixture
def ramp(blender):
    """A picture whose red and green are the place across and up, and whose blue is 1."""
    image = blender.data.images.new("Ramp", 640, 480, float_buffer=True, is_data=True)
    x, y = np.meshgrid((np.arange(640) + 0.5) / 640, (np.arange(480) + 0.5) / 480)
    image.pixels.foreach_set(np.dstack((x, y, np.ones_like(x), np.ones_like(x))).astype(np.float32).ravel())
    return image


def lit(blender, scene, tmp_path):
    """What Cycles shows of a wall before the projector, (SIZE, SIZE, 3), and its points."""
    camera = blender.data.objects.new("Seeing", blender.data.cameras.new("Seeing"))
    scene.collection.objects.link(camera)
    blender.ops.mesh.primitive_plane_add(size=WALL, location=(0, 0, -FAR))
    camera.data.type, camera.data.ortho_scale = "ORTHO", WALL
    render, cycles, scene_camera = scene.render, scene.cycles, scene.camera
    scene.camera, render.engine, cycles.samples, cycles.use_denoising = camera, "CYCLES", 1, False
    cycles.max_bounces, cycles.filter_width, cycles.pixel_filter_type = 0, 0.01, "BLACKMAN_HARRIS"
    sizes = render.resolution_x, render.resolution_y
    render.resolution_x = render.resolution_y = SIZE
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = str(tmp_path / "lit.exr")
    blender.ops.render.render(write_still=True)
    scene.camera, (render.resolution_x, render.resolution_y) = scene_camera, sizes
    image = blender.data.images.load(render.filepath)
    pixels = np.array(image.pixels[:]).reshape(SIZE, SIZE, 4)[..., :3]
    at = (np.arange(SIZE) + 0.5) / SIZE * WALL - WALL / 2
    x, y = np.meshgrid(at, at)
    return pixels, np.stack((x, y, np.full_like(x, -FAR)), axis=-1)


@pytest.mark.parametrize("model", ["PERSP", "DOME_MASTER", "CYLINDRICAL", "OCAM"])
def test_a_wall_shows_the_picture_where_the_inverse_says(blender, camera_scene, ramp, tmp_path, model):
    scene, item = camera_scene, camera_scene.camera
    item.location, item.rotation_euler = (0.1, -0.2, 0), (0.1, 0.2, 0.3)
    if model != "PERSP":
        item.data.camera_ray_caster.model = model
    scene.render.resolution_x, scene.render.resolution_y = 640, 480
    blender.context.view_layer.update()
    lamp, error = add_projector(scene, image=ramp)
    assert error <= 0.05
    blender.context.view_layer.update()
    pixels, points = lit(blender, scene, tmp_path)
    size = np.array((640, 480))
    wanted = read_camera(scene).project(points)
    inside = ((wanted > 2) & (wanted < size - 2)).all(axis=-1)
    outside = (~np.isfinite(wanted) | (wanted < -2) | (wanted > size + 2)).any(axis=-1)
    bright = pixels[..., 2] > 0
    assert inside.sum() > 50
    assert bright[inside].mean() > 0.99  # the seam and the poles of a panorama are dark
    assert not bright[outside].any()
    both = inside & bright
    shown = pixels[both][:, :2] / pixels[both][:, 2:] * size
    assert np.abs(shown - wanted[both]).max() < error + 0.01  # and Cycles' float32
    assert lamp.parent == item


def test_many_origins_are_refused(camera_scene):
    camera_scene.camera.data.camera_ray_caster.model = "GENERAL_LINEAR"
    with pytest.raises(InputError, match="no single viewpoint"):
        add_projector(camera_scene)
    assert not camera_scene.objects.get("Camera Projector")


def test_the_button_adds_and_selects_the_lamp(blender, camera_scene):
    camera_scene.camera.data.camera_ray_caster.model = "DOME_MASTER"
    assert blender.ops.camera_ray_caster.add_projector() == {"FINISHED"}
    lamp = blender.context.object
    assert (lamp.type, lamp.parent, lamp.select_get()) == ("LIGHT", camera_scene.camera, True)
    cast(
        read_camera(camera_scene), read_shapes(camera_scene), passes=("combined",)
    )  # its nodes are noted, and end nothing
    blender.ops.camera_ray_caster.add_projector()
    assert len([item for item in camera_scene.objects if item.type == "LIGHT"]) == 2
