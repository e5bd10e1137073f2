"""Operators that turn the hits of the active camera's rays into points: a mesh in the scene, or files."""

from pathlib import Path

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty
from bpy_extras.io_utils import ExportHelper

from ...core.clouds.cloud import AXES, OF_DEVICE, PointCloud, scan
from ...core.clouds.formats import POINT_FORMATS
from ...core.library.clouds import save_points
from ..output.point_files import ERRORS, categories_of
from ..read.scene_reader import read_scene
from .drawing import Sidebar
from .needs import OfScene, select_alone

ATTRIBUTES = {
    "range": "FLOAT", "true_range": "FLOAT", "time": "FLOAT", "incidence": "FLOAT", "reflectance": "FLOAT",
    "ring": "INT", "column": "INT", "instance": "INT", "category": "INT", "normal": "FLOAT_VECTOR",
}  # fmt: skip
"""Attributes of the mesh's vertices, and their types; the vectors are normals in the world."""


class OfPoints(OfScene):
    """Base of the operators on points, with the settings of range errors."""

    noise: FloatProperty(name="Noise", description="Standard deviation of the ranges", min=0, unit="LENGTH")
    dropout: FloatProperty(
        name="Dropout", min=0, unit="LENGTH", description="Range within which no point is lost on a surface "
        "perpendicular to the beam. Farther away, or at an oblique angle, some are lost. 0 loses none",
    )  # fmt: skip
    quantum: FloatProperty(
        name="Quantum", description="Ranges are rounded to multiples of this. 0 does not round", min=0, unit="LENGTH",
        precision=4,
    )  # fmt: skip
    as_device: BoolProperty(
        name="Quantum of Device", description="Round ranges to the step that the scanner's device stores"
    )
    seed: IntProperty(name="Seed", description="Seed of noise and lost points", min=0)

    def points(self, context) -> PointCloud:
        """Return the points of the current frame. Raises InputError if the camera cannot be cast."""
        scene = read_scene(context.scene)
        how = {name: getattr(self, name) for name in ERRORS}
        if self.as_device:
            how["quantum"] = OF_DEVICE
        return scan(scene, categories=categories_of(scene.shapes.names), **how)


class PointsToMesh(OfPoints, bpy.types.Operator):
    """Add a mesh whose vertices are the points that the active camera's rays hit, with their ranges, rings, times and
    labels as attributes"""

    bl_label = "Points to Mesh"

    def execute(self, context):
        cloud = self.points(context)
        mesh = bpy.data.meshes.new(f"{cloud.name} Points")
        mesh.vertices.add(len(cloud))
        mesh.vertices.foreach_set("co", cloud.world.astype(np.float32).ravel())
        for name, kind in ATTRIBUTES.items():
            values = getattr(cloud, name)
            data = mesh.attributes.new(name if kind != "FLOAT_VECTOR" else "surface_normal", kind, "POINT").data
            is_whole = kind == "INT"
            data.foreach_set("vector" if values.ndim == 2 else "value",
                             values.astype(np.int32 if is_whole else np.float32).ravel())  # fmt: skip
        mesh.update()
        made = bpy.data.objects.new(mesh.name, mesh)
        context.collection.objects.link(made)
        select_alone(context, made)
        self.report({"INFO"}, f"{len(cloud):,} points")


class SavePoints(OfPoints, ExportHelper, bpy.types.Operator):
    """Write the points that the active camera's rays hit at the current frame, as files of scanners"""

    bl_label = "Save Points"
    bl_options = {"REGISTER"}

    format: EnumProperty(name="Format", items=[(key, key.upper(), f"Files of {key.upper()}") for key in POINT_FORMATS])
    axes: EnumProperty(
        name="Axes", items=[(key, key.title(), f"Points in the axes of the {key}") for key in AXES]
    )  # fmt: skip
    filename_ext = ""
    check_extension = None

    def execute(self, context):
        path = Path(bpy.path.abspath(self.filepath))
        cloud = self.points(context)
        paths = save_points(cloud, path.parent, self.format, name=path.stem, axes=self.axes).paths
        self.report({"INFO"}, f"Wrote {len(cloud):,} points into {', '.join(path.name for path in paths)}")


class SidebarPoints(Sidebar, bpy.types.Panel):
    """Points of the active camera: drawn in the view, as a mesh or as files."""

    bl_idname = "CAMERA_RAY_CASTER_PT_points"
    bl_label = "Points"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.camera_ray_caster_overlay
        column = layout.column()
        column.active = settings.show
        column.prop(settings, "show_points")
        column.prop(settings, "points_by", text="Color")
        column.prop(settings, "show_sweep")
        layout.operator(PointsToMesh.bl_idname, icon="POINTCLOUD_DATA")
        layout.operator_context = "INVOKE_DEFAULT"
        layout.operator(SavePoints.bl_idname, icon="EXPORT")


CLASSES = (PointsToMesh, SavePoints, SidebarPoints)
