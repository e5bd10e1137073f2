"""The add-on's menu in Blender's Render menu, where menu search (F3) finds the operators."""

import bpy

from .cast_operator import Cast
from .cycles_operators import UseInCycles
from .export_operators import ExportMenu
from .gallery_operators import ExamplesMenu
from .lesson_operators import StepThrough
from .operators import CopyFacts, LoadCalibration, Verify, WriteReport
from .point_operators import PixelOfPoint
from .rig_operators import AddCameras

LISTED = (Cast, Verify, StepThrough, PixelOfPoint, LoadCalibration, AddCameras, UseInCycles, CopyFacts, WriteReport)


class RayCasterMenu(bpy.types.Menu):
    """The operators of the sidebar."""

    bl_idname = "CAMERA_RAY_CASTER_MT_render"
    bl_label = "Camera Ray Caster"

    def draw(self, context):
        """Draw an entry for each operator and submenu."""
        for operator in LISTED:
            self.layout.operator(operator.bl_idname)
        for menu in (ExportMenu, ExamplesMenu):
            self.layout.menu(menu.bl_idname)


def draw_menu(self, context) -> None:
    """Draw the add-on's menu in Blender's Render menu."""
    self.layout.separator()
    self.layout.menu(RayCasterMenu.bl_idname)


CLASSES = (RayCasterMenu,)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    bpy.types.TOPBAR_MT_render.append(draw_menu)
    undo.callback(bpy.types.TOPBAR_MT_render.remove, draw_menu)
