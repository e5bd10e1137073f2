"""What the panels draw, without a window."""

import math
from ast import literal_eval

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


def drawn(blender, panel, layout=None):
    """Draw a panel as Blender does, and return what it says; with a ``layout`` of one's own, nothing."""
    layout = layout or Layout()
    context = blender.context.copy() | {"region": type("Region", (), {"width": 300})}
    context["evaluated_depsgraph_get"] = blender.context.evaluated_depsgraph_get
    context = type("Context", (), {name: staticmethod(v) if callable(v) else v for name, v in context.items()})
    panel.draw(type("Panel", (), {"layout": layout}), context)
    return " ".join(layout.said) if isinstance(layout, Layout) else ""


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
    sidebar = [camera_panels.SidebarCamera, verify, *cast_panels.CLASSES[1:], overlay_panels.SidebarOverlay]
    popovers = cast_panels.CastReport, verify_panels.VerifyErrors
    assert "camera_ray_caster.see_through" not in drawn(blender, camera_panels.SidebarCamera)  # there is no view
    labels = drawn(blender, facts_panels.SidebarFacts)
    eye, copy = "Eye X 0 m Y 0 m Z 6 m", "camera_ray_caster.copy_k"
    for text in (eye, "24 × 16 px", "39.6°", "Distance d", "2.77778", "K", copy):
        assert text in labels
    group = scene.camera.data.camera_ray_caster
    group.model = "PUSHBROOM"
    settings = drawn(blender, camera_panels.SidebarSettings).split()
    assert {"ortho_scale", "lens", "shift_x", "time_mode"} <= set(settings)  # there is no lens panel there
    assert "slit_1" not in settings, "a missing object is drawn once"
    assert "slit_1" in drawn(blender, camera_panels.SidebarCamera)
    blender.ops.camera_ray_caster.add_line(setting="slit_1")
    assert "slit_1" in drawn(blender, camera_panels.SidebarSettings)
    group.model = "BLENDER"
    blender.ops.camera_ray_caster.cast()
    for panel in (*sidebar, camera_panels.SidebarSettings, *popovers):
        drawn(blender, panel)
    assert "Suzanne" in drawn(blender, left_out_panels.LeftOut)
    assert "'Sphere': the exact shape is up to 0.96% of" in drawn(blender, cast_panels.CastReport)
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
    assert drawn(blender, left_out_panels.LeftOut).split()[-6:] == [
        "Select", "1", "Object", "camera_ray_caster.select", "Suzanne", "primitive",
    ]  # fmt: skip
    blender.data.objects["Suzanne"].name = "Renamed"
    assert "primitive" not in drawn(blender, left_out_panels.LeftOut)
    assert not object_panels.ObjectPanel.poll(blender.context)  # the camera is active
    blender.context.view_layer.objects.active = blender.data.objects["Renamed"]
    assert object_panels.ObjectPanel.poll(blender.context)
    assert drawn(blender, object_panels.ObjectPanel) == "primitive"
    items = blender.data.objects["Renamed"].camera_ray_caster.bl_rna.properties["primitive"].enum_items
    numbers = {item.identifier: item.value for item in items}
    assert numbers.items() >= {
        "AUTOMATIC": 0, "SPHERE": 1, "PLANE": 2, "INFINITE_PLANE": 3, "IGNORE": 4, "MESH": 5,
    }.items()  # fmt: skip
    assert len(set(numbers.values())) == len(numbers)  # a .blend stores the number


def test_the_panels_say_how_right_the_hits_are(blender, scene):
    from camera_ray_caster.blender.ui import cast_panels, render_panels

    blender.ops.camera_ray_caster.cast()
    accuracy = reports.latest().accuracy
    assert accuracy.hits > 0
    assert 0 < reports.latest().seconds["accuracy"] < sum(reports.latest().seconds.values())
    median, worst = (f"≤ {getattr(accuracy, name)('relative_distance'):.0e}" for name in ("median", "worst"))
    assert f"Median {median} Worst {worst}" in drawn(blender, cast_panels.CastReport)
    assert " s: 384 rays, 1 shape" in drawn(blender, cast_panels.SidebarCast)
    assert f"Worst distance error: {worst}" in drawn(blender, render_panels.RenderPanel)
    scene.camera.location.z = -6  # it looks away from all there is
    blender.ops.camera_ray_caster.cast()
    assert "Worst nothing hit" in drawn(blender, cast_panels.CastReport)


