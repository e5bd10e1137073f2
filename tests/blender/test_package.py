"""The package itself: what it gives without registration, and that registering is all or nothing, however often."""

import importlib
import os
import subprocess
import sys
from pathlib import Path

import bpy
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender import registration

from .install_and_render import traces

ADDON = Path(__file__).resolve().parents[2] / "addon"


def python(*lines):
    """What another Python prints that runs these lines with the package beside it."""
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(lines)],
        env=os.environ | {"PYTHONPATH": os.pathsep.join((str(ADDON), os.environ.get("PYTHONPATH", "")))},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.fixture
def plain(unregister):
    """What Blender lists while nothing of the add-on is registered."""
    unregister()
    return traces()


def test_every_name_of_the_package_is_there():
    assert {name for name in crc.__all__ if not callable(getattr(crc, name))} == set()
    from camera_ray_caster.blender.read import read_camera, read_scene, read_shapes
    from camera_ray_caster.core.cast import cast
    from camera_ray_caster.core.records import InputError

    assert (crc.read_camera, crc.read_scene, crc.read_shapes) == (read_camera, read_scene, read_shapes)
    assert (crc.cast, crc.InputError) == (cast, InputError)
    with pytest.raises(AttributeError, match="'camera_ray_caster' has no attribute 'project'"):
        crc.project  # noqa: B018


def test_nothing_is_imported_before_it_is_asked_for():
    code = "print(*(name for name in sys.modules if name.startswith('camera_ray_caster.') or name in ('bpy', 'numpy')))"
    start = "import sys, camera_ray_caster as crc"
    assert python(start, code) == []
    loaded = set(python(start, "crc.cast", code))
    assert {"camera_ray_caster.core.cast", "numpy"} <= loaded
    assert not any(name == "bpy" or ".blender" in name for name in loaded)


@pytest.mark.full
@pytest.mark.skipif(bool(bpy.app.binary_path), reason="needs pip's bpy; Blender disables add-ons before it ends")
def test_a_python_that_leaves_it_registered_ends_well():
    assert python("import bpy, camera_ray_caster as crc", "crc.register()", "print('done')") == ["done"]


def test_registering_twice_is_registering_once(plain):
    crc.register()
    once = traces()
    assert once != plain
    crc.register()
    assert traces() == once
    crc.unregister()
    assert traces() == plain
    crc.unregister()
    assert traces() == plain


@pytest.mark.parametrize("count", [0, 5, len(registration.CLASSES)])
def test_where_blender_refuses_a_class_nothing_stays(plain, monkeypatch, count):
    refused = type("Refused", (), {})
    monkeypatch.setattr(registration, "CLASSES", (*registration.CLASSES[:count], refused))
    with pytest.raises(RuntimeError, match="register_class"):
        crc.register()
    assert traces() == plain
    monkeypatch.undo()
    crc.register()
    assert traces() != plain


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """The package under another name, as a second copy of the add-on that Blender enables."""
    (tmp_path / "second_copy").symlink_to(Path(crc.__file__).parent)
    monkeypatch.syspath_prepend(tmp_path)
    yield importlib.import_module("second_copy")
    for name in [name for name in sys.modules if name.partition(".")[0] == "second_copy"]:
        del sys.modules[name]


def test_a_second_copy_is_refused_and_the_first_stays(plain, copy):
    crc.register()
    first = traces()
    with pytest.raises(copy.InputError, match="is registered already, as camera_ray_caster: "):
        copy.register()
    copy.unregister()
    assert traces() == first
    crc.unregister()
    copy.register()
    with pytest.raises(crc.InputError, match="is registered already, as second_copy: "):
        crc.register()
    copy.unregister()
    assert traces() == plain


def test_a_property_of_another_add_on_is_left_alone(plain):
    for theirs in (bpy.props.IntProperty(), bpy.props.PointerProperty(type=bpy.types.Object)):
        bpy.types.Scene.camera_ray_caster = theirs
        with pytest.raises(crc.InputError, match=r"another add-on has the property Scene\.camera_ray_caster: disable"):
            crc.register()
        assert "camera_ray_caster" in bpy.types.Scene.bl_rna.properties
        del bpy.types.Scene.camera_ray_caster
        assert traces() == plain
    crc.register()
    bpy.types.Scene.camera_ray_caster = bpy.props.IntProperty()  # enabled later than ours
    crc.unregister()
    assert bpy.types.Scene.bl_rna.properties["camera_ray_caster"].type == "INT"
    del bpy.types.Scene.camera_ray_caster
    assert traces() == plain


@pytest.mark.parametrize("module", registration.MODULES, ids=lambda module: module.__name__.rpartition(".")[2])
def test_where_a_later_step_fails_nothing_stays(plain, monkeypatch, module):
    register = module.register

    def fail(undo):
        register(undo)
        raise ValueError("this step has failed")

    monkeypatch.setattr(module, "register", fail)
    with pytest.raises(ValueError, match="this step has failed"):
        crc.register()
    assert traces() == plain


@pytest.mark.parametrize("cls", registration.CLASSES, ids=lambda cls: cls.__name__)
def test_a_class_that_another_has_removed_is_gone_and_the_rest_is_removed(plain, cls):
    crc.register()
    bpy.utils.unregister_class(cls)
    crc.unregister()
    assert traces() == plain


def test_handlers_and_properties_that_another_has_removed_are_gone_and_the_rest_is_removed(plain):
    crc.register()
    for handlers in (bpy.app.handlers.load_pre, bpy.app.handlers.undo_post, bpy.app.handlers.frame_change_post):
        for handler in [function for function in handlers if function.__module__.startswith(crc.__name__)]:
            handlers.remove(handler)
    del bpy.types.Scene.camera_ray_caster, bpy.types.Scene.camera_ray_caster_overlay
    crc.unregister()
    assert traces() == plain
