"""Annotations of pictures: boxes, masks and key points against pictures that are worked out by hand."""

import json
from dataclasses import replace

import numpy as np
import pytest

from camera_ray_caster.core.annotations.coco import Sheet, document, merged, run_lengths
from camera_ray_caster.core.annotations.keypoints import KeyPoint, seen_key_points
from camera_ray_caster.core.annotations.silhouettes import silhouettes
from camera_ray_caster.core.camera.build import camera_from
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.casting.visibility import Visibility
from camera_ray_caster.core.materials.surface import Surface
from camera_ray_caster.core.materials.values import UV, Coordinates, constant, function_of
from camera_ray_caster.core.motion.evaluations import resolve
from camera_ray_caster.core.records import PLANE, SPHERE, InputError

from ..camera.test_pixel_time import SHUTTER
from ..camera.test_pixel_time import camera as timed_camera
from ..cameras.model_examples import raw_of
from ..casting.neighbors import with_motion
from ..casting.test_cast import random_shapes, shapes_of

CAMERA = timed_camera({})
"""Orthographic, 64 x 48 pixels, 16 of them a unit."""
WALLS = shapes_of((PLANE, (0, 0, -5), 0.5), (PLANE, (0.5, 0.25, -3), 0.5), (PLANE, (0, 0, -9), 0.25))
"""One square, another before its upper right, and one behind the first."""
SHEET = Sheet(64, 48)


def unpacked(lengths):
    """The mask of run lengths."""
    values = np.arange(len(lengths["counts"])) % 2 == 1
    return np.repeat(values, lengths["counts"]).reshape(lengths["size"], order="F")


def annotated(camera=CAMERA, shapes=WALLS, sheet=SHEET, points=(), file_name="a.png"):
    annotations = document({"file_name": file_name}, sheet, camera, shapes, lambda name: "wall", points)
    return json.loads(json.dumps(annotations))


def test_boxes_masks_and_areas_by_hand():
    """The square is 16 pixels wide; the one before it covers 8 x 12 of them."""
    annotations = annotated()
    assert annotations["images"] == [{"id": 1, "file_name": "a.png", "width": 64, "height": 48}]
    assert annotations["categories"] == [{"id": 1, "name": "wall", "supercategory": ""}]
    behind, before = annotations["annotations"]
    assert behind["bbox"] == behind["bbox_whole"] == [24, 16, 16, 16]
    assert (behind["area"], behind["area_whole"], behind["visible_fraction"]) == (160, 256, 0.625)
    assert before["bbox"] == before["bbox_whole"] == [32, 12, 16, 16]
    assert before["visible_fraction"] == 1
    assert [entry["object"] for entry in annotations["hidden"]] == ["shape 2"]
    assert annotations["hidden"][0]["bbox_whole"] == [28, 20, 8, 8]
    index = cast(CAMERA, WALLS, passes=("shape_index",))["shape_index"][::-1]
    for entry in annotations["annotations"]:
        assert (unpacked(entry["segmentation"]) == (index == entry["shape_index"])).all()
    amodal = unpacked(annotations["annotations"][0]["segmentation_whole"])
    assert amodal[16:32, 24:40].all()
    assert amodal.sum() == 256


def test_objects_have_boxes_in_their_own_axes():
    turned = np.array([(0, -3.0, 0), (2.0, 0, 0), (0, 0, 1.0)])  # along y, 2 long, and along -x, 3 long
    shapes = shapes_of((SPHERE, (1, 2, 3), 0.5), (PLANE, (0, 0, -1), 0.5))
    shapes = replace(shapes, axes=np.stack((turned, shapes.axes[1])))
    ball, square = annotated(shapes=shapes)["objects"]
    assert ball["size"] == [4, 6, 2]
    assert np.allclose(ball["matrix"], [(0, -1, 0, 1), (1, 0, 0, 2), (0, 0, 1, 3), (0, 0, 0, 1)])
    assert (ball["image_id"], ball["category"], ball["instance"]) == (1, "wall", 0)
    assert square["size"] == [1, 1, 0]
    whole = merged([annotated(shapes=shapes), annotated(shapes=shapes)])
    assert [entry["image_id"] for entry in whole["objects"]] == [1, 1, 2, 2]


def test_a_visible_part_has_a_box_of_its_own():
    covered = replace(WALLS, center=np.array([(0, 0, -5), (0.5, 0, -3), (9, 9, -9.0)]))
    behind = annotated(shapes=covered)["annotations"][0]
    assert (behind["bbox"], behind["bbox_whole"]) == ([24, 16, 8, 16], [24, 16, 16, 16])
    assert len(annotated(shapes=covered)["hidden"]) == 0


