"""The See Through operator: the 3D View looks through the camera, whatever its model, and shows the cast picture."""

import bpy

from ..properties.declared import ENGINE
from .needs import OfScene


class SeeThrough(OfScene, bpy.types.Operator):
    """Look through the scene's camera, whatever its model: the view becomes the camera's, its shading Rendered, and the
    scene's render engine Camera Ray Caster. Press again to return to Solid shading"""

    bl_idname = "camera_ray_caster.see_through"
    bl_label = "See Through Camera"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        """Gray out the operator without a camera, and outside a 3D View."""
        cls.poll_message_set("Available only in a 3D View")
        return context.area is not None and context.area.type == "VIEW_3D" and super().poll(context)

    def execute(self, context):
        """Switch between Rendered camera view and Solid; report a change of the scene's engine."""
        space = context.space_data
        if is_seen_through(context):
            space.shading.type = "SOLID"
            return {"FINISHED"}
        if context.scene.render.engine != ENGINE:
            self.report({"INFO"}, "The scene's render engine was set to Camera Ray Caster")
        context.scene.render.engine = ENGINE
        space.region_3d.view_perspective, space.shading.type = "CAMERA", "RENDERED"
        return {"FINISHED"}


def is_seen_through(context) -> bool:
    """Return whether the 3D View shows the camera's picture."""
    space = context.space_data
    through = space.region_3d is not None and space.region_3d.view_perspective == "CAMERA"
    return through and space.shading.type == "RENDERED" and context.scene.render.engine == ENGINE


CLASSES = (SeeThrough,)