def test_the_render_panel_leads_to_cycles_and_the_passes_have_the_alpha_threshold(blender, scene):
    from camera_ray_caster.blender.ui import render_panels

    text = drawn(blender, render_panels.RenderPanel)
    assert "Cycles renders materials and light" in text
    assert "camera_ray_caster.use_in_cycles" in text
    assert "use_pass_albedo pass_alpha_threshold" in " ".join(
        word for word in drawn(blender, render_panels.PassesPanel).split()
        if word in {"use_pass_albedo", "pass_alpha_threshold"}
    )  # fmt: skip


def test_sentences_of_a_lesson_begin_with_a_capital_and_formulas_as_they_are(blender, scene):
    from camera_ray_caster.blender.ui.lesson_panels import SidebarLesson
    from camera_ray_caster.blender.view3d import pixel_lessons

    pixel_lessons.clicked.choose([(12, 8)])
    text = drawn(blender, SidebarLesson)
    assert "Unit normal" in text
    assert "u = (1, 0, 0)" in text
    assert "U = " not in text
    pixel_lessons.forget()


def test_step_through_names_the_objects_that_a_render_shows_otherwise(blender, scene):
    from camera_ray_caster.blender.ui.lesson_panels import SidebarLesson
    from camera_ray_caster.blender.view3d import pixel_lessons

    pixel_lessons.clicked.choose([(12, 8)])
    assert "as in the viewport" not in drawn(blender, SidebarLesson)
    for name in "ABCD":
        blender.ops.mesh.primitive_cube_add(location=(50, 0, 0))
        blender.context.object.name = name
        blender.context.object.modifiers.new("Subdivision", "SUBSURF")  # 1 level, 2 in a render
    assert "a render shows these otherwise: A, B, C and 1 more" in drawn(blender, SidebarLesson)
    pixel_lessons.forget()


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
    text = drawn(blender, SidebarVerify)
    assert "All reference checks passed" in text
    assert "has changed" not in text
    scene.camera.location.x = 1
    assert "has changed since" in drawn(blender, SidebarVerify)


@pytest.mark.parametrize("how", ["cast", "render"])
def test_results_are_shown_in_their_own_scene_only(blender, scene, how):
    from camera_ray_caster.blender.ui import cast_panels, left_out_panels, render_panels, verify_panels

    def shown():
        panels = left_out_panels.LeftOut, cast_panels.CastReport
        all_panels = (cast_panels.SidebarCast, render_panels.RenderPanel, verify_panels.SidebarVerify)
        texts = " ".join(drawn(blender, panel) for panel in all_panels)
        ops = blender.ops.camera_ray_caster.select, blender.ops.camera_ray_caster.write_report
        return [
            *(panel.poll(blender.context) for panel in panels),
            texts.count("rays, ") == 2,
            "passed" in texts,
            *(operator.poll() for operator in ops),
        ]

    scene.render.engine = "CAMERA_RAY_CASTER"
    (blender.ops.camera_ray_caster.cast if how == "cast" else blender.ops.render.render)()
    assert shown() == [True] * 6
    window = blender.context.window
    window.scene = blender.data.scenes.new("Other")
    assert shown() == [False] * 6
    window.scene.camera = scene.camera
    blender.ops.camera_ray_caster.verify()
    assert shown() == [False] * 3 + [True] + [False] * 2
    window.scene = scene
    scene.name = "Renamed"
    assert shown() == [True] * 6


