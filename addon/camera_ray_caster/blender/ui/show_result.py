"""Show Result: a pass that was cast, in an Image Editor, in colors that a screen can show."""

import bpy
from bpy.props import StringProperty

from ..output import images


class ShowResult(bpy.types.Operator):
    """Show this pass in an Image Editor: one that is open, or a new one"""

    bl_idname = "camera_ray_caster.show_result"
    bl_label = "Show Result"
    bl_options = {"REGISTER"}

    name: StringProperty(name="Image", description="One that a cast has made", options={"SKIP_SAVE"})

    def execute(self, context):
        """Show it, and say what the colors mean."""
        if self.name not in images.results():
            self.report({"ERROR"}, f"there is no image {self.name!r} of a cast: cast first")
            return {"CANCELLED"}
        image, said = images.show_in_colors(self.name)
        editor = open_editor(context)
        if editor is not None:
            editor.image = image
        self.report({"INFO"}, f"{self.name}: {said}")
        return {"FINISHED"}


def open_editor(context):
    """Return an Image Editor, opened as Blender opens it for a render where there is none; None without a window."""
    if not bpy.app.background and not _editors(context):
        bpy.ops.render.view_show("INVOKE_DEFAULT")
    return next(iter(_editors(context)), None)


def _editors(context) -> list:
    areas = [area for window in context.window_manager.windows for area in window.screen.areas]
    return [area.spaces.active for area in areas if area.type == "IMAGE_EDITOR"]


class ResultsMenu(bpy.types.Menu):
    """The images that casts have made."""

    bl_idname = "CAMERA_RAY_CASTER_MT_results"
    bl_label = "Show Result"

    def draw(self, context):
        """A line each."""
        for name in images.results():
            text = name.removeprefix(images.PREFIX).capitalize()
            self.layout.operator(ShowResult.bl_idname, text=text).name = name


CLASSES = (ShowResult, ResultsMenu)
