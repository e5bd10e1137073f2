"""The small scenes of blend_scenes, from the file to the picture, and what must be true of it by hand geometry."""

import re
from collections import Counter

import numpy as np
import pytest

from .opening import FOLDER, README, look, opened, rendered

NAMES = re.findall(r"^\* `(\w+)\.blend`: \S", README, re.MULTILINE)
"""The scenes that are hard for a ray caster; test_gallery.py has those that show what a camera does."""


def names(shapes):
    """Return the names of the objects that are cast."""
    return {shapes.names[k] for k in shapes.name_index}


def tangents(camera, images):
    """Return x and y at depth 1, in the camera's frame, of the bottom left and the top right pixel's rays."""
    x, y, z = camera.pose.basis.T @ images["ray_direction"][[0, -1], [0, -1]].T
    return x / -z, y / -z


def test_readme_lists_every_scene_and_no_other():
    shown = re.findall(r"`(\w+)\.blend`: \S", README)
    assert sorted(shown) == sorted(path.stem for path in FOLDER.glob("*.blend"))
    assert "spheres_and_planes" in NAMES


def test_every_scene_has_a_fact_of_its_own():
    assert {f"test_{name}" for name in NAMES} <= set(globals())


@pytest.mark.parametrize("name", NAMES)
def test_render_shows_what_the_caster_reads(blender, name, tmp_path):
    scene = opened(blender, name)
    assert scene.render.engine == "CAMERA_RAY_CASTER"
    camera, _, images = look(scene)
    picture = rendered(blender, tmp_path / "picture.exr")
    expected = np.zeros((camera.raster.height, camera.raster.width, 4), np.float32)
    expected[camera.raster.y0 : camera.raster.y1, camera.raster.x0 : camera.raster.x1] = images["combined"]
    np.testing.assert_array_equal(picture, expected)


@pytest.mark.parametrize("name", NAMES)
def test_rays_agree_with_blender(blender, name):
    from camera_ray_caster.blender.verification.check import verify_camera

    findings = verify_camera(opened(blender, name))
    assert [finding for finding in findings if not finding.passed] == []
    assert {"view_frame", "calc_matrix_camera", "world_to_camera_view"} <= {finding.witness for finding in findings}


@pytest.mark.parametrize("name", NAMES)
def test_scene_stores_no_path_of_a_machine(blender, name):
    scene = opened(blender, name)
    assert scene.render.filepath.startswith("//")
    assert not blender.data.libraries
    assert not blender.data.images


def test_spheres_and_planes(blender):
    _, shapes, images = look(opened(blender, "spheres_and_planes"))
    assert shapes.left_out == ()
    assert Counter(shapes.object_index.tolist()) == Counter(range(1, 12)) + Counter({12: 84})
    assert set(np.unique(images["object_index"])) == set(range(13))  # everything is in the picture
    assert images["combined"][..., :3].max() < 1  # and nothing is overexposed


def test_portrait(blender):
    camera, _, images = look(opened(blender, "portrait"))
    # 67 % of 401 x 533, truncated; pixels 1.25 wide, so that 357 rows measure 357 / 1.25 columns
    assert camera.raster.shape == (357, 268)
    x, y = tangents(camera, images)
    side = 36 / 40  # the sensor's width over the lens, though the frame is portrait; shifts are parts of it
    # shifts and lens are float32, relative error 6e-8
    np.testing.assert_allclose(np.diff(y), side * 356 / 357, rtol=1e-6)
    np.testing.assert_allclose(np.diff(x), side * 267 / 357 * 1.25, rtol=1e-6)
    np.testing.assert_allclose((x.mean(), y.mean()), (0.11 * side, -0.17 * side), rtol=1e-6)


def test_vertical_fit(blender):
    camera, _, images = look(opened(blender, "vertical_fit"))
    x, y = tangents(camera, images)
    side = 18 / 28
    np.testing.assert_allclose(np.diff(y), side * 358 / 359, rtol=1e-6)
    np.testing.assert_allclose(np.diff(x), side * 639 / 359, rtol=1e-6)
    # the camera's matrix is a rotation to single precision only
    np.testing.assert_allclose((x.mean(), y.mean()), (-0.1 * side, 0), rtol=1e-6, atol=1e-7)


def test_orthographic(blender):
    camera, shapes, images = look(opened(blender, "orthographic"))
    assert np.ptp(images["ray_direction"], axis=(0, 1)).max() == 0
    corners = images["ray_origin"][[0, -1], [0, -1]] - camera.pose.eye
    across, up, _ = np.diff(corners @ camera.pose.basis, axis=0)[0]
    np.testing.assert_allclose((across, up), (6.5 * 499 / 500, 6.5 * 399 / 500 * 1.2), rtol=1e-6)
    assert images["depth"].min() >= camera.clip_start
    green = images["object_index"] == 3
    outwards = images["position"][green] - shapes.center[shapes.object_index == 3]
    from_outside = (images["normal"][green] * outwards).sum(axis=1) > 0
    assert from_outside.any()
    assert not from_outside.all()  # the near plane opens it: the far side is seen from within


