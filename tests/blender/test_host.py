"""What the extension leaves to its host: threads never reach Blender's data, and memory is the host's own."""

import gc
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from types import FunctionType, ModuleType, SimpleNamespace

import bpy
import pytest
from mathutils import Matrix

from camera_ray_caster.blender.engine import viewport
from camera_ray_caster.blender.read.scene_cache import cached_scene
from camera_ray_caster.blender.ui.cast_operator import Cast, cast_views
from camera_ray_caster.core.casting.worker import Worker

from .processes import SOURCE, blender_command, run

SCRIPTS = SOURCE.parents[1] / "scripts"
THROUGH_THE_DOOR = Path(__file__).parent / "through_the_door.py"
OF_BLENDER = (bpy.types.bpy_struct, type(bpy.data.objects), type(bpy.context))


def reached(root):
    """Every object that can be reached from one without going through a module, a type or a function's globals."""
    known, waiting = {}, [root]
    while waiting:
        item = waiting.pop()
        if id(item) in known or isinstance(item, ModuleType | type):
            continue
        known[id(item)] = item
        if isinstance(item, FunctionType):
            waiting += [item.__closure__, item.__defaults__, item.__kwdefaults__]
        else:
            waiting += gc.get_referents(item)
    return list(known.values())


@pytest.fixture
def threads(monkeypatch):
    """What threads were given while the test ran, and the add-on's functions beside Blender that they called."""
    calls = SimpleNamespace(given=[], codes=set())
    submit = ThreadPoolExecutor.submit

    def watched(pool, function, *arguments, **keywords):
        calls.given.append((function, arguments, keywords))
        return submit(pool, function, *arguments, **keywords)

    def called(frame, event, _):
        if event == "call" and frame.f_code.co_filename.startswith(str(SOURCE / "blender")):
            calls.codes.add(frame.f_code)

    monkeypatch.setattr(ThreadPoolExecutor, "submit", watched)
    threading.setprofile(called)
    yield calls
    threading.setprofile(None)


def blenders(calls):
    """What of Blender the threads could reach: objects, and names that their functions look up."""
    objects = [item for argument in calls.given for item in reached(argument) if isinstance(item, OF_BLENDER)]
    return objects, {name for code in calls.codes for name in code.co_names} & {"bpy", "gpu", "context", "bmesh"}


def test_the_watch_sees_what_it_is_for(camera_scene, threads):
    def touch():
        return bpy.data.filepath, camera_scene.name

    Worker(lambda progress: touch()).result()
    threads.codes.add(touch.__code__)
    assert blenders(threads) == ([camera_scene], {"bpy"})


def test_threads_of_a_cast_never_reach_blender(camera_scene, threads, slow):
    bpy.ops.mesh.primitive_monkey_add()
    camera_scene.render.resolution_x = camera_scene.render.resolution_y = 900
    _, jobs = Cast.read(None, bpy.context)
    Worker(partial(cast_views, jobs)).result()
    assert {code.co_name for code in threads.codes} >= {"cast_views", "cast"}
    assert len(threads.given) > 2  # the worker, and tiles
    assert blenders(threads) == ([], set())


def test_threads_of_the_viewport_never_reach_blender(camera_scene, threads, monkeypatch):
    bpy.ops.mesh.primitive_monkey_add()
    monkeypatch.setattr(viewport.Viewport, "_show", lambda self, picture: None)  # it needs a graphics card
    looking = SimpleNamespace(
        view_perspective="PERSP", view_matrix=Matrix.Translation((0, 0, -6)), window_matrix=projection()
    )
    context = SimpleNamespace(region=SimpleNamespace(width=96, height=64), region_data=looking)
    view = viewport.Viewport()
    view._begin(context, cached_scene(bpy.context), None, {"shading": "MATERIAL"})
    view._worker.result()
    viewport.stop()
    assert "_cast" in {code.co_name for code in threads.codes}
    assert blenders(threads) == ([], set())


def projection():
    """The projection of the factory camera, as a view has it."""
    return bpy.context.scene.camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=96, y=64)


@pytest.mark.skipif(sys.platform != "linux", reason="mallopt is the GNU C library's")
def test_scripts_keep_memory_in_processes_of_their_own_only():
    output = run(*map(str, [*blender_command(THROUGH_THE_DOOR), SCRIPTS]))
    assert f"asked for mallopt: {not bpy.app.binary_path}" in output
