"""What cast.py --annotations writes, and what it refuses."""

import json

import pytest

from .running import left, refused, small


@pytest.fixture(scope="module")
def scene(registered, tmp_path_factory):
    """The small scene with key points: an empty on top of the sphere and parented to it, one behind, a vertex group."""
    bpy = registered
    path = small(bpy, tmp_path_factory.mktemp("annotations") / "small.blend")
    sphere = bpy.data.objects["Sphere"]
    for name, location in (("Top of it", (0, 0, 1.0001)), ("Below", (0, 0, -2))):
        empty = bpy.data.objects.new(name, None)
        bpy.context.scene.collection.objects.link(empty)
        empty.location = location
    bpy.data.objects["Top of it"].parent = sphere
    pole = max(sphere.data.vertices, key=lambda vertex: vertex.co.z)
    group = sphere.vertex_groups.new(name="pole")
    group.add([pole.index], 0.5, "REPLACE")
    sphere["category"] = "ball"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_boxes_masks_and_key_points_stand_beside_the_pictures_and_in_one_file(command, scene, tmp_path):
    words = "--annotations", "--keypoints", "ALL", "--frames", "1:2", "--passes", "shape_index,depth"
    done = command("cast", scene, *words, "--output", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    names = [f"{name}_000{k}{end}" for k in (1, 2) for name, end in (("report", ".json"), ("small", ".exr"),
             ("small", ".png"), ("small", "_coco.json"))]  # fmt: skip
    assert left(tmp_path) == sorted(["annotations.json", "preview.png", "reader.py", *names])
    whole = json.loads((tmp_path / "annotations.json").read_text())
    assert [(image["file_name"], image["camera"], image["frame"]) for image in whole["images"]] == [
        ("small_0001.png", "Top", 1.0), ("small_0002.png", "Top", 2.0),
    ]  # fmt: skip
    (category,) = whole["categories"]
    assert (category["name"], category["keypoints"]) == ("ball", ["pole", "Top of it"])
    first, second = whole["annotations"]
    (x, y, width, height), area = first["bbox"], first["area"]
    assert (x + width / 2, y + height / 2) == (16, 12)
    assert 0.7 < area / (width * height) < 0.85
    assert second["bbox"][0] < x
    assert first["keypoints"] == pytest.approx([16, 12, 2, 16, 12, 2], abs=1e-4)
    points = {(point["image_id"], point["name"]): point for point in whole["keypoints"]}
    assert points[1, "Below"]["visibility"] == "hidden"
    assert points[1, "Below"]["depth"] == pytest.approx(7)
    assert points[1, "pole"]["object"] == points[1, "Top of it"]["object"] == "Sphere"
    again = command("cast", scene, *words, "--output", tmp_path, "--skip-existing")
    assert again.returncode == 0
    assert json.loads((tmp_path / "annotations.json").read_text()) == whole


def test_a_data_set_has_one_file_of_them_too_whatever_shows_the_picture(command, scene, tmp_path):
    words = "--annotations", "--frames", "1:2", "--passes", "depth", "--output", tmp_path
    assert command("dataset", scene, *words).returncode == 0
    whole = json.loads((tmp_path / "annotations.json").read_text())
    assert [image["file_name"] for image in whole["images"]] == ["Top_0001.npz", "Top_0002.npz"]
    assert len(whole["annotations"]) == 2
    assert all((tmp_path / image["file_name"]).is_file() for image in whole["images"])


@pytest.mark.cases(1)
@pytest.mark.parametrize(("words", "message"), [
    (["--keypoints", "Nobody"], "no key point 'Nobody'"),
    (["--keypoints", "Top"], "no key point 'Top'"),
    (["--keypoints", "ALL", "Below"], "ALL already includes all names"),
])  # fmt: skip
def test_bad_names_are_refused_in_one_line(command, scene, tmp_path, words, message):
    assert message in refused(command("cast", scene, *words, "--output", tmp_path / "out"))
    assert not (tmp_path / "out").exists()
