"""Sets of cast.py without --dataset: what lies in them, and that EXR and NPZ say the same."""

import json
import subprocess
import sys

import cv2
import numpy as np
import pytest

from camera_ray_caster.core.sets import read_set

from .running import left, refused, script

PASSES = "combined,depth,distance,normal,uv,object_index,shape_index,valid"
WORDS = "--frames", "1:2", "--passes", PASSES, "--annotations"


@pytest.fixture
def sets(command, blender, scene, tmp_path):
    """A function that casts a set of each format, after ``change``, and returns their folders."""

    def cast(change=lambda bpy: None, words=WORDS):
        change(blender)
        blender.ops.wm.save_as_mainfile(filepath=str(scene))
        for kind in ("exr", "npz"):
            done = command("cast", scene, *words, "--format", kind, "--output", tmp_path / kind)
            assert (done.returncode, done.stderr) == (0, "")
        return tmp_path / "exr", tmp_path / "npz"

    return cast


def border(bpy):
    render = bpy.context.scene.render
    render.use_border, render.border_min_x, render.border_max_y = True, 0.25, 0.5


def cropped(bpy):
    border(bpy)
    bpy.context.scene.render.use_crop_to_border = True


def layers(bpy):
    bpy.context.scene.view_layers.new("The.other")


def composited(bpy):
    scene = bpy.context.scene
    if hasattr(scene, "compositing_node_group"):
        tree = scene.compositing_node_group = bpy.data.node_groups.new("Tree", "CompositorNodeTree")
        tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
        output = tree.nodes.new("NodeGroupOutput")
    else:
        scene.use_nodes = True
        tree = scene.node_tree
        output = tree.nodes.get("Composite") or tree.nodes.new("CompositorNodeComposite")
    picture = tree.nodes.new("CompositorNodeRLayers")
    tree.links.new(picture.outputs["Image"], output.inputs[0])


CHANGES = [lambda bpy: None, border, cropped, layers, composited]


@pytest.mark.cases(1)
@pytest.mark.parametrize("change", CHANGES)
def test_exr_files_say_what_npz_files_say(sets, change):
    pairs = list(zip(*map(read_set, sets(change)), strict=True))
    assert len(pairs) == 2
    keys = {f"{layer}{key}" for key in PASSES.split(",") for layer in (("ViewLayer.", "The.other.")
            if change is layers else ("",))}  # fmt: skip
    for exr, npz in pairs:
        for key in keys:
            assert exr.pixels(key).dtype == npz.pixels(key).dtype, key
            np.testing.assert_array_equal(exr.pixels(key), npz.pixels(key), key)


@pytest.mark.cases(1)
@pytest.mark.parametrize("change", [cropped, border])
def test_cameras_of_a_set_are_of_its_pictures(sets, command, tmp_path, change):
    _, folder = sets(change)
    done = command("export", folder, "--format", "nerfstudio-scene", "--output", tmp_path / "out")
    assert (done.returncode, done.stderr) == (0, "")
    for frame in json.loads((tmp_path / "out" / "transforms.json").read_text())["frames"]:
        for key in ("file_path", "depth_file_path", "mask_path"):
            picture = cv2.imread(str(tmp_path / "out" / frame[key]), cv2.IMREAD_UNCHANGED)
            assert picture.shape[:2] == (frame["h"], frame["w"]), key


def stereo(bpy):
    render = bpy.context.scene.render
    render.use_multiview, render.resolution_x, render.resolution_y = True, 64, 48
    stereo = bpy.data.objects["Top"].data.stereo
    stereo.interocular_distance, stereo.convergence_mode = 0.5, "PARALLEL"
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.2, location=(0.4, -0.6, 1))
    bpy.context.object.name = "Small"


