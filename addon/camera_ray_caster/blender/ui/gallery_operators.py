"""Operators and menus that open a scene of the gallery, or append its camera to the current scene."""

import bpy
from bpy.app.handlers import persistent
from bpy.props import StringProperty
from mathutils import Matrix

from ...core.records import InputError
from .. import gallery
from . import see_through
from .drawing import in_columns
from .needs import Action, select_alone

_opening: list[str] = []
"""The name of the example that is being opened."""
CAMERA = "Camera"
"""Name of the camera object in every scene of the gallery."""


class OfGallery(Action):
    """Base of the operators on a scene of the gallery."""

    name: StringProperty(name="Scene", description="Name of the scene in the gallery", options={"SKIP_SAVE"})

    def path(self) -> str:
        """Return the path of the scene. Raises InputError if there is none of that name."""
        path = {scene.stem: str(scene) for scene in gallery.scenes()}.get(self.name)
        if path is None:
            raise InputError(f"the gallery has no scene {self.name!r}")
        return path


class OpenExample(OfGallery, bpy.types.Operator):
    """Open this scene of the gallery as a new, unsaved file; Blender asks first whether to save changes"""

    bl_label = "Open Example Scene"
    bl_options = {"INTERNAL"}

    def execute(self, context):
        path = self.path()
        _opening[:] = [self.name]
        return bpy.ops.wm.read_homefile("INVOKE_DEFAULT", filepath=path, load_ui=False)


@persistent
def look_through(*_) -> None:
    """Look through the camera of an example in the first 3D View, if that is what has been loaded: Blender may have
    asked first whether to save changes. An example's scene has its name.
    """
    is_example = bpy.context.scene.name in _opening and not bpy.data.filepath
    _opening.clear()
    if not is_example:
        return
    for window in bpy.context.window_manager.windows:
        view = next((area for area in window.screen.areas if area.type == "VIEW_3D"), None)
        if view is not None and not see_through.shows_picture(view.spaces.active, window.scene):
            with bpy.context.temp_override(window=window, area=view):
                bpy.ops.camera_ray_caster.see_through()
            return


class AppendCamera(OfGallery, bpy.types.Operator):
    """Add this camera from the gallery, with the slits or the path that it needs, and make it the active camera"""

    bl_label = "Add Gallery Camera"

    def execute(self, context):
        known = set(bpy.data.objects)
        with bpy.data.libraries.load(self.path(), link=False) as (_, wanted):
            wanted.objects = [CAMERA]
        added = [item for item in bpy.data.objects if item not in known]
        for item in added:
            context.collection.objects.link(item)
        (camera,) = wanted.objects
        camera.name = camera.data.name = gallery.label(self.name)
        fit_around(context, camera, [item for item in added if item.parent is None])
        select_alone(context, camera)
        context.scene.camera = camera
        self.report({"INFO"}, f"{camera.name!r} is now the scene's camera")


def fit_around(context, camera, items) -> None:
    """Move objects as a whole so that the camera stands at the 3D View's viewpoint, or at the 3D cursor if there is no
    view, or it is a camera's.
    """
    view = getattr(context.space_data, "region_3d", None)
    if view is not None and view.view_perspective != "CAMERA":
        wanted = view.view_matrix.inverted()
    else:
        wanted = Matrix.LocRotScale(context.scene.cursor.location, camera.matrix_basis.to_quaternion(), None)
    context.view_layer.update()
    move = wanted @ camera.matrix_world.normalized().inverted()
    for item in items:
        item.matrix_world = move @ item.matrix_world


class GalleryMenu:
    """Base of the menus of the gallery's scenes, in groups."""

    def draw(self, context):
        for column, entries in in_columns(self.layout, gallery.groups().items()):
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
    bl_label = "Gallery Camera"
    operator = AppendCamera.bl_idname


def draw_menu(self, context) -> None:
    """Draw the menu of cameras in Blender's menu Add > Camera."""
    if gallery.folder() is not None:
        self.layout.menu(CamerasMenu.bl_idname)


CLASSES = (OpenExample, AppendCamera, ExamplesMenu, CamerasMenu)


def register(undo) -> None:
    undo.append(bpy.types.VIEW3D_MT_camera_add, draw_menu)
    undo.add_handlers(look_through, "load_post")
