"""Undo and redo of every operator that is registered with UNDO, each called as from its button."""

import bpy
import numpy as np
import pytest

from camera_ray_caster.blender.output import reports
from camera_ray_caster.blender.properties.declared import CAMERA
from camera_ray_caster.blender.registration import CLASSES
from camera_ray_caster.blender.ui.presets import FOLDER
from camera_ray_caster.blender.view3d import pixel_lessons
from camera_ray_caster.core.sets.png import png

OURS = bpy.ops.camera_ray_caster
IN_A_VIEW = {"see_through", "select_seen"}
"""Operators of a 3D View, in which Blender cannot undo without a window: see test_see_through.py, and the scenario
``click_seen``.
"""
PLAIN = ("FLOAT", "INT", "BOOLEAN", "ENUM", "TEXT", "FILE")


def change_settings(**values):
    """Set the scene's camera's own settings."""
    for name, value in values.items():
        setattr(bpy.context.scene.camera.data.camera_ray_caster, name, value)


def second_camera(folder):
    other = bpy.data.objects.new("Second", bpy.data.cameras.new("Second"))
    bpy.context.scene.collection.objects.link(other)
    return {"name": "Second"}


def with_slit(folder):
    change_settings(model="PUSHBROOM")
    OURS.add_line(setting="slit_1")
    return {"setting": "slit_1"}


def without_slit(folder):
    change_settings(model="PUSHBROOM")
    return {"setting": "slit_1"}


def in_cycles(folder):
    change_settings(model="OMNIMAX")
    OURS.use_in_cycles()
    return {}


def stretched(folder):
    camera = bpy.context.scene.camera.data
    camera.type, camera.panorama_type = "PANO", "FISHEYE_EQUIDISTANT"
    return {}


def calibration(folder):
    (folder / "cameras.txt").write_text("1 PINHOLE 1241 376 700 700 620 188\n")
    return {"filepath": str(folder / "cameras.txt")}


def clip(folder):
    (folder / "plate.png").write_bytes(png(np.zeros((24, 32, 3), np.uint8)))
    bpy.context.scene.active_clip = bpy.data.movieclips.load(str(folder / "plate.png"))


def cameras(folder):
    OURS.export(filepath=str(folder / "out"), format="json")
    return {"filepath": str(folder / "out" / "camera.json")}


def cast(folder):
    OURS.cast()
    return {}


def left_out(folder):
    OURS.cast()
    return {"reason": next(iter(reports.by_reason(reports.latest())))}


def workbench(folder):
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
    return {}


def a_pixel(folder):
    pixel_lessons.clicked.choose([(12, 8)])
    return {}


CALLS = {
    "add_line": without_slit,
    "select_line": with_slit,
    "add_gradient": lambda folder: change_settings(time_mode="IMAGE"),
    "use_camera": second_camera,
    "points_to_mesh": lambda folder: None,
    "use_in_cycles": lambda folder: change_settings(model="OMNIMAX"),
    "back_to_blender": in_cycles,
    "choose_lens": lambda folder: change_settings(model="REAL_LENS") or {"name": "tessar_100mm"},
    "own_focal_length": lambda folder: change_settings(model="REAL_LENS"),
    "fit_lens": lambda folder: change_settings(model="OPENCV_PINHOLE"),
    "add_projector": lambda folder: change_settings(model="OMNIMAX"),
    "follow_timeline": lambda folder: change_settings(time_mode="ROWS"),
    "set_frame": stretched,
    "append_camera": lambda folder: {"name": "cross_slit"},
    "key_model": lambda folder: {},
    "choose_type": lambda folder: {"key": "OMNIMAX"},
    "load_calibration": calibration,
    "select": left_out,
    "write_report": cast,
    "use_this_engine": workbench,
    "empty_at_hit": a_pixel,
    "preset_execute": lambda folder: {"filepath": str(next(FOLDER.glob("presets/*/TUM_VI*.py")))},
    "add_cameras": cameras,
    "lens_of_clip": clip,
}
"""What has to be there before an operator is called, which returns the operator's properties."""


def state():
    """What operators may change, in words and numbers: undo makes new objects of Python."""
    scene, layer = bpy.context.scene, bpy.context.view_layer
    objects = {
        item.name: (item.type, item.parent and item.parent.name, [*map(tuple, item.matrix_world)], item.select_get())
        for item in layer.objects
    }
    lenses = {}
    for data in bpy.data.cameras:
        group, moves = data.camera_ray_caster, data.animation_data
        lenses[data.name] = {setting.name: getattr(group, setting.name) for setting in CAMERA if setting.kind in PLAIN}
        lenses[data.name] |= {"drivers": len(moves.drivers) if moves else 0, "lens": data.lens}
        lenses[data.name] |= {"keyed": moves is not None and moves.action is not None}
        lenses[data.name] |= {"type": (data.type, data.panorama_type), "slit": group.slit_1 and group.slit_1.name}
    render = scene.render
    frame = render.engine, render.resolution_x, render.resolution_y, scene.camera.name
    named = [sorted(item.name for item in kind) for kind in (bpy.data.texts, bpy.data.meshes, bpy.data.objects)]
    images = sorted(image.name for image in bpy.data.images)
    return objects, lenses, frame, named, images, layer.objects.active and layer.objects.active.name


def test_every_operator_with_undo_is_called_here():
    names = {operator.bl_idname.rpartition(".")[2] for operator in CLASSES
             if issubclass(operator, bpy.types.Operator) and "UNDO" in operator.bl_options}  # fmt: skip
    assert names == CALLS.keys() | IN_A_VIEW


@pytest.mark.parametrize("name", CALLS)
def test_what_an_operator_changed_is_undone_and_redone(blender, scene, tmp_path, request, name):
    if name in ("use_in_cycles", "back_to_blender"):
        request.getfixturevalue("osl")
    properties = CALLS[name](tmp_path) or {}
    blender.context.view_layer.update()
    blender.ops.ed.undo_push(message="before")
    before = state()
    assert getattr(OURS, name)("EXEC_DEFAULT", True, **properties) == {"FINISHED"}
    blender.context.view_layer.update()
    after = state()
    assert after != before
    pixel_lessons.forget()
    for step, expected in ((blender.ops.ed.undo, before), (blender.ops.ed.redo, after), (blender.ops.ed.undo, before)):
        step()
        blender.context.view_layer.update()
        assert state() == expected