def test_stereo_views_are_two_cameras(sets, command, tmp_path):
    for folder in sets(stereo):
        whole = json.loads((folder / "annotations.json").read_text())
        assert [image["camera"] for image in whole["images"]] == ["Top_L", "Top_R"] * 2
        views = read_set(folder)
        assert [item.name for item in views] == ["small_0001_L", "small_0002_L", "small_0001_R", "small_0002_R"]
        done = command("export", folder, "--format", "nerfstudio-scene", "--output", tmp_path / f"{folder.name}_out")
        assert (done.returncode, done.stderr) == (0, "")
        frames = json.loads((tmp_path / f"{folder.name}_out" / "transforms.json").read_text())["frames"]
        assert [item["file_path"] for item in frames] == [f"images/{item.name}.png" for item in views]
        text = subprocess.run([sys.executable, folder / "reader.py"], capture_output=True, text=True, check=True).stdout
        assert [line.split()[0] for line in text.splitlines()] == sorted(item.name for item in views)
    seen = {}
    for view, frame in zip(views, frames, strict=True):  # the ball is where the camera of each eye says
        annotated = view.annotations
        (x, y, width, height), = (item["bbox_whole"] for item in annotated["annotations"] if item["object"] == "Small")
        in_camera = np.linalg.inv(frame["transform_matrix"]) @ (0.4, -0.6, 1, 1)
        seen[view.name] = frame["fl_x"] * in_camera[0] / -in_camera[2] + frame["cx"]
        assert abs(seen[view.name] - (x + width / 2)) < 1
        assert abs(frame["fl_y"] * in_camera[1] / in_camera[2] + frame["cy"] - (y + height / 2)) < 1
    apart = seen["small_0001_L"] - seen["small_0001_R"]
    assert apart == pytest.approx(frames[0]["fl_x"] * 0.5 / 4, rel=1e-5)  # by triangles


def test_a_run_with_annotations_is_a_set_with_a_reader_and_a_preview(sets):
    for folder in sets():
        assert {"annotations.json", "preview.png", "reader.py"} <= set(left(folder))
        picture = cv2.imread(str(folder / "preview.png"))
        assert picture.shape == (24, 4 * 32, 3)
        words = [sys.executable, folder / "reader.py"]
        output = subprocess.run(words, capture_output=True, text=True, check=True).stdout
        assert [line.split()[:3] for line in output.splitlines()] == [
            [f"small_000{k}", "Perspective", f"{k}.0"] for k in (1, 2)
        ]


def test_a_reader_of_somebody_else_is_left_alone(command, scene, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "reader.py").write_text("mine = 1")
    for words in (WORDS[:4], WORDS):
        done = command("cast", scene, *words, "--output", tmp_path / "out")
        assert (done.returncode, done.stderr) == (0, "")
        assert ("preview.png" in left(tmp_path / "out")) is (words == WORDS)
    assert (tmp_path / "out" / "reader.py").read_text() == "mine = 1"


@pytest.mark.full
@pytest.mark.parametrize("key", ["depth16", "normals", "colmap-scene", "bop-scenes", "opencv"])
def test_an_exported_exr_set_is_an_exported_npz_set(command, sets, tmp_path, key):
    outs = []
    for folder in sets():
        outs.append(tmp_path / f"{folder.name}_out")
        done = command("export", folder, "--format", key, "--output", outs[-1])
        assert (done.returncode, done.stderr) == (0, "")
    exr, npz = ({path.relative_to(out): path for path in out.rglob("*") if path.is_file()} for out in outs)
    assert exr.keys() == npz.keys() != set()
    for name, path in exr.items():
        if name.suffix == ".png":  # Blender writes the time into its own
            assert (cv2.imread(str(path), -1) == cv2.imread(str(npz[name]), -1)).all()
        else:
            assert path.read_bytes() == npz[name].read_bytes()


@pytest.mark.full
def test_an_exr_set_is_checked_as_an_npz_set(sets):
    outcomes = []
    for folder in sets(words=("--cameras", "ALL", *WORDS)):
        done = script("check_set", folder)
        assert done.stderr == ""
        outcomes.append((done.returncode, done.stdout))
    assert outcomes[0] == outcomes[1]
    assert "Side_0001 to Top_0001" in outcomes[0][1]


@pytest.mark.cases(1)
@pytest.mark.parametrize("case", ["damaged", "missing"])
def test_an_exr_file_that_cannot_be_read_is_refused_in_one_line(command, sets, tmp_path, case):
    folder, _ = sets()
    path = folder / "small_0001.exr"
    if case == "damaged":
        path.write_bytes(path.read_bytes()[:1500])
    else:
        path.unlink()
    line = refused(command("export", folder, "--format", "depth16", "--output", tmp_path / "out"))
    assert f"small_0001.exr' {'is damaged, or cut' if case == 'damaged' else 'cannot be read: make the set'}" in line
    assert not (tmp_path / "out").exists()


def test_an_exr_set_of_a_camera_whose_time_is_an_image_has_a_preview(sets):
    """A report has no record of it."""

    def change(bpy):
        settings = bpy.data.objects["Top"].data.camera_ray_caster
        settings.time_mode, settings.time_image = "IMAGE", bpy.data.images.new("Time", 2, 2)

    exr, npz = sets(change)
    assert json.loads((exr / "report_0001.json").read_text())["record"] is None
    assert (exr / "preview.png").read_bytes() == (npz / "preview.png").read_bytes()
