"""Operators from a point in the scene to its pixel, and from a pixel to the point that it shows."""

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...core.records import InputError
from ..read.scene_cache import cached_scene
from ..view3d import pixel_lessons
from ..view3d.clicked import clicked
from .lesson_operators import OfLesson, redraw
from .needs import OfScene, select_alone


class PixelOfPoint(OfScene, bpy.types.Operator):
    """Step through the pixel of the 3D cursor or, in Edit Mode, the pixels of the selected vertices"""

    bl_label = "Pixel of 3D Cursor or Vertices"
    bl_options = {"REGISTER"}

    def execute(self, context):
        camera = cached_scene(context).camera
        if camera is None:
            raise InputError("the camera cannot be cast: see the reason in the sidebar")
        label, points = points_of(context)
        places = camera.project(points)
        size = camera.raster.width, camera.raster.height
        inside = np.isfinite(places).all(axis=1) & ((places >= 0) & (places < size)).all(axis=1)
        if not inside.any():
            clicked.choose([])
            redraw(context)
            self.report({"WARNING"}, f"{label}: no pixel of the camera sees this point")
            return {"CANCELLED"}
        clicked.choose(dict.fromkeys((int(x), int(y)) for x, y in places[inside]))
        x, y = places[inside][-1]
        where = f"{label}: x = {x:.3f}, y = {y:.3f}, from the bottom left"
        self.report({"INFO"}, where + hidden_by(context, points[inside][-1]))
        redraw(context)
        return None


def points_of(context) -> tuple[str, np.ndarray]:
    """Return a description of the points, and the points, (n, 3), in world space."""
    item = context.edit_object
    if item is not None and item.type == "MESH":
        item.update_from_editmode()
        places = [item.matrix_world @ vertex.co for vertex in item.data.vertices if vertex.select]
        if places:
            return ("Vertex" if len(places) == 1 else f"Last of {len(places)} vertices"), np.array(places, np.float64)
    return "3D cursor", np.array([context.scene.cursor.location], np.float64)


def hidden_by(context, point) -> str:
    """Return the end of a sentence that names the object hiding the last point, or "" if the point is visible."""
    seen = list(pixel_lessons.lessons(context).values())[-1].seen
    away = np.linalg.norm(point - seen.origin)
    return f"; hidden by {seen.name!r}" if seen.distance < away * (1 - 1e-3) else ""


class EmptyAtHit(OfLesson, bpy.types.Operator):
    """Add an empty at the hit point of each pixel's ray, with its Z axis along the normal"""

    bl_label = "Empty at Hit"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        hits = [hit for hit in pixel_lessons.lessons(context).values() if hit.point is not None]
        if not hits:
            self.report({"WARNING"}, "The rays of these pixels hit no surface")
            return {"CANCELLED"}
        added = []
        for hit in hits:
            empty = bpy.data.objects.new(f"Pixel {hit.seen.pixel[0]}, {hit.seen.pixel[1]}", None)
            empty.empty_display_type, empty.empty_display_size = "SINGLE_ARROW", 0.5
            turn = Vector(hit.normal).to_track_quat("Z", "Y")
            empty.matrix_world = Matrix.LocRotScale(Vector(hit.point), turn, None)
            context.collection.objects.link(empty)
            added.append(empty)
        select_alone(context, *added)
        return None


CLASSES = (PixelOfPoint, EmptyAtHit)