def test_a_border_is_a_part_of_the_frame_or_a_picture_of_its_own():
    border = timed_camera({}, use_border=True, border_min_x=0.5, border_max_x=1.0, border_min_y=0.0, border_max_y=0.5)
    shown = annotated(border)["annotations"][0]
    assert shown["bbox"] == [32, 28, 8, 4]
    assert unpacked(shown["segmentation"]).shape == (48, 64)
    alone = annotated(border, sheet=Sheet(32, 24, (32, 0)))["annotations"][0]
    assert alone["bbox"] == [0, 4, 8, 4]
    assert unpacked(alone["segmentation"]).sum() == shown["area"]


@pytest.mark.parametrize("key", ["PERSP", "FISHEYE_EQUIDISTANT", "CROSS_SLIT"])
def test_silhouettes_are_those_of_casts_without_the_others(key):
    camera = camera_from(raw_of(key, {"resolution_x": 64, "resolution_y": 48}))
    shapes = random_shapes(np.random.default_rng(0), 40)
    outlines, index = silhouettes(camera, shapes)
    assert len(outlines) > 2
    for outline in outlines:
        far = shapes.center.copy()
        others = np.arange(len(shapes)) != outline.row
        far[others] = camera.pose.eye + np.array((0, 0, 1e6))
        alone = cast(camera, replace(shapes, center=far), passes=("shape_index",))["shape_index"] == outline.row
        y, x = np.nonzero(alone)
        assert outline.whole == (x.min(), x.max() + 1, y.min(), y.max() + 1)
        assert outline.whole_pixels == alone.sum()
        seen = index == outline.row
        assert outline.visible_pixels == seen.sum()
        assert (outline.visible is None) == (not seen.any())
        assert (outline.alone == alone[slice(*outline.whole[2:]), slice(*outline.whole[:2])]).all()
    for passes in ("depth", "shape_index"), ("depth",):
        again, same_index = silhouettes(camera, shapes, cast(camera, shapes, passes=passes))
        assert (same_index == index).all()
        assert [outline.row for outline in again] == [outline.row for outline in outlines]


def test_a_shape_alone_has_the_holes_of_its_own_material():
    """The second square's left half is transparent; the first square has no holes."""
    right = function_of(lambda uv: (uv[:1] >= 0.5) * 1.0, Coordinates(UV))
    holed = Surface(constant(1, 1, 1), alpha=right)
    shapes = replace(WALLS, surfaces=(holed,), surface=np.array([-1, 0, -1], np.int32))
    behind, before, _ = silhouettes(CAMERA, shapes)[0]
    assert (behind.whole_pixels, before.whole_pixels) == (256, 128)


def test_a_shape_that_moves_while_rows_are_read_has_the_box_of_its_picture():
    def evaluate(frame):
        return timed_camera(SHUTTER), shapes_of((PLANE, (2 * (frame - 5), 0, -3), 0.5))

    camera, shapes = evaluate(5.0)
    motion = resolve(evaluate, 4.75, 5.25, 0.01, 64)
    (outline,), index = silhouettes(*with_motion(camera, shapes, motion))
    assert outline.whole == outline.visible
    assert outline.whole[1] - outline.whole[0] > 16
    assert outline.whole_pixels == (index == 0).sum()


def timed(evaluate, first=4.75, last=5.25):
    camera, shapes = evaluate(first)
    motion = resolve(evaluate, first, last, 0.01, 64)
    return with_motion(camera, shapes, motion)


def test_shapes_that_are_others_at_the_times_of_other_pixels_are_refused():
    """The row of a shape would mean the one in some pixels, and the other in others."""

    def evaluate(frame):
        shapes = shapes_of((PLANE, (0, 0, -3), 0.5))
        return timed_camera(SHUTTER), shapes if frame < 5 else replace(shapes, names=("other",))

    with pytest.raises(InputError, match=r"frame 5\S* differs in 'other', 'shape 0': show it at all"):
        annotated(*timed(evaluate))


def test_key_points_of_what_moves_between_the_times_of_pixels_are_refused():
    def evaluate(frame):
        return timed_camera(SHUTTER), shapes_of((PLANE, (frame, 0, -3), 0.5), (PLANE, (0, 0, -5), 0.5))

    camera, shapes = timed(evaluate)
    still, moving = (seen_key_points(CAMERA, WALLS, [KeyPoint("a", f"shape {k}", (0, 0, -5))]) for k in (1, 0))
    assert annotated(camera, shapes, points=still)["keypoints"]
    with pytest.raises(InputError, match="key points of 'shape 0' are places at one time"):
        annotated(camera, shapes, points=moving)


def test_key_points_belong_to_the_object_and_not_to_its_instances():
    twice = replace(WALLS, names=("wall", "wall", "third"), instanced=(False, True, False))
    seen = seen_key_points(CAMERA, twice, [KeyPoint("corner", "wall", (-0.5, -0.5, -5.0))])
    original, instance = annotated(shapes=twice, points=seen)["annotations"]
    assert (original["num_keypoints"], instance["num_keypoints"]) == (1, 0)
    assert instance["keypoints"] == [0, 0, 0]


