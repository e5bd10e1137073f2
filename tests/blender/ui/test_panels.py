"""What the panels draw, without a window."""

import pytest

from camera_ray_caster.blender.output import reports


class Layout:
    """Stands for Blender's layout: it takes everything and notes the text, the operators and the properties."""

    def __init__(self):
        self.said = []

    def __getattr__(self, name):
        def call(*arguments, **keywords):
            self.said += [keywords["text"]] if keywords.get("text") else []
            self.said += {"operator": arguments, "prop": arguments[1:]}.get(name, ())
            return (self, self) if name == "panel" else self

        return call


def drawn(blender, panel):
    """Draw a panel as Blender does, and return what it says."""
    layout = Layout()
    context = blender.context.copy() | {"region": type("Region", (), {"width": 300})}
    context["evaluated_depsgraph_get"] = blender.context.evaluated_depsgraph_get
    context = type("Context", (), {name: staticmethod(v) if callable(v) else v for name, v in context.items()})
    panel.draw(type("Panel", (), {"layout": layout}), context)
    return " ".join(layout.said)


def test_the_panels_say_what_the_camera_is_and_why_it_is_none(blender, scene):
    from camera_ray_caster.blender.ui import (
        camera_panels,
        cast_panels,
        facts_panels,
        left_out_panels,
        overlay_panels,
        verify_panels,
    )

    verify = verify_panels.SidebarVerify
    sidebar = [camera_panels.SidebarCamera, verify, *cast_panels.CLASSES[:3], overlay_panels.SidebarOverlay]
    assert "camera_ray_caster.see_through" not in drawn(blender, camera_panels.SidebarCamera)  # there is no view
    said = drawn(blender, facts_panels.SidebarFacts)
    for text in ("Eye", "6 m", "24 × 16 px", "39.6°", "Distance d", "2.77778", "K", "camera_ray_caster.copy_k"):
        assert text in said
    own = scene.camera.data.camera_ray_caster
    own.model = "PUSHBROOM"
    settings = drawn(blender, camera_panels.SidebarSettings).split()
    assert {"ortho_scale", "lens", "shift_x", "time_mode"} <= set(settings)  # there is no lens panel there
    assert "slit_1" not in settings, "a missing object is drawn once"
    assert "slit_1" in drawn(blender, camera_panels.SidebarCamera)
    blender.ops.camera_ray_caster.add_line(setting="slit_1")
    assert "slit_1" in drawn(blender, camera_panels.SidebarSettings)
    own.model = "BLENDER"
    blender.ops.camera_ray_caster.cast()
    for panel in (*sidebar, camera_panels.SidebarSettings, *cast_panels.CLASSES[3:]):
        drawn(blender, panel)
    assert "Suzanne" in drawn(blender, left_out_panels.SidebarLeftOut)
    assert "All reference checks passed" in drawn(blender, verify)
    scene.camera.location.x = 1
    assert "has changed since" in drawn(blender, verify)
    scene.camera = None
    assert "no active camera" in drawn(blender, camera_panels.SidebarCamera)
    for panel in sidebar:
        drawn(blender, panel)


def test_cast_as_stands_in_the_objects_properties_and_beside_what_was_left_out(blender, scene):
    from camera_ray_caster.blender.ui import left_out_panels, object_panels

    blender.ops.camera_ray_caster.cast()
    assert drawn(blender, left_out_panels.SidebarLeftOut).split()[-6:] == [
        "Select", "1", "Object", "camera_ray_caster.select", "Suzanne", "primitive",
    ]  # fmt: skip
    blender.data.objects["Suzanne"].name = "Renamed"
    assert "primitive" not in drawn(blender, left_out_panels.SidebarLeftOut)
    assert not object_panels.ObjectPanel.poll(blender.context)  # the camera is active
    blender.context.view_layer.objects.active = blender.data.objects["Renamed"]
    assert object_panels.ObjectPanel.poll(blender.context)
    assert drawn(blender, object_panels.ObjectPanel) == "primitive"
    items = blender.data.objects["Renamed"].camera_ray_caster.bl_rna.properties["primitive"].enum_items
    assert {item.identifier: item.value for item in items} == {
        "AUTOMATIC": 0, "SPHERE": 1, "PLANE": 2, "INFINITE_PLANE": 3, "IGNORE": 4, "MESH": 5,
    }  # fmt: skip