def test_border(blender):
    scene = opened(blender, "border")
    camera, _, images = look(scene)
    raster = camera.raster
    # 0.7 x 630 is 441 in Blender's single precision; the stored 0.7 times 630 is 440.99999 in double
    assert (raster.x0, raster.x1, raster.y0, raster.y1) == (126, 441, 53, 284)
    scene.render.use_border = False
    whole = look(scene)[2]
    for name, image in images.items():
        np.testing.assert_array_equal(image, whole[name][53:284, 126:441], err_msg=name)


def test_sheared_and_mirrored(blender):
    scene = opened(blender, "sheared_and_mirrored")
    camera, _, images = look(scene)
    assert np.linalg.det(camera.pose.basis) < 0
    assert np.abs(camera.pose.basis.T @ camera.pose.basis - np.eye(3)).max() > 0.1
    for name in ("Red", "Green", "Yellow"):
        thing = scene.objects[name]
        seen = images["position"][images["object_index"] == thing.pass_index]
        matrix = np.array(thing.matrix_world)
        q = np.linalg.solve(matrix[:3, :3], (seen - matrix[:3, 3]).T)
        # 1e-5: Blender's UV sphere is one to 2.6e-6, and the solve adds a few roundings
        np.testing.assert_allclose(np.linalg.norm(q, axis=0), 1, atol=1e-5)
        assert len(seen) > 100


@pytest.mark.parametrize("frame", [1, 8.5, 12.25, 25])
def test_animated(blender, frame):
    scene = opened(blender, "animated")
    camera, _, images = look(scene, frame)
    red = images["object_index"] == scene.objects["Red"].pass_index
    distance = np.linalg.norm(camera.pose.eye - scene.objects["Red"].location)
    assert distance == pytest.approx(np.hypot(4 + (frame - 1) / 3, 1.5), rel=0.05)  # between keys the path bends
    lens = 5 * distance
    diameter = 2 * lens / 36 * 640 / np.sqrt(distance**2 - 1)  # of a unit sphere in the middle of the picture
    assert abs(red.any(axis=0).sum() - diameter) <= 1  # whole pixels


def test_inside_a_sphere(blender):
    _, shapes, images = look(opened(blender, "inside_a_sphere"))
    assert images["shape_index"].min() >= 0
    room = images["object_index"] == 1
    assert ((images["normal"] * images["position"]).sum(axis=2)[room] < 0).all()  # towards the eye, so inwards
    assert set(np.unique(images["object_index"])) == set(range(1, len(shapes) + 1))


def test_far_and_small(blender):
    _, shapes, images = look(opened(blender, "far_and_small"))
    diameter = 2 * 0.1 * 5000 / 36 * 640 / 400
    for k, center in enumerate(shapes.center):
        ball = images["shape_index"] == k
        assert abs(ball.any(axis=0).sum() - diameter) <= 1  # whole pixels
        radii = np.linalg.norm(images["position"][ball] - center, axis=1)
        # single precision is good to 400 x 6e-8 = 2e-5 here, double to 4e-14, times up to 1 / cos where rays graze
        assert np.ptp(radii) < 1e-10


def test_instances(blender):
    _, shapes, _ = look(opened(blender, "instances"))
    assert shapes.left_out == ()
    floor, snowmen, points, ball, wheel, particles = 1, 2 * 2, 40, 1, 10, 40
    assert Counter(shapes.object_index.tolist()) == {1: floor, 2: snowmen, 3: points, 4: ball + wheel + particles}


def test_left_out(blender):
    _, shapes, _ = look(opened(blender, "left_out"))
    assert names(shapes) == {"Floor", "Sphere", "Monkey", "Flat sphere"}
    named = {name for name, _ in shapes.left_out}
    assert named == {"Hair", "Volume", "Endless quad"}  # not what the user has hidden


def test_cast_as(blender):
    camera, shapes, images = look(opened(blender, "cast_as"))
    assert names(shapes) == {"Floor", "Cube", "Monkey"}
    assert [name for name, _ in shapes.left_out] == ["Nothing"]
    downwards = -images["ray_direction"][..., 2]
    reach = camera.pose.eye[2] / downwards * (images["ray_direction"] @ -camera.pose.basis[:, 2])
    clear = images["object_index"] <= 1  # neither cube nor monkey stands before it
    floor = (downwards > 0) & (reach <= camera.clip_end)
    np.testing.assert_array_equal((images["object_index"] == 1)[clear], floor[clear])


@pytest.mark.parametrize(("layer", "shown"), [("Spheres", "Ball"), ("Planes", "Floor")])
def test_view_layers(blender, layer, shown, tmp_path):
    scene = opened(blender, "view_layers")
    blender.context.window.view_layer = scene.view_layers[layer]
    for other in scene.view_layers:
        other.use = other.name == layer
    _, shapes, images = look(scene)
    assert names(shapes) == {shown}
    picture = rendered(blender, tmp_path / "picture.exr")
    np.testing.assert_array_equal(picture, images["combined"].astype(np.float32))


def test_empty(blender):
    _, shapes, images = look(opened(blender, "empty"))
    assert len(shapes) == 0
    assert (images["shape_index"] == -1).all()
    assert np.isposinf(images["depth"]).all()
    assert np.ptp(images["combined"], axis=(0, 1)).max() == 0
    assert images["combined"].min() > 0
