"""Settings that are keyed and driven: what can be follows the frame, and what a driver gives may be no item."""

import pytest

from camera_ray_caster.blender.properties.declared import CAMERA, OBJECT, SCENE
from camera_ray_caster.blender.ui import camera_panels, facts_panels, lesson_panels
from camera_ray_caster.blender.ui.other_engine import ignored
from camera_ray_caster.blender.view3d import pixel_lessons

from .test_panels import drawn

NUMBERS = {"FLOAT", "INT", "BOOLEAN", "ENUM", "VECTOR"}
"""Kinds of settings that Blender stores as numbers: these alone can be keyed and driven."""
PANELS = (
    camera_panels.SidebarCamera, camera_panels.SidebarSettings, facts_panels.SidebarFacts, lesson_panels.SidebarLesson,
)  # fmt: skip


def other_value(setting):
    """A value of a setting that is not its default."""
    if setting.kind == "ENUM":
        return next(item.key for item in setting.items if item.key != setting.default)
    if setting.kind == "BOOLEAN":
        return not setting.default
    if setting.kind == "VECTOR":
        return tuple(number + 0.25 for number in setting.default)
    step = 1 if setting.kind == "INT" else 0.25
    return setting.default + step if setting.default + step <= setting.high else setting.default - step


def value_of(group, name):
    """The value of a setting, which does not follow the setting."""
    value = getattr(group, name)
    return value if isinstance(value, str | bool | int | float) else tuple(value)


@pytest.mark.parametrize("kind", ["camera", "object", "scene"])
def test_what_is_a_number_is_keyed_and_follows_the_frame_and_nothing_else_can_be(blender, scene, kind):
    ball = next(item for item in scene.objects if item.type == "MESH")
    owner, settings = {"camera": (scene.camera.data, CAMERA), "object": (ball, OBJECT), "scene": (scene, SCENE)}[kind]
    stored = owner.camera_ray_caster
    wanted = {}
    for setting in settings:
        declared = stored.bl_rna.properties[setting.name]
        assert declared.is_animatable is (setting.kind in NUMBERS), setting.name
        if setting.kind not in NUMBERS:
            with pytest.raises(TypeError, match="not animatable"):
                stored.keyframe_insert(setting.name)
            continue
        first = value_of(stored, setting.name)
        stored.keyframe_insert(setting.name, frame=1)
        setattr(stored, setting.name, other_value(setting))
        stored.keyframe_insert(setting.name, frame=2)
        wanted[setting.name] = first, value_of(stored, setting.name)
    for frame in (1, 2):
        scene.frame_set(frame)
        evaluated = owner.evaluated_get(blender.context.evaluated_depsgraph_get()).camera_ray_caster
        for name, values in wanted.items():
            for group in (stored, evaluated):
                assert value_of(group, name) == values[frame - 1], name
    assert len(wanted) == sum(setting.kind in NUMBERS for setting in settings)


def test_a_button_beside_the_menu_which_cannot_be_keyed_keys_the_model(blender, scene):
    assert "camera_ray_caster.key_model" in drawn(blender, camera_panels.SidebarCamera).split()
    settings = scene.camera.data.camera_ray_caster
    for frame, model in ((1, "OMNIMAX"), (5, "PENCIL")):
        scene.frame_set(frame)
        settings.model = model
        blender.ops.camera_ray_caster.key_model()
    for frame, model in ((1, "OMNIMAX"), (5, "PENCIL")):
        scene.frame_set(frame)
        assert settings.model == model


def test_the_button_adds_a_driver_with_shift_that_keeps_the_model_until_it_is_edited(blender, scene):
    data = scene.camera.data
    settings = data.camera_ray_caster
    settings.model = "PENCIL"
    assert blender.ops.camera_ray_caster.key_model(driver=True) == {"FINISHED"}
    blender.context.view_layer.update()
    assert settings.model == "PENCIL"
    (curve,) = data.animation_data.drivers
    number = settings.bl_rna.properties["model"].enum_items["OMNIMAX"].value
    curve.driver.expression = str(number)
    blender.ops.camera_ray_caster.key_model(driver=True)
    assert [curve.driver.expression for curve in data.animation_data.drivers] == [str(number)]
    scene.frame_set(3)
    assert settings.model == "OMNIMAX"


@pytest.mark.parametrize("name", ["model", "time_mode", "shading", "primitive", "fov"])
def test_a_driver_that_gives_no_item_is_told_and_one_that_is_muted_drives_nothing(blender, scene, name):
    ball = next(item for item in scene.objects if item.name == "Sphere")
    owners = {"shading": scene, "primitive": ball}
    settings = owners.get(name, scene.camera.data).camera_ray_caster
    scene.camera.data.camera_ray_caster.model = "DOME_MASTER"
    before, curve = getattr(settings, name), settings.driver_add(name)
    curve.driver.expression, curve.mute = "99", True
    scene.frame_set(2)
    assert getattr(settings, name) == before
    curve.mute = False
    scene.frame_set(3)
    assert getattr(settings, name) != before
    pixel_lessons.clicked.choose([(3, 3)])
    try:
        for panel in PANELS:
            drawn(blender, panel)
    finally:
        pixel_lessons.forget()
    assert "know :" not in ignored(scene, scene.camera)
    if name in ("model", "time_mode", "shading"):
        with pytest.raises(RuntimeError, match="must be one of"):
            blender.ops.camera_ray_caster.cast()
    else:
        assert blender.ops.camera_ray_caster.cast() == {"FINISHED"}
