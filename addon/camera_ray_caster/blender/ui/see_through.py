"""See Through: the 3D View looks through the camera, whatever its model, and shows what a cast would."""

import bpy

from ..properties.declared import ENGINE
from .needs import NO_CAMERA


class SeeThrough(bpy.types.Operator):
    """Look through the scene's camera, whatever its model: the view becomes the camera's, its shading Rendered, and the
    scene's render engine Camera Ray Caster. Once more: back to Solid"""

    bl_idname = "camera_ray_caster.see_through"
    bl_label = "See Through Camera"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Grayed out without a camera, and beside a 3D View."""
        cls.poll_message_set(NO_CAMERA if context.scene.camera is None else "Only in a 3D View")
        return context.scene.camera is not None and context.area is not None and context.area.type == "VIEW_3D"

    def execute(self, context):
        """Look through it, or no longer; say of another engine that it is not the scene's any more."""
        space = context.space_data
        if is_seen_through(context):
            space.shading.type = "SOLID"
            return {"FINISHED"}
        if context.scene.render.engine != ENGINE:
            self.report({"INFO"}, "The scene's render engine is Camera Ray Caster now")
        context.scene.render.engine = ENGINE
        space.region_3d.view_perspective, space.shading.type = "CAMERA", "RENDERED"
        return {"FINISHED"}


def is_seen_through(context) -> bool:
    """Whether the 3D View shows the camera's picture."""
    space = context.space_data
    through = space.region_3d is not None and space.region_3d.view_perspective == "CAMERA"
    return through and space.shading.type == "RENDERED" and context.scene.render.engine == ENGINE


CLASSES = (SeeThrough,)
