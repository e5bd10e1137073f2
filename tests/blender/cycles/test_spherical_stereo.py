"""Blender's spherical stereo: rays begin and go where those of Cycles do, and the same pixels have none."""

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.core.conventions import EPS32

from .cycles import cycles_surface
from .test_panoramas import TYPES

MERGED = {"use_pole_merge": True, "pole_merge_angle_from": 0.2, "pole_merge_angle_to": 0.7}
MODES = {
    "toe-in, left": {"convergence_mode": "TOE", "pivot": "LEFT"},
    "off-axis, merged": {"convergence_mode": "OFFAXIS", "pivot": "RIGHT"} | MERGED,
    "parallel, merged": {"convergence_mode": "PARALLEL", "pivot": "CENTER"} | MERGED,
    "parallel": {"convergence_mode": "PARALLEL", "pivot": "CENTER"},
}
SIDES = 9.0, 24.0
"""Of the boxes around the camera on which a ray is seen twice."""


@pytest.fixture(params=["PERSP", *TYPES])
def scene(blender, request):
    """A turned, scaled and shifted camera of each type."""
    bpy = blender
    bpy.ops.object.camera_add(location=(0.5, -1, 6), rotation=(0.9, 0.2, 0.3), scale=(2, 1, 0.5))
    scene = bpy.context.scene
    scene.camera = bpy.context.object
    data = scene.camera.data
    data.type = "PERSP" if request.param == "PERSP" else "PANO"
    if data.type == "PANO":
        (data if hasattr(data, "panorama_type") else data.cycles).panorama_type = request.param
    data.lens, data.shift_x = 14.0, 0.1
    data.stereo.use_spherical_stereo = True
    data.stereo.interocular_distance, data.stereo.convergence_distance = 0.6, 3.5
    scene.render.resolution_x, scene.render.resolution_y = 25, 18
    scene.render.use_multiview = True
    return scene


@pytest.mark.parametrize("mode", MODES)
def test_rays_are_those_of_cycles(blender, scene, mode):
    """What Cycles meets of two boxes, one in the other, lies on our rays."""
    for name, value in MODES[mode].items():
        setattr(scene.camera.data.stereo, name, value)
    cameras = {view: read_camera(scene, view=view) for view in ("left", "right")}
    for side in SIDES:
        blender.ops.mesh.primitive_cube_add(size=side, location=(1, -1, 5.5), rotation=(0.1, 0.2, 0.3))
        for view, camera in cameras.items():
            for render_view in scene.render.views:
                render_view.use, render_view.file_suffix = render_view.name == view, ""
            surface = cycles_surface(scene, "Position", 32.0)
            rays = camera.rays()
            assert (rays.valid == ~np.isnan(surface[..., 0])).all()
            surface, rays = surface[rays.valid], camera.rays_at(*pixels_of(camera))
            beside = np.linalg.norm(np.cross(surface - rays.origins, rays.directions), axis=-1)
            assert (beside <= bound(camera, surface)).all()
            far = np.cross(surface - camera.pose.eye, rays.directions)
            assert np.quantile(np.linalg.norm(far, axis=-1), 0.6) > 0.05  # the eye is 0.3 beside: the test would see it
            back = camera.project(surface)
            assert np.abs(back - np.stack(pixels_of(camera), axis=-1)).max() <= 3e-4
        blender.data.objects.remove(blender.context.object)


def pixels_of(camera):
    """The x and y of the pixel centers that have a ray."""
    valid = camera.rays().valid
    x, y = np.broadcast_arrays(camera.raster.columns(), camera.raster.rows())
    return x[valid], y[valid]


def bound(camera, positions):
    """How far beside a ray Cycles may meet something: 32 operations of the origin, of places of 16 and of a witness of
    64, and for the direction 1e-4 pixels: what float32 takes from a place in the picture.
    """
    x, y = pixels_of(camera)
    here = camera.rays_at(x, y).directions
    turned = [np.linalg.norm(camera.rays_at(x + u, y + v).directions - here, axis=-1) for u, v in np.eye(2) * 2.0**-8]
    distance = np.linalg.norm(positions - camera.pose.eye, axis=-1)
    return (32 * 16 + 64) * EPS32 + distance * 1e-4 * 2.0**8 * np.nan_to_num(np.maximum(*turned), nan=1.0)


def sides(ahead, model):
    """The unit vectors to the right of directions in the camera's frame."""
    upright, tilted = (np.eye(3) if turn is None else np.array(turn) for turn in (model.upright, model.tilted))
    side = np.cross(ahead @ upright.T, (0, 1, 0))
    return side / np.linalg.norm(side, axis=-1, keepdims=True) @ tilted.T


@pytest.mark.parametrize("view", ["left", "right"])
def test_the_eye_is_beside_a_ray_that_has_passed_the_lens(blender, scene, view):
    """Of Cycles' rays the eye's move is undone: what is left passes through the opening to the point in focus."""
    data, focus = scene.camera.data, 2.5
    data.shift_x, data.lens = 0.0, 50.0
    data.dof.use_dof, data.dof.aperture_fstop, data.dof.focus_distance = True, 0.1, focus
    data.stereo.interocular_distance, data.stereo.convergence_mode = 0.3, "OFFAXIS"
    for render_view in scene.render.views:
        render_view.use, render_view.file_suffix = render_view.name == view, ""
    blender.ops.mesh.primitive_cube_add(size=16, location=scene.camera.location)
    camera = read_camera(scene, view=view)
    model, basis, eye = camera.model, camera.pose.basis, camera.pose.eye
    end = (cycles_surface(scene, "Position", 32.0) - eye) @ basis
    direction = -cycles_surface(scene, "Incoming", 1.0) @ basis
    chief = np.stack(np.broadcast_arrays(*model.lens.rays(camera.raster.columns(), camera.raster.rows())[1]), axis=-1)
    seen = ~np.isnan(chief[..., 0]) & ~np.isnan(end[..., 0])
    assert seen.mean() > 0.5
    chief, end, direction = chief[seen], end[seen], direction[seen]
    unit = chief / np.linalg.norm(chief, axis=1, keepdims=True)
    in_focus, normal = (chief, np.array((0, 0, -1.0))) if model.lens.planar else (unit, unit)
    ahead = direction
    for _ in range(60):  # of unit length, and the eye's direction is ahead - offset / convergence side
        beside = model.offset * sides(ahead, model)
        turned = (direction * beside).sum(axis=1, keepdims=True) * model.nearness
        length = np.sqrt(1 - (model.offset * model.nearness) ** 2 + turned**2) - turned
        ahead = length * direction + model.nearness * beside
    end = end - beside
    opening = end - direction * ((end * normal).sum(axis=1) / (direction * normal).sum(axis=1))[:, None]
    miss = np.linalg.norm(np.cross(focus * in_focus - opening, ahead), axis=1)
    assert np.quantile(miss, 0.9) <= 64 * 16 * EPS32  # near the poles, where a side turns fast, float32 loses more
    reach = np.linalg.norm(opening, axis=1)
    assert camera.aperture.radius == pytest.approx(0.25)
    assert reach.max() <= 0.25 + 64 * 16 * EPS32
    assert reach.max() >= 0.24
