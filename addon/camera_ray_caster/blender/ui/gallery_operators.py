"""Operators and menus that open a scene of the gallery, or append its camera to the current scene."""

import bpy
from bpy.props import StringProperty

from .. import gallery
from .needs import select_alone

CAMERA = "Camera"
"""Name of the camera object in every scene of the gallery."""
LINES = 15
"""Number of lines in a column of the menus."""


class OfGallery:
    """Base of the operators on a scene of the gallery."""

    name: StringProperty(name="Scene", description="Name of the scene in the gallery", options={"SKIP_SAVE"})

    def path(self) -> str | None:
        """Return the path of the scene; report an error and return None if there is no scene of that name."""
        found = {path.stem: str(path) for path in gallery.scenes()}.get(self.name)
        if found is None:
            self.report({"ERROR"}, f"the gallery has no scene {self.name!r}")
        return found


class OpenExample(OfGallery, bpy.types.Operator):
    """Open this scene of the gallery as a new, unsaved file; Blender asks first whether to save changes"""

    bl_idname = "camera_ray_caster.open_example"
    bl_label = "Open Example Scene"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        """Open the scene."""
        path = self.path()
        if path is None:
            return {"CANCELLED"}
        return bpy.ops.wm.read_homefile("INVOKE_DEFAULT", filepath=path, load_ui=False)


class AppendCamera(OfGallery, bpy.types.Operator):
    """Add this camera from the gallery, with the slits or the path that it needs, and make it the scene's camera"""

    bl_idname = "camera_ray_caster.append_camera"
    bl_label = "Add Camera of the Gallery"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        """Append the camera to the active collection."""
        path = self.path()
        if path is None:
            return {"CANCELLED"}
        known = set(bpy.data.objects)
        with bpy.data.libraries.load(path, link=False) as (_, wanted):
            wanted.objects = [CAMERA]
        added = [item for item in bpy.data.objects if item not in known]
        for item in added:
            context.collection.objects.link(item)
        (camera,) = wanted.objects
        select_alone(context, camera)
        context.scene.camera = camera
        self.report({"INFO"}, f"{camera.name!r} is now the scene's camera")
        return {"FINISHED"}


class GalleryMenu:
    """Base of the menus of the gallery's scenes, in groups."""

    def draw(self, context):
        """Draw an entry for each scene, in columns; small groups share a column."""
        row, free = self.layout.row(), 0
        for group, entries in gallery.groups().items():
            if len(entries) >= free:
                column, free = row.column(), LINES
            free -= len(entries) + 1
            column.label(text=group)
            for label, name in entries.items():
                column.operator(self.operator, text=label, icon_value=gallery.icon(name)).name = name


class ExamplesMenu(GalleryMenu, bpy.types.Menu):
    """Menu of the scenes to open."""

    bl_idname = "CAMERA_RAY_CASTER_MT_examples"
    bl_label = "Example Scenes"
    operator = OpenExample.bl_idname


class CamerasMenu(GalleryMenu, bpy.types.Menu):
    """Menu of the cameras to add."""

    bl_idname = "CAMERA_RAY_CASTER_MT_cameras"
    bl_label = "Camera of the Gallery"
    operator = AppendCamera.bl_idname


def draw_menu(self, context) -> None:
    """Draw the menu of cameras in Blender's menu Add > Camera."""
    if gallery.folder() is not None:
        self.layout.menu(CamerasMenu.bl_idname)


CLASSES = (OpenExample, AppendCamera, ExamplesMenu, CamerasMenu)


def register(undo) -> None:
    """Register this module; see ``registration``."""
    bpy.types.VIEW3D_MT_camera_add.append(draw_menu)
    undo.callback(bpy.types.VIEW3D_MT_camera_add.remove, draw_menu)
