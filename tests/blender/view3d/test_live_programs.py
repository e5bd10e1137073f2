"""The programs of a live view, drawn without a window: the rays of every model, and a warp of known faces."""

import gpu
import numpy as np
import pytest

from camera_ray_caster import InputError, camera
from camera_ray_caster.blender.faces.driver import check_driver
from camera_ray_caster.blender.view3d.live_programs import draw_map, draw_warp, forget, map_texture
from camera_ray_caster.core.faces.faces import faces_of, refusal, turn_of
from camera_ray_caster.core.faces.resample import resampled
from camera_ray_caster.core.maths.recording import NotRecordable
from camera_ray_caster.core.shaders.ray_map import ray_map
from camera_ray_caster.core.web.page import example, page_models

CENTRAL = [model for model in page_models() if not refusal(example(model))]
ERROR = 2e-4
"""Of a direction, in radians: float32 at the rim of a mirror ball; a tenth of a pixel of the window."""


@pytest.fixture
def drawing(blender):
    """Blender's gpu module without a window."""
    try:
        check_driver("A live view")
    except InputError as error:
        pytest.skip(str(error))
    if hasattr(gpu, "init"):
        gpu.init()
    # before 5.2 a render makes the context; in 5.2 it is the current one again after a render of another engine
    render = blender.context.scene.render
    render.engine, render.resolution_x, render.resolution_y = "BLENDER_WORKBENCH", 8, 8
    blender.ops.object.camera_add()
    blender.context.scene.camera = blender.context.object
    blender.ops.render.render()
    yield
    forget()


def read(target, channels=4):
    """The pixels of an offscreen buffer, (rows, columns, channels)."""
    buffer = target.texture_color.read()
    return np.array(buffer.to_list(), np.float32).reshape(target.height, target.width, channels)


def to_texels(face):
    """Unit directions to the middles of a face's texels, (height, width, 3)."""
    left, right, bottom, top = face.window
    x, y = ((np.arange(side) + 0.5) / side for side in face.size)
    x, y = np.meshgrid(left + x * (right - left), bottom + y * (top - bottom))
    directions = np.stack((x, y, -np.ones_like(x)), axis=-1) @ face.axes
    return directions / np.linalg.norm(directions, axis=-1, keepdims=True)


@pytest.mark.parametrize("model", CENTRAL, ids=lambda model: model.key)
def test_the_text_has_the_rays_of_numpy(drawing, model):
    lens = example(model)
    width, height = lens.raster.size
    size = 96, round(96 * height / width)
    try:
        made = ray_map(lens.model)
    except NotRecordable:
        pytest.fail("it cannot be written in GLSL")
    target = gpu.types.GPUOffScreen(*size, format="RGBA32F")
    draw_map(target, made, (0, 0, *size), lens.raster.size)
    drawn = read(target)
    x = (np.arange(size[0]) + 0.5) * width / size[0]
    y = (np.arange(size[1]) + 0.5)[:, None] * height / size[1]
    rays = lens.rays_at(x, y)
    assert ((drawn[..., 3] > 0.5) != rays.valid).mean() < 0.002  # at the very rim float32 may decide otherwise
    both = (drawn[..., 3] > 0.5) & rays.valid
    directions = drawn[both][:, :3] / np.linalg.norm(drawn[both][:, :3], axis=1, keepdims=True)
    assert np.abs(directions - rays.directions[both] @ lens.pose.basis).max() < ERROR


def test_a_program_serves_other_settings_of_its_model():
    texts = {ray_map(camera("DOME_MASTER", (300, 200), fov=fov).model).text for fov in (2.5, 3.0, 3.1)}
    assert len(texts) == 1


def test_the_warp_is_that_of_numpy(drawing):
    lens = camera("FISHEYE_EQUISOLID", (64, 64))
    faces = faces_of(lens)
    pictures = [np.append(0.5 + 0.4 * to_texels(face), np.ones((*face.size[::-1], 1)), axis=-1).astype(np.float32)
                for face in faces]  # fmt: skip
    target, rays = gpu.types.GPUOffScreen(64, 64, format="RGBA32F"), lens.rays()
    local = np.append(rays.directions @ lens.pose.basis, np.ones((64, 64, 1)), axis=-1)
    directions = map_texture(np.where(rays.valid[..., None], local, 0.0).astype(np.float32))
    ground, outside = np.array([0.9, 0.8, 0.7]), np.array([0.1, 0.2, 0.3])
    with target.bind():
        draw_warp(directions, [map_texture(picture) for picture in pictures], faces, turn_of(lens).T @ lens.pose.basis,
                  (ground, outside), (8, 0, 64, 64), False)  # fmt: skip
    drawn, expected = read(target)[..., :3], resampled(lens, faces, pictures)
    inner = rays.valid.copy()
    inner[:, :8] = False
    for shift in ((1, 0), (-1, 0), (0, 1), (0, -1)):  # beyond the rim there is nothing to be interpolated
        inner &= np.roll(rays.valid, shift, axis=(0, 1))
    assert np.abs(drawn - expected[..., :3])[inner].max() < 2e-3  # the four places differ where the map is curved
    assert drawn[:, 8:][~rays.valid[:, 8:]] == pytest.approx(np.tile(ground, (np.sum(~rays.valid[:, 8:]), 1)), abs=1e-6)
    assert drawn[:, :8] == pytest.approx(np.tile(outside, (64, 8, 1)), abs=1e-6)
