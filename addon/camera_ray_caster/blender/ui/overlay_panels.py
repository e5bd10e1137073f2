"""The sidebar panel of the overlay's settings."""

import bpy

from ..read.scene_cache import cached_scene
from .drawing import Sidebar, draw_message


class SidebarOverlay(Sidebar, bpy.types.Panel):
    """The parts that the overlay shows."""

    bl_idname = "CAMERA_RAY_CASTER_PT_overlay"
    bl_label = "Overlay"

    def draw_header(self, context):
        self.layout.prop(context.scene.camera_ray_caster_overlay, "show", text="")

    def draw(self, context):
        layout, settings = self.layout, context.scene.camera_ray_caster_overlay
        layout.active = settings.show
        grid = layout.grid_flow(columns=2, even_columns=True, align=True)
        for name in ("show_frustum", "show_rays", "show_hits", "show_normals"):
            grid.prop(settings, name)
        layout.prop(settings, "show_ray")
        layout.prop(settings, "rays")
        for text in cached_scene(context).differences if settings.show else ():
            draw_message(layout, context, text)


CLASSES = (SidebarOverlay,)