def test_the_panels_say_how_right_the_hits_are(blender, scene):
    from camera_ray_caster.blender.ui import cast_panels, render_panels

    blender.ops.camera_ray_caster.cast()
    found = reports.latest().accuracy
    assert found.hits > 0
    assert 0 < reports.latest().seconds["accuracy"] < sum(reports.latest().seconds.values())
    median, worst = (f"≤ {getattr(found, name)('relative_distance'):.0e}" for name in ("median", "worst"))
    assert f"Median {median} Worst {worst}" in drawn(blender, cast_panels.SidebarReport)
    assert "384 rays at 1 shape in" in drawn(blender, cast_panels.SidebarCast)
    assert f"Worst distance error: {worst}" in drawn(blender, render_panels.RenderPanel)
    scene.camera.location.z = -6  # it looks away from all there is
    blender.ops.camera_ray_caster.cast()
    assert "Worst nothing hit" in drawn(blender, cast_panels.SidebarReport)


def test_sentences_of_a_lesson_begin_with_a_capital_and_formulas_as_they_are(blender, scene):
    from camera_ray_caster.blender.ui.lesson_panels import SidebarLesson
    from camera_ray_caster.blender.view3d import lesson

    lesson.pixels[:] = [(12, 8)]
    said = drawn(blender, SidebarLesson)
    assert "Unit normal" in said
    assert "u = (1, 0, 0)" in said
    assert "U = " not in said
    lesson.forget()


def test_step_through_names_the_objects_that_a_render_shows_otherwise(blender, scene):
    from camera_ray_caster.blender.ui.lesson_panels import SidebarLesson
    from camera_ray_caster.blender.view3d import lesson

    lesson.pixels[:] = [(12, 8)]
    assert "as in the viewport" not in drawn(blender, SidebarLesson)
    for name in "ABCD":
        blender.ops.mesh.primitive_cube_add(location=(50, 0, 0))
        blender.context.object.name = name
        blender.context.object.modifiers.new("Subdivision", "SUBSURF")  # 1 level, 2 in a render
    assert "a render shows these otherwise: A, B, C and 1 more" in drawn(blender, SidebarLesson)
    lesson.forget()


@pytest.mark.parametrize("views_format", ["STEREO_3D", "MULTIVIEW"])
@pytest.mark.parametrize("how", ["cast", "render"])
def test_the_verdict_on_both_eyes_stands_until_the_camera_changes(blender, scene, views_format, how):
    from camera_ray_caster.blender.ui.verify_panels import SidebarVerify

    scene.render.use_multiview, scene.render.views_format = True, views_format
    scene.render.engine, scene.camera.data.stereo.pivot = "CAMERA_RAY_CASTER", "CENTER"
    scene.camera.name = "Camera_R"  # the second eye in the Multi-View format
    other = blender.data.objects.new("Camera_L", scene.camera.data)
    other.location = (-0.5, 0, 6)
    scene.collection.objects.link(other)
    (blender.ops.camera_ray_caster.cast if how == "cast" else blender.ops.render.render)()
    assert len(reports.verified().findings) > 0
    assert reports.latest().camera["eye"] != reports.verified().camera["eye"] == list(scene.camera.location)
    said = drawn(blender, SidebarVerify)
    assert "All reference checks passed" in said
    assert "has changed" not in said
    scene.camera.location.x = 1
    assert "has changed since" in drawn(blender, SidebarVerify)


@pytest.mark.parametrize("how", ["cast", "render"])
def test_results_are_shown_in_their_own_scene_only(blender, scene, how):
    from camera_ray_caster.blender.ui import cast_panels, left_out_panels, render_panels, verify_panels

    def shown():
        panels = left_out_panels.SidebarLeftOut, cast_panels.SidebarReport
        said = (cast_panels.SidebarCast, render_panels.RenderPanel, verify_panels.SidebarVerify)
        texts = " ".join(drawn(blender, panel) for panel in said)
        ops = blender.ops.camera_ray_caster.select, blender.ops.camera_ray_caster.write_report
        return [
            *(panel.poll(blender.context) for panel in panels),
            *(text in texts for text in ("rays at", "rays in", "passed")),
            *(operator.poll() for operator in ops),
        ]

    scene.render.engine = "CAMERA_RAY_CASTER"
    (blender.ops.camera_ray_caster.cast if how == "cast" else blender.ops.render.render)()
    assert shown() == [True] * 7
    window = blender.context.window
    window.scene = blender.data.scenes.new("Other")
    assert shown() == [False] * 7
    window.scene.camera = scene.camera
    blender.ops.camera_ray_caster.verify()
    assert shown() == [False] * 4 + [True] + [False] * 2
    window.scene = scene
    scene.name = "Renamed"
    assert shown() == [True] * 7
