"""Operators that turn a camera into a custom camera of Cycles, and back, or into the nearest one of Blender's own, or
give it a lamp that projects a picture.
"""

import bpy
from bpy.props import BoolProperty
from mathutils import Matrix

from ...core.camera.blender_lens import blender_lens
from ..cycles import add_projector, from_cycles, to_cycles
from ..properties.declared import BLENDERS_OWN, GROUP, MODEL
from ..read.camera_fields import shader_mark
from ..read.scene_reader import read_camera
from .needs import OfCamera, OfRays, camera_object_of, select_alone


class UseInCycles(OfRays, bpy.types.Operator):
    """Let Cycles render with this camera's rays: the camera becomes a custom camera, whose shader is stored in the
    file"""

    bl_label = "Use in Cycles"

    set_engine: BoolProperty(
        name="Set Engine", description="Also set the scene's render engine to Cycles", options={"SKIP_SAVE"}
    )

    def execute(self, context):
        remarks = to_cycles(context.scene, camera_object_of(context))
        if self.set_engine:
            context.scene.render.engine = "CYCLES"
        for line in remarks:
            self.report({"INFO"}, line)


class BackToBlender(OfCamera, bpy.types.Operator):
    """Restore the camera's former type, and remove the shader that the add-on made"""

    bl_label = "Back to Blender's Camera"

    @classmethod
    def why_gray(cls, context) -> str:
        if reason := super().why_gray(context):
            return reason
        is_ours = shader_mark(camera_object_of(context).data) is not None
        return "" if is_ours else "The camera has no shader made by the add-on"

    def execute(self, context):
        from_cycles(camera_object_of(context))


class FitLens(OfRays, bpy.types.Operator):
    """Replace the camera model with the nearest of Blender's own lenses, and report the error in pixels. The lens is
    perspective or orthographic, for any engine, or a polynomial fisheye, for Cycles on any device. The lens of a dome
    looks up: it gets a camera of its own, which follows this one"""

    bl_label = "Fit Blender's Lens"

    def execute(self, context):
        item, scene = camera_object_of(context), context.scene
        lens = blender_lens(read_camera(scene, item))
        if lens.elevation:
            item = _turned(context, item, lens.elevation)
        item.data.type, key = lens.camera.record.type, lens.camera.model.key
        if item.data.type == "PANO":
            item.data.panorama_type = key
        for name, value in lens.settings.items():
            setattr(scene.render if name.startswith("pixel_aspect") else item.data, name, value)
        setattr(getattr(item.data, GROUP), MODEL.name, BLENDERS_OWN)
        self.report({"INFO"}, lens.message)


def _turned(context, item, elevation: float):
    """Return a copy of a camera that is turned up by an angle, follows it, and takes its place in the scene."""
    turned, scene = bpy.data.objects.new(f"{item.name} Lens", item.data.copy()), context.scene
    for collection in item.users_collection:
        collection.objects.link(turned)
    turned.parent = item
    turned.matrix_parent_inverse = Matrix.Diagonal([1 / abs(s) for s in item.matrix_world.to_scale()]).to_4x4()
    turned.rotation_euler.x = elevation
    if scene.camera == item:
        scene.camera = turned
    select_alone(context, turned)
    return turned


class AddProjector(OfRays, bpy.types.Operator):
    """Add a lamp that projects a picture through this camera's model in Cycles, on any device. The picture is a color
    grid: replace it in the lamp's nodes"""

    bl_label = "Add Projector"

    def execute(self, context):
        lamp, error = add_projector(context.scene, camera_object_of(context))
        select_alone(context, lamp)
        self.report({"INFO"}, f"{lamp.name} projects, exact to {error:.2g} pixels; its picture is in its nodes")


CLASSES = (UseInCycles, BackToBlender, FitLens, AddProjector)
