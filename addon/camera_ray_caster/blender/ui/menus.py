"""The add-on's menu in Blender's Render menu, where menu search (F3) finds the operators."""

import bpy

from .add_line import SETTINGS, AddGradient, AddLine
from .cast_all import CastAll
from .cast_operator import Cast
from .cycles_operators import AddProjector, BackToBlender, FitLens, UseInCycles
from .export_operators import CopyK, CopyWorldToCamera, ExportMenu
from .follow_timeline import FollowTimeline
from .frame import SetFrame
from .gallery_operators import CamerasMenu, ExamplesMenu
from .gallery_panels import ModelMenu
from .lesson_operators import ClearSteps, CopySteps, StepThrough
from .operators import CopyFacts, LensOfClip, LoadCalibration, Verify, WriteReport
from .other_engine import UseThisEngine
from .point_operators import EmptyAtHit, PixelOfPoint
from .rig_operators import AddCameras
from .see_through import SeeThrough
from .show_result import ResultsMenu
from .through_model import RenderThroughModel

LISTED = (
    SeeThrough, RenderThroughModel, Cast, CastAll, Verify, StepThrough, PixelOfPoint, EmptyAtHit, CopySteps, ClearSteps,
    SetFrame, LoadCalibration, LensOfClip, AddCameras, AddGradient, FollowTimeline, UseThisEngine, UseInCycles, FitLens,
    BackToBlender, AddProjector, CopyFacts, CopyK, CopyWorldToCamera, WriteReport,
)  # fmt: skip
MENUS = (ModelMenu, ResultsMenu, ExportMenu, ExamplesMenu, CamerasMenu)


class RayCasterMenu(bpy.types.Menu):
    """The operators of the sidebar."""

    bl_idname = "CAMERA_RAY_CASTER_MT_render"
    bl_label = "Camera Ray Caster"

    def draw(self, context):
        layout = self.layout
        layout.operator_context = "INVOKE_DEFAULT"
        for operator in LISTED:
            layout.operator(operator.bl_idname)
        for setting in SETTINGS.values():
            layout.operator(AddLine.bl_idname, text=f"Add {setting.label}").setting = setting.name
        layout.separator()
        for menu in MENUS:
            layout.menu(menu.bl_idname)


def draw_menu(self, context) -> None:
    """Draw the add-on's menu in Blender's Render menu."""
    self.layout.separator()
    self.layout.menu(RayCasterMenu.bl_idname)


CLASSES = (RayCasterMenu,)


def register(undo) -> None:
    undo.append(bpy.types.TOPBAR_MT_render, draw_menu)