@pytest.mark.parametrize(
    ("system", "unit", "meters", "text"),
    [
        ("METRIC", "ADAPTIVE", 1.2345678, "1.23457 m"),
        ("METRIC", "ADAPTIVE", 0.0123456, "1.23456 cm"),
        ("METRIC", "ADAPTIVE", -1e-9, "0 m"),
        ("METRIC", "METERS", 0.0123456, "0.012346 m"),
        ("METRIC", "METERS", -4.371e-8, "0 m"),
        ("METRIC", "CENTIMETERS", 1.2345678, "123.457 cm"),
        ("METRIC", "MILLIMETERS", 6000.0, "6000000 mm"),
        ("METRIC", "MICROMETERS", 0.0123456, "12345.6 µm"),
        ("METRIC", "KILOMETERS", -6.0, "-0.006 km"),
        ("IMPERIAL", "FEET", 0.3048 * 1.5, "1.5'"),
        ("IMPERIAL", "INCHES", 0.3048, '12"'),
        ("IMPERIAL", "MILES", 1609.344, "1 mi"),
        ("IMPERIAL", "THOU", 0.0254, "1000 thou"),
        ("NONE", "METERS", 1.2345678, "1.23457"),
        ("NONE", "METERS", -0.0, "0"),
    ],
)
def test_lengths_are_in_the_unit_of_the_scene(blender, system, unit, meters, text):
    from camera_ray_caster.blender.read.lengths import length

    units = blender.context.scene.unit_settings
    units.system = system
    if system != "NONE":
        units.length_unit = unit
    assert length(blender.context, meters) == text
    units.scale_length = 0.5
    assert length(blender.context, meters if system == "NONE" else 2 * meters) == text


def test_every_unit_of_blender_is_known_with_its_length(blender):
    from camera_ray_caster.blender.read.lengths import UNITS

    units, known = blender.context.scene.unit_settings, set()
    for units.system in ("METRIC", "IMPERIAL"):
        with pytest.raises(TypeError) as caught:
            units.length_unit = "none of them"
        known |= set(literal_eval(str(caught.value).partition(" not found in ")[2]))
    assert known == {"ADAPTIVE", *UNITS}
    for name, (meters, sign) in UNITS.items():
        for word in (sign, name.lower()):
            assert blender.utils.units.to_value("METRIC", "LENGTH", f"1{word}") == pytest.approx(meters, rel=1e-6)


def test_what_rounds_to_zero_has_no_sign(blender, scene):
    from camera_ray_caster.blender.ui.facts_panels import SidebarFacts
    from camera_ray_caster.blender.view3d.mouse_gizmo import _lines
    from camera_ray_caster.core.lesson.diagram import Probe

    scene.camera.rotation_euler = (-1e-6, 1e-6, 1e-6)
    scene.camera.location.x = -1e-9
    words = drawn(blender, SidebarFacts).split()
    assert "-0.0000" not in words
    assert "-0" not in words
    assert "0.0000" in words
    small = (-1e-6, 1e-6, -1.0)
    probe = Probe((0, 0), view=small[:2], origin=small, direction=small, distance=math.inf, name="", shape_index=0)
    assert dict(_lines(blender.context, probe))["View"] == "0.0000, 0.0000"
    assert dict(_lines(blender.context, probe))["Direction"] == "0.0000, 0.0000, -1.0000"


def test_rays_in_the_status_bar_have_a_separator(blender, scene, capfd):
    scene.render.resolution_x = scene.render.resolution_y = 40
    blender.ops.camera_ray_caster.cast()
    assert "1,600 rays cast" in "".join(capfd.readouterr())


def test_results_are_named_as_passes_are(blender, scene):
    from camera_ray_caster.blender.properties import pass_properties
    from camera_ray_caster.blender.ui.show_result import ResultsMenu

    keys = ["combined", "uv", "object_index", "distance", "distance_bound"]
    pass_properties.tick(scene, blender.context.view_layer, keys)
    blender.ops.camera_ray_caster.cast()
    text = drawn(blender, ResultsMenu)
    for label in (entry.label for entry in pass_properties.PASSES if entry.key in keys):
        assert f"{label} camera_ray_caster.show_result" in text
    scene.render.use_multiview = True
    blender.ops.camera_ray_caster.cast()
    assert "Distance Bound left camera_ray_caster.show_result" in drawn(blender, ResultsMenu)


def test_the_dialogs_show_calibration_files_and_say_what_the_target_is(blender):
    operators = blender.ops.camera_ray_caster.load_calibration, blender.ops.camera_ray_caster.export
    load, export = (operator.get_rna_type().properties for operator in operators)
    kinds = "yml yaml json jsonl xml gz txt bin cameramodel sfm pincam npz npy exr csv obj pto pts cahv* fspy xmp nvm"
    kinds += " out toml"
    assert set(load["filter_glob"].default.split(";")) == {f"*.{kind}" for kind in kinds.split()}
    assert export["target"].name == "Target Camera"
