"""Buttons act on the camera that the panel around them shows, and never on another one that is selected."""

import pytest

OPERATORS = ("cast", "verify", "step_through", "add_line", "select_line", "choose_type", "load_calibration",
             "use_in_cycles", "back_to_blender", "pixel_of_point", "copy_facts", "copy_k",
             "export", "fit_lens")  # fmt: skip
"""Operators on a camera."""


@pytest.fixture
def two_cameras(blender, camera_scene):
    """The scene's camera, and another one, which is selected and active."""
    blender.ops.object.camera_add()
    return camera_scene.camera, blender.context.object


def settings_of(camera):
    return camera.data.camera_ray_caster


def test_the_camera_that_the_sidebar_shows_is_changed_and_not_the_selected_one(blender, two_cameras, tmp_path):
    shown, selected = two_cameras
    ops = blender.ops.camera_ray_caster
    settings_of(shown).model = settings_of(selected).model = "CROSS_SLIT"
    ops.add_line(setting="slit_1")
    assert settings_of(shown).slit_1.parent == shown
    assert settings_of(selected).slit_1 is None
    settings_of(selected).slit_1 = selected.copy()
    ops.select_line(setting="slit_1")
    assert blender.context.object == settings_of(shown).slit_1
    blender.context.view_layer.objects.active = selected
    path = tmp_path / "cameras.txt"
    path.write_text("1 PINHOLE 8 8 70 70 4 4\n")
    ops.load_calibration(filepath=str(path))
    assert (settings_of(shown).model, settings_of(selected).model) == ("OPENCV_PINHOLE", "CROSS_SLIT")
    ops.choose_type(key="ORTHO")
    assert (shown.data.type, settings_of(selected).model) == ("ORTHO", "CROSS_SLIT")


def test_in_the_camera_s_tab_it_is_the_tab_s_camera(blender, two_cameras):
    shown, other = two_cameras
    settings_of(shown).model = settings_of(other).model = "CROSS_SLIT"
    blender.context.view_layer.objects.active = shown
    with blender.context.temp_override(camera=other.data):  # as a pinned tab has it
        blender.ops.camera_ray_caster.add_line(setting="slit_1")
    assert settings_of(other).slit_1.parent == other
    assert settings_of(shown).slit_1 is None


@pytest.mark.parametrize("kind", ["light", "empty", "mesh"])
def test_a_scene_whose_camera_is_none_says_so_everywhere_in_one_line(blender, two_cameras, kind):
    ops = blender.ops
    {"light": ops.object.light_add, "empty": ops.object.empty_add, "mesh": ops.mesh.primitive_cube_add}[kind]()
    blender.context.scene.camera = blender.context.object
    area = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D")
    with blender.context.temp_override(area=area):
        for name in (*OPERATORS, "see_through"):
            operator = getattr(ops.camera_ray_caster, name)
            assert not operator.poll(), name
            with pytest.raises(RuntimeError, match=f"is of type {kind}, not a camera: set a camera") as raised:
                operator()
            assert "Traceback" not in str(raised.value)


def test_a_linked_camera_is_refused_and_its_override_can_be_changed(blender, two_cameras, tmp_path):
    shown, _ = two_cameras
    settings_of(shown).model = "CROSS_SLIT"
    path, name = str(tmp_path / "linked.blend"), shown.name
    blender.ops.wm.save_as_mainfile(filepath=path)
    blender.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with blender.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = [name]
    (linked,), scene = wanted.objects, blender.context.scene
    scene.collection.objects.link(linked)
    scene.camera = linked
    assert not blender.ops.camera_ray_caster.add_line.poll()
    with pytest.raises(RuntimeError, match="linked from another file"):
        blender.ops.camera_ray_caster.add_line(setting="slit_1")
    made = linked.override_create(remap_local_usages=True)
    made.data.override_create(remap_local_usages=True)
    assert scene.camera == made
    blender.ops.camera_ray_caster.add_line(setting="slit_1")
    blender.ops.camera_ray_caster.choose_type(key="ORTHO")
    assert (settings_of(made).model, made.data.type) == ("BLENDER", "ORTHO")
    saved = str(tmp_path / "overridden.blend")
    blender.ops.wm.save_as_mainfile(filepath=saved)
    blender.ops.wm.open_mainfile(filepath=saved)
    camera = blender.context.scene.camera
    assert (settings_of(camera).model, camera.data.type) == ("BLENDER", "ORTHO")
    assert settings_of(camera).slit_1.parent == camera
