"""The Show Result operator: it shows a cast pass in an Image Editor, in displayable colors."""

import bpy
from bpy.props import StringProperty

from ...core.records import InputError
from ..output import image_datablocks
from ..properties.pass_properties import PASSES
from .needs import Action


class ShowResult(Action, bpy.types.Operator):
    """Show this pass in an open Image Editor, or in a new one"""

    bl_label = "Show Result"
    bl_options = {"REGISTER"}

    name: StringProperty(name="Image", description="Name of an image made by a cast", options={"SKIP_SAVE"})

    def execute(self, context):
        if self.name not in image_datablocks.results():
            raise InputError(f"no cast has made an image {self.name!r}: cast first")
        image, meaning = image_datablocks.show_in_colors(self.name)
        editor = open_editor()
        if editor is not None:
            editor.image = image
        self.report({"INFO"}, f"{self.name}: {meaning}")


def open_editor():
    """Return an Image Editor; if there is none, open one as for a render. Return None without a window."""
    if not bpy.app.background and not image_datablocks.editors():
        bpy.ops.render.view_show("INVOKE_DEFAULT")
    return next(iter(image_datablocks.editors()), None)


class ResultsMenu(bpy.types.Menu):
    """Menu of the images that casts have made."""

    bl_idname = "CAMERA_RAY_CASTER_MT_results"
    bl_label = "Show Result"

    def draw(self, context):
        results, labels = image_datablocks.results(), {entry.key: entry.label for entry in PASSES}
        before = [name for name in results if image_datablocks.latest and name not in image_datablocks.latest]
        for name in sorted(results, key=before.__contains__):
            if before and name == before[0]:
                self.layout.separator()
                self.layout.label(text="Earlier Casts")
            key = results[name]
            text = labels[key] + name.removeprefix(image_datablocks.image_name(key))  # with the view
            self.layout.operator(ShowResult.bl_idname, text=text).name = name


CLASSES = (ShowResult, ResultsMenu)