def test_key_points_have_pixels_depths_and_are_hidden_as_they_are():
    points = [
        KeyPoint("corner", "shape 0", (-0.5, -0.5, -5.0)), KeyPoint("covered", "shape 0", (0.4, 0.4, -5.0)),
        KeyPoint("away", "shape 1", (9.0, 0.0, -5.0)), KeyPoint("free", "", (0.0, 1.0, -7.0)),
    ]  # fmt: skip
    seen = seen_key_points(CAMERA, WALLS, points)
    assert [point.visibility.name for point in seen] == ["SEEN", "HIDDEN", "OUTSIDE", "SEEN"]
    assert seen[0].pixel == pytest.approx((24, 16))
    assert [point.depth for point in seen] == pytest.approx([5, 5, 5, 7])
    annotations = annotated(points=seen)
    assert annotations["categories"][0]["keypoints"] == ["corner", "covered", "away"]
    first, second = annotations["annotations"]
    assert first["keypoints"] == pytest.approx([24, 32, 2, 38.4, 17.6, 1, 0, 0, 0])
    assert (first["num_keypoints"], second["num_keypoints"]) == (2, 0)
    assert annotations["keypoints"][3] == {
        "image_id": 1, "name": "free", "object": "", "world": [0, 1, -7], "pixel": [32, 8], "depth": 7,
        "visibility": "seen",
    }  # fmt: skip


def test_a_key_point_beside_the_border_is_outside_of_the_picture():
    points = [KeyPoint("left", "shape 0", (-0.5, -0.5, -5.0)), KeyPoint("right", "shape 0", (0.5, -0.5, -5.0))]
    border = timed_camera({}, use_border=True, border_min_x=0.5, border_max_x=1.0, border_min_y=0.0, border_max_y=0.5)
    seen = seen_key_points(border, WALLS, points)
    assert [point.visibility.name for point in seen] == ["OUTSIDE", "SEEN"]
    for sheet, right in ((SHEET, [40, 32, 2]), (Sheet(32, 24, (32, 0)), [8, 8, 2])):
        annotation = annotated(border, sheet=sheet, points=seen)["annotations"][0]
        assert annotation["keypoints"] == pytest.approx([0, 0, 0, *right])


@pytest.mark.parametrize("key", ["PERSP", "EQUIRECTANGULAR", "CROSS_SLIT", "ORTHO"])
def test_the_depth_of_a_key_point_is_that_of_the_depth_pass(key):
    camera = camera_from(raw_of(key, {"resolution_x": 64, "resolution_y": 48}))
    shapes = shapes_of((SPHERE, (0, 0, 0), 6.0))
    images = cast(camera, shapes, passes=("depth", "position"), dtype=float)
    rows, columns = [5, 20, 40], [9, 30, 60]
    points = [KeyPoint("", "", tuple(images["position"][at])) for at in zip(rows, columns, strict=True)]
    seen = seen_key_points(camera, shapes, points)
    assert [point.depth for point in seen] == pytest.approx(images["depth"][rows, columns].tolist(), rel=1e-9)
    assert {point.visibility for point in seen} == {Visibility.SEEN}


def test_documents_are_merged_with_numbers_and_key_points_of_their_own():
    points = seen_key_points(CAMERA, WALLS, [KeyPoint("corner", "shape 0", (-0.5, -0.5, -5.0))])
    plain = document({"file_name": "c.png"}, SHEET, CAMERA, WALLS, lambda name: name)
    both = merged([annotated(), annotated(points=points, file_name="b.png"), plain])
    assert [image["id"] for image in both["images"]] == [1, 2, 3]
    assert [image["file_name"] for image in both["images"]] == ["a.png", "b.png", "c.png"]
    assert [category["name"] for category in both["categories"]] == ["wall", "shape 0", "shape 1", "shape 2"]
    assert [entry["id"] for entry in both["annotations"]] == list(range(1, 7))
    assert [entry["category_id"] for entry in both["annotations"]] == [1, 1, 1, 1, 2, 3]
    assert [entry.get("keypoints") for entry in both["annotations"]] == [
        [0, 0, 0], [0, 0, 0], pytest.approx([24, 32, 2]), [0, 0, 0], None, None,
    ]  # fmt: skip
    assert [entry["image_id"] for entry in both["hidden"]] == [1, 2, 3]
    assert both["keypoints"][0]["image_id"] == 2


def test_run_lengths_begin_with_what_is_not_in_the_mask():
    assert run_lengths(np.array([[True, False], [True, True]])) == {"size": [2, 2], "counts": [0, 2, 1, 1]}
    assert run_lengths(np.zeros((2, 3), bool)) == {"size": [2, 3], "counts": [6]}
