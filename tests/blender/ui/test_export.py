"""Exports and matrices by Blender's operators."""

import json
import re
from time import sleep
from types import SimpleNamespace

import numpy as np
import pytest

from camera_ray_caster.blender.read.scene_reader import read_camera
from camera_ray_caster.blender.ui import export_operators, in_process
from camera_ray_caster.core.exports import EXPORT_FORMATS
from camera_ray_caster.core.exports.camera_json import camera_from_json

from .test_panels import Layout


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.fixture
def rig_scene(blender, scene):
    """Two cameras; the second one is selected, the first one active."""
    scene.camera.name = "First"
    blender.ops.object.camera_add(location=(1, 2, 3))
    blender.context.object.name = "Second"
    scene.frame_start, scene.frame_end, scene.frame_step = 1, 9, 4
    return scene


@pytest.mark.parametrize(
    ("cameras", "frames", "written"),
    [
        ("ACTIVE", "CURRENT", ["First_0001"]),
        ("SELECTED", "CURRENT", ["Second_0001"]),
        ("ALL", "RANGE", [f"{name}_000{frame}" for name in ("First", "Second") for frame in (1, 5, 9)]),
    ],
)
def test_the_chosen_cameras_and_frames_are_written(blender, rig_scene, tmp_path, cameras, frames, written):
    folder = str(tmp_path / "out")
    done = blender.ops.camera_ray_caster.export(filepath=folder, format="mrcal", cameras=cameras, frames=frames)
    assert done == {"FINISHED"}
    assert names(tmp_path / "out") == [f"{name}.cameramodel" for name in written]


def test_a_map_may_lead_to_another_camera(blender, rig_scene, tmp_path):
    blender.ops.camera_ray_caster.export(filepath=str(tmp_path), format="stmap", target="Second")
    assert names(tmp_path) == ["First_0001_distort.exr", "First_0001_undistort.exr"]


def test_what_cannot_be_written_is_an_error_in_one_line(blender, rig_scene, tmp_path):
    rig_scene.camera.data.type = "ORTHO"
    with pytest.raises(RuntimeError, match="COLMAP cannot represent the Orthographic of camera 'First': choose one of"):
        blender.ops.camera_ray_caster.export(filepath=str(tmp_path), format="colmap")
    blender.ops.object.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="o camera is selected"):
        blender.ops.camera_ray_caster.export(filepath=str(tmp_path), format="json", cameras="SELECTED")
    with pytest.raises(RuntimeError, match="no camera 'Third'"):
        blender.ops.camera_ray_caster.export(filepath=str(tmp_path), format="stmap", target="Third")
    assert names(tmp_path) == []


@pytest.mark.full
def test_the_nearest_lens_is_written_and_its_error_said_last(blender, rig_scene, tmp_path):
    rig_scene.render.resolution_x, rig_scene.render.resolution_y, rig_scene.frame_end = 24, 18, rig_scene.frame_start
    settings = rig_scene.camera.data.camera_ray_caster
    settings.model, settings.fx, settings.fy, settings.cx, settings.cy = "DOUBLE_SPHERE", 11, 11, 11.5, 8.5
    settings.calibration_width, settings.calibration_height = 24, 18
    options = {"filepath": str(tmp_path), "format": "opencv"}
    with pytest.raises(RuntimeError, match=r"cannot represent the Double Sphere .*, or Fit Nearest Lens"):
        blender.ops.camera_ray_caster.export(**options)
    blender.ops.camera_ray_caster.export(**options, fit=True, fit_within=1.0, in_process=True, frames="RANGE")
    while in_process.tick() is not None:
        sleep(0.05)
    words = r"First: fitted to its Double Sphere, within 57.3 degrees of the viewing direction: .* mean [\d.e-]+ pixels"
    wrote, *remarks = in_process.latest().splitlines()
    assert wrote.startswith("Wrote ")
    (error,) = [line for line in remarks if re.match(words, line)]
    assert error in next(tmp_path.glob("First*.yml")).read_text()


def test_only_formats_of_lenses_offer_the_nearest_one(blender):
    offered = {}
    for export in EXPORT_FORMATS:
        layout = Layout()
        operator = type("Operator", (), {"layout": layout, "format": export.key, "fit": False})
        export_operators.Export.draw(operator, blender.context)
        offered[export.key] = {"fit", "fit_within"} <= set(layout.said)
    assert not any(offered[key] for key in ("tum", "kitti", "euroc", "stmap", "npz", "json"))
    assert all(offered[key] for key in ("opencv", "ros", "colmap", "nerfstudio", "kalibr", "mrcal"))


def test_every_format_can_be_chosen_and_says_what_it_is(blender):
    properties = blender.ops.camera_ray_caster.export.get_rna_type().properties
    items = properties["format"].enum_items
    assert [(item.identifier, item.name, item.description) for item in items] == [
        (export.key, export.label, export.description) for export in EXPORT_FORMATS
    ]
    assert export_operators._draw_in_file_menu in blender.types.TOPBAR_MT_file_export._dyn_ui_initialize()


@pytest.fixture
def copied(monkeypatch, blender, scene):
    """A function that runs an operator's ``execute`` and returns what it has put on the clipboard: without a window
    there is none.
    """

    class Own:
        clipboard = ""

    class Context:
        window_manager = Own()
        scene = blender.context.scene

    def run(operator):
        assert operator.execute(operator, Context) == {"FINISHED"}
        return Context.window_manager.clipboard

    return run


def test_matrices_are_copied_with_all_digits(blender, scene, copied):
    from camera_ray_caster.blender.ui.operators import CopyFacts

    scene.camera.rotation_euler = 0.3, 0.2, 0.1
    scene.camera.data.lens = 33.3
    camera = read_camera(scene)
    assert np.array_equal(json.loads(copied(export_operators.CopyK)), camera.K)
    assert np.array_equal(json.loads(copied(export_operators.CopyWorldToCamera)), camera.opencv_from_world)
    assert camera_from_json(copied(CopyFacts)).rays().directions.tobytes() == camera.rays().directions.tobytes()


def test_a_camera_without_k_says_so(blender, scene):
    scene.camera.data.type = "ORTHO"
    with pytest.raises(RuntimeError, match="Orthographic has no K"):
        blender.ops.camera_ray_caster.copy_k()


def test_a_dialog_proposes_no_folder_of_another_format(blender):
    known = blender.ops.camera_ray_caster.export.get_rna_type().properties["filepath"]
    assert known.is_skip_save
    assert known.subtype == "FILE_PATH"


def test_the_dialog_s_folder_is_named_after_the_format(tmp_path):
    dialog = SimpleNamespace(filepath=str(tmp_path / "room_json"), format="json")
    check = export_operators.Export.check
    assert not check(dialog, None), "as proposed"
    dialog.format = "colmap"
    assert check(dialog, None)
    assert dialog.filepath == str(tmp_path / "room_colmap")
    dialog.filepath, dialog.format = str(tmp_path / "mine"), "npz"
    assert not check(dialog, None)
    assert dialog.filepath == str(tmp_path / "mine"), "a name of the user's"
