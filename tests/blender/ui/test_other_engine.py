"""What engines that do not know a camera's model are said to render, and what a render by them says."""

import bpy
import pytest

from camera_ray_caster.blender.ui import other_engine

EEVEE = "BLENDER_EEVEE" if bpy.app.version >= (5, 0) else "BLENDER_EEVEE_NEXT"
SAID = [
    ("BLENDER_WORKBENCH", "OMNIMAX", "PERSP", "NONE", "Workbench renders a perspective view, not Omnimax"),
    ("CYCLES", "OMNIMAX", "PERSP", "NONE", "Cycles renders a perspective view, not Omnimax"),
    ("CYCLES", "CROSS_SLIT", "ORTHO", "NONE", "Cycles renders an orthographic view, not Cross-Slit"),
    ("CYCLES", "OMNIMAX", "PANO", "NONE", "Cycles renders Blender's own model, not Omnimax"),
    ("CYCLES", "BLENDER", "PERSP", "ROWS", "Cycles renders all pixels at one time"),
    (EEVEE, "BLENDER", "PANO", "NONE", "EEVEE renders a perspective view, not Fisheye Equidistant"),
    (EEVEE, "BLENDER", "PERSP", "NONE", ""),
    ("CYCLES", "BLENDER", "PANO", "NONE", ""),
    ("CAMERA_RAY_CASTER", "OMNIMAX", "PERSP", "ROWS", ""),
]


@pytest.mark.parametrize(("engine", "model", "kind", "mode", "beginning"), SAID)
def test_a_sentence_says_what_is_rendered_instead(blender, camera_scene, engine, model, kind, mode, beginning):
    data = camera_scene.camera.data
    camera_scene.render.engine = engine
    data.type, data.camera_ray_caster.model, data.camera_ray_caster.time_mode = kind, model, mode
    if kind == "PANO":
        data.panorama_type = "FISHEYE_EQUIDISTANT"
    sentence = other_engine.ignored(camera_scene, camera_scene.camera)
    assert sentence.startswith(beginning) if beginning else sentence == ""


def test_a_camera_that_cycles_knows_is_named_for_others_only(osl, blender, camera_scene):
    camera_scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    camera_scene.render.engine = EEVEE
    blender.ops.camera_ray_caster.use_in_cycles(set_engine=True)
    assert camera_scene.render.engine == "CYCLES"
    assert other_engine.ignored(camera_scene, camera_scene.camera) == ""
    camera_scene.render.engine = EEVEE
    assert "EEVEE renders a perspective view, not Omnimax" in other_engine.ignored(camera_scene, camera_scene.camera)
    assert blender.ops.camera_ray_caster.use_this_engine() == {"FINISHED"}
    assert camera_scene.render.engine == "CAMERA_RAY_CASTER"


def test_a_scene_without_a_camera_says_nothing(blender):
    blender.context.scene.render.engine = "CYCLES"
    assert other_engine.ignored(blender.context.scene, None) == ""


def test_a_render_in_a_terminal_prints_the_line(blender, camera_scene, capfd):
    camera_scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    camera_scene.render.engine = "CYCLES"
    camera_scene.cycles.samples = 1
    blender.ops.render.render()
    assert "Warning: Cycles renders a perspective view, not Omnimax" in capfd.readouterr().out
    camera_scene.render.engine = "CAMERA_RAY_CASTER"
    blender.ops.render.render()
    assert "renders" not in capfd.readouterr().out
