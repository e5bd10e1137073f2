"""What a .blend may not do to who casts it: run its scripts, or write outside the output folder."""

from types import SimpleNamespace

import pytest

from camera_ray_caster.blender.terminal import commands, options
from camera_ray_caster.core.exports.camera_json import camera_from_json

LEAD_AWAY = "/../../../away"


@pytest.fixture
def scene(camera_scene):
    """A small scene with a camera, whose file is saved by ``cast``."""
    return camera_scene


@pytest.fixture
def cast(blender, tmp_path, capfd):
    """A function that saves the file once, casts it, and returns the lines on standard error that are ours."""

    def cast(*words, command="cast"):
        deep = tmp_path / "a" / "b" / "c"
        if not deep.exists():
            deep.mkdir(parents=True)
            blender.ops.wm.save_as_mainfile(filepath=str(deep / "file.blend"))
        for mark in tmp_path.glob("ran_*"):
            mark.unlink()
        output = ("--output", str(deep / "out")) if command == "cast" else ()
        assert commands.main(command, [str(deep / "file.blend"), *output, *words], "it") == 0
        return [line for line in capfd.readouterr().err.splitlines() if line.startswith("it:")]

    return cast


def text(blender, tmp_path, name):
    """A text that leaves a mark where it runs."""
    block = blender.data.texts.new(name)
    block.from_string(f"open({str(tmp_path / ('ran_' + name))!r}, 'w').close()\n")
    return block


def driver(blender, scene, tmp_path):
    expression = f"len(str(open({str(tmp_path / 'ran_driver')!r}, 'w')))"
    scene.camera.driver_add("location", 0).driver.expression = expression


def registered_text(blender, scene, tmp_path):
    text(blender, tmp_path, "text.py").use_module = True


def style_module(blender, scene, tmp_path):
    blender.ops.mesh.primitive_uv_sphere_add(location=(0, 0, -5))  # without a mesh there are no lines
    scene.render.use_freestyle = True
    settings = scene.view_layers[0].freestyle_settings
    settings.mode = "SCRIPT"
    module = settings.modules.new()
    module.script = text(blender, tmp_path, "style")


MODULES = "view_layers[0].freestyle_settings.modules[0].use"


def style_module_by_driver(blender, scene, tmp_path, path=MODULES, expression="1"):
    style_module(blender, scene, tmp_path)
    scene.view_layers[0].freestyle_settings.modules[0].use = path != MODULES
    scene.driver_add(path).driver.expression = expression


def style_module_by_mode(blender, scene, tmp_path):
    style_module_by_driver(blender, scene, tmp_path, "view_layers[0].freestyle_settings.mode")
    scene.view_layers[0].freestyle_settings.mode = "EDITOR"


def style_module_by_key(blender, scene, tmp_path):
    style_module(blender, scene, tmp_path)
    scene.keyframe_insert(MODULES, frame=1)


STYLE_MODULES = style_module, style_module_by_driver, style_module_by_mode, style_module_by_key


def of_scripts(lines):
    """The lines that are not of how long Freestyle takes."""
    return [line for line in lines if "Freestyle draws" not in line]


@pytest.mark.parametrize("kind", [driver, registered_text, *STYLE_MODULES])
def test_scripts_run_only_where_they_are_let(blender, scene, cast, tmp_path, kind):
    kind(blender, scene, tmp_path)
    (line,) = of_scripts(cast("--frames", "1:2"))
    assert line.startswith("it: warning: scripts in the file were not run")
    assert "--enable-autoexec" in line
    assert not list(tmp_path.glob("ran_*"))
    assert of_scripts(cast("--enable-autoexec")) == []
    assert list(tmp_path.glob("ran_*"))


def test_a_file_that_blender_has_open_already_runs_no_style_module(blender, scene, tmp_path, monkeypatch):
    """As in ``blender --background FILE.blend --python scripts/cast.py``; afterwards the file has its scripts."""
    style_module_by_driver(blender, scene, tmp_path)
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "file.blend"))
    app = SimpleNamespace(binary_path="blender", version=blender.app.version)
    monkeypatch.setattr(options, "bpy", SimpleNamespace(app=app, context=blender.context, data=blender.data))
    assert commands.main("cast", ["--output", str(tmp_path / "out")], "it") == 0
    assert not list(tmp_path.glob("ran_*"))
    assert scene.view_layers[0].freestyle_settings.modules[0].script.name == "style"


def test_a_copy_for_cycles_has_the_style_modules_of_the_file(blender, osl, scene, cast, tmp_path):
    style_module(blender, scene, tmp_path)
    copy = tmp_path / "copy.blend"
    (line,) = cast("--output", str(copy), command="to_cycles")
    assert "scripts in the file were not run" in line
    blender.ops.wm.open_mainfile(filepath=str(copy), use_scripts=False)
    (module,) = blender.context.scene.view_layers[0].freestyle_settings.modules
    assert module.use
    assert module.script.name == "style"


def test_verify_says_that_a_driver_did_not_run(blender, scene, cast, tmp_path):
    driver(blender, scene, tmp_path)
    (line,) = cast(command="verify")
    assert "scripts in the file were not run" in line
    assert not list(tmp_path.glob("ran_*"))


def test_drivers_that_blender_reads_itself_are_no_scripts(scene, cast):
    scene.camera.driver_add("location", 0).driver.expression = "frame * 2 + sin(1)"
    assert cast() == []


def test_names_that_look_like_paths_lead_nowhere(blender, scene, cast, tmp_path):
    render = scene.render
    render.use_render_cache = True
    render.filepath = "//../../written"
    layer = scene.view_layers[0]
    for block in (scene, scene.camera, scene.camera.data, layer, blender.data.worlds.new("")):
        block.name = LEAD_AWAY
    render.use_multiview, render.views_format = True, "MULTIVIEW"
    render.views.new(LEAD_AWAY).file_suffix = "_away"
    layer.aovs.add().name = LEAD_AWAY
    before = set(tmp_path.rglob("*"))
    outside = [path for folder in tmp_path.parents for path in folder.glob("away*")]
    assert cast() == []
    assert [path for folder in tmp_path.parents for path in folder.glob("away*")] == outside
    appeared = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*") if path not in before}
    inside = {path for path in appeared if path.startswith("a/b/c/out/")}
    assert appeared - inside == {"a", "a/b", "a/b/c", "a/b/c/file.blend", "a/b/c/out"}
    assert len(inside) == 3 * 2 + 1


def test_a_calibration_is_that_of_every_camera_of_a_multi_view(blender, scene, cast, tmp_path):
    for name in ("Rig_R", "Rig_L"):
        scene.camera = scene.camera.copy()
        scene.camera.name, scene.camera.data = name, scene.camera.data.copy()
        scene.collection.objects.link(scene.camera)
    scene.render.use_multiview, scene.render.views_format = True, "MULTIVIEW"
    width, height = scene.render.resolution_x, scene.render.resolution_y
    file = tmp_path / "lens.yaml"
    file.write_text(f"width: {width}\nheight: {height}\nK: [60, 0, 3, 0, 60, 3, 0, 0, 1]\nD: []\n")
    assert cast("--calibration", str(file)) == []
    report = tmp_path / "a" / "b" / "c" / "out" / "report.json"
    for view in ("left", "right"):
        assert camera_from_json(report, camera=view).K[0, 0] == 60
