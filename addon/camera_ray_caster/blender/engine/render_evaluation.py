"""A scene as a render evaluates it: with the objects and the modifiers' settings of a render, not the viewport's.

Blender evaluates a scene in this way only for an engine that renders it. So an engine renders that only reads.
"""

from contextlib import ExitStack
from functools import partial

import bpy

from ...core.records import Cancelled, InputError
from ..cycles.renderer import only_engine
from ..process import signals
from ..process.opening import refused_as_input
from ..read.camera_fields import check_camera
from ..read.changes import changed
from ..read.frames import check_layers
from .engine import CameraRayCaster
from .job import Job


def read_as_rendered(scene) -> Job:
    """Return the job of a cast without passes, of the scene's current frame and camera, for its first view layer that
    is rendered.

    Stereo and multi-view are left out. Raises the errors of ``Job.read``, InputError if no view layer is rendered or
    Blender cannot render, and Cancelled if stopped.
    """
    check_camera(scene, scene.camera)
    check_layers(scene)
    layer = next(layer for layer in scene.view_layers if layer.use)
    read: list[Job | InputError | Cancelled] = []

    class Reader(bpy.types.RenderEngine):  # unregistering a subclass of the engine would unregister the engine
        bl_idname = "CAMERA_RAY_CASTER_READER"
        bl_label = "Reader for Camera Ray Caster"
        visit = CameraRayCaster.visit

        def render(self, depsgraph):
            try:
                with signals.heard(self.test_break):
                    read.append(Job.read(depsgraph, self.camera_override, (), partial(self.visit, depsgraph)))
            except (InputError, Cancelled) as error:  # Blender would print and drop it
                read.append(error)

    with ExitStack() as stack:
        bpy.utils.register_class(Reader)
        stack.callback(bpy.utils.unregister_class, Reader)
        only_engine(stack, scene)
        changed(stack, scene.render, engine=Reader.bl_idname, use_multiview=False)
        with refused_as_input():
            bpy.ops.render.render(scene=scene.name, layer=layer.name)
    if not read:
        raise RuntimeError("the render failed: see the messages in the terminal")
    if isinstance(read[0], Exception):
        raise read[0]
    return read[0]
