"""Pictures with row 0 at the top against OpenCV's own arithmetic: the pixel of a point by K and the pose."""

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.core.sets import set_reader

POSE = crc.look_at((3, -4, 2.5), (0, 0, 0.5))
BALL = crc.spheres([(0.2, 0.1, 0.6)], 0.5)


@pytest.mark.parametrize("border", [{}, {"use_border": True, "border_min_x": 0.25, "border_max_y": 0.75}])
def test_rows_pixels_k_and_flow_belong_together(border):
    camera = crc.camera("OPENCV_PINHOLE", (64, 48), POSE, fx=60.0, fy=61.0, cx=30.0, cy=25.0, **border)
    moved = crc.spheres([(0.3, 0.15, 0.7)], 0.5)
    scene = crc.Scene(camera, BALL).with_timeline(next=crc.Scene(camera, moved))
    images = crc.cast(scene, passes=("position", "flow_forward", "shape_index"), dtype=np.float64)
    turned = crc.top_down(images)
    assert all(image.flags.c_contiguous for image in turned.values())
    assert turned["position"].dtype == images["position"].dtype
    row, column = np.nonzero(turned["shape_index"] == 0)
    assert len(row) > 100
    position = turned["position"][row, column]

    def pixels_of(points):
        seen = points @ camera.opencv_from_world[:3, :3].T + camera.opencv_from_world[:3, 3]
        return (seen / seen[:, 2:]) @ turned.K[:2].T

    np.testing.assert_allclose(pixels_of(position), np.stack((column, row), axis=1), atol=1e-9)
    np.testing.assert_allclose(turned.project(position), np.stack((column, row), axis=1), atol=1e-9)
    assert same_pictures(crc.cast(scene, passes=(*images,), dtype=np.float64, rows="top"), turned)
    then = position + np.array((0.1, 0.05, 0.1))
    flow = turned["flow_forward"][row, column]
    np.testing.assert_allclose(pixels_of(then) - pixels_of(position), flow, atol=1e-9)
    assert (flow[:, 1] < 0).mean() > 0.9, "the ball rises: y, which points down, falls"


def same_pictures(first, second):
    """Whether two sets of passes are equal, with their camera matrix."""
    equal = all(np.array_equal(first[name], second[name], equal_nan=True) for name in second)
    return [*first] == [*second] and equal and np.array_equal(first.K, second.K)


def test_pixels_from_the_top_are_those_of_k_in_every_function():
    lens = {"fx": 60.0, "fy": 61.0, "cx": 30.0, "cy": 25.0}
    camera = crc.camera("OPENCV_PINHOLE", (64, 48), POSE, **lens)
    points = np.array([(0.2, 0.1, 0.6), (0.5, 0.5, 0.0)])
    seen = points @ camera.opencv_from_world[:3, :3].T + camera.opencv_from_world[:3, 3]
    pixels, change = camera.project(points, jacobian=True, rows="top")
    np.testing.assert_allclose(pixels, (seen / seen[:, 2:]) @ camera.K[:2].T, atol=1e-9)
    np.testing.assert_array_equal(camera.project(points, rows="TOP"), pixels)
    moved = [camera.project(points + step, rows="top") for step in 1e-6 * np.eye(3)]
    np.testing.assert_allclose(change, np.stack([(there - pixels) / 1e-6 for there in moved], axis=-1), atol=1e-3)
    rays = camera.rays_at(*pixels.T, rows="top")
    ahead = points - rays.origins
    np.testing.assert_allclose(rays.directions, ahead / np.linalg.norm(ahead, axis=1)[:, None], atol=1e-12)
    column, row = np.rint(pixels[0]).astype(int)
    lesson = crc.explain(camera, BALL, (column, row), rows="top")
    assert str(lesson) == str(crc.explain(camera, BALL, (column, 47 - row)))
    with pytest.raises(crc.InputError, match=r"pixel 3,48 is outside the frame: give 0,0 \(top left\)"):
        crc.explain(camera, BALL, (3, 48), rows="top")
    for call in (crc.cast, lambda *scene, rows: camera.project(points, rows=rows)):
        with pytest.raises(crc.InputError, match="rows is 'up': it must be one of bottom, top"):
            call(camera, BALL, rows="up")


def test_pictures_from_the_top_are_not_turned_twice_or_written_into():
    camera = crc.camera("PERSP", (8, 6))
    turned = crc.cast(camera, BALL, rows="top")
    assert crc.top_down(turned) is turned
    images = crc.cast(camera, BALL)
    for keywords in ({"into": turned}, {"into": images, "rows": "top"}):
        with pytest.raises(crc.InputError, match="into has row 0 at the"):
            crc.cast(camera, BALL, **keywords)
    with pytest.raises(TypeError, match="passes by name"):
        crc.top_down(images["depth"])


def test_layers_of_a_file_are_turned_as_their_passes():
    flow = np.arange(24.0).reshape(4, 3, 2)
    turned = crc.top_down({"Near.flow_forward": flow, "flow_forward": flow})
    np.testing.assert_array_equal(turned["Near.flow_forward"], turned["flow_forward"])
    np.testing.assert_array_equal(turned["flow_forward"][0, :, 1], -flow[3, :, 1])


def test_the_reader_of_data_sets_turns_arrays_and_channels_alike():
    flow = np.arange(24.0).reshape(4, 3, 2)
    depth = np.arange(12.0).reshape(4, 3)
    ours = crc.top_down({"flow_forward": flow, "depth": depth})
    array = set_reader.top_down({"flow_forward": flow, "depth": depth})
    channels = set_reader.top_down({f"ViewLayer.flow_forward.{'XY'[k]}": flow[..., k] for k in range(2)})
    for name, image in ours.items():
        np.testing.assert_array_equal(array[name], image)
    np.testing.assert_array_equal(np.stack([*channels.values()], axis=-1), ours["flow_forward"])


def test_arrays_without_a_camera_and_models_without_a_matrix():
    turned = crc.top_down({"depth": np.arange(6.0).reshape(3, 2)})
    assert turned["depth"].tolist() == [[4, 5], [2, 3], [0, 1]]
    assert turned.K is None
    with pytest.raises(TypeError, match="no camera"):
        turned.project((0, 0, 1))
    assert crc.top_down(crc.cast(crc.camera("EQUIRECTANGULAR", (8, 4)), BALL)).K is None
