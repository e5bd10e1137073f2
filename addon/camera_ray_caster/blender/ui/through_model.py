"""Render Through Model: F12 with EEVEE or Workbench through the camera's model, beside the passes of a cast."""

from contextlib import ExitStack

import bpy

from ..engine.engine import RenderCall
from ..faces.engine_picture import EEVEE, NAMES, WORKBENCH, picture_of
from ..properties.declared import ENGINE
from ..read.changes import changed
from .model_settings import model_of
from .needs import OfScene


class RenderThroughModel(OfScene, bpy.types.Operator):
    """Render the frame through the camera's model with EEVEE, or with Workbench if the scene has it, and cast the other
    passes. Blender does not respond until the picture is done"""

    bl_label = "Render Through Model"
    bl_options = {"REGISTER"}

    @classmethod
    def why_gray(cls, context) -> str:
        if reason := super().why_gray(context):
            return reason
        if bpy.app.is_job_running("RENDER"):
            return "Blender is rendering: wait until it has ended"
        model = model_of(context.scene.camera.data)
        if model is None or model.central:
            return ""
        return f"{model.label} has no single viewpoint: cast it, or render with Cycles"

    def execute(self, context):
        scene = context.scene
        engine = WORKBENCH if scene.render.engine in NAMES[WORKBENCH] else EEVEE
        picture = picture_of(scene, engine)
        with ExitStack() as stack:
            changed(stack, scene.camera_ray_caster, exact_shapes=False)
            changed(stack, scene.render, engine=ENGINE)
            stack.enter_context(RenderCall(picture).handed())
            bpy.ops.render.render(scene=scene.name)
        for line in picture.warnings:
            self.report({"INFO"}, line)
        if not bpy.app.background:
            bpy.ops.render.view_show("INVOKE_DEFAULT")


CLASSES = (RenderThroughModel,)
