"""The Cast As setting of an object, in the object's tab and in lists of objects."""

import bpy

from ..properties.declared import GROUP, PRIMITIVE

CASTABLE = {"MESH", "CURVE", "SURFACE", "FONT", "META", "POINTCLOUD"}
"""Object types that have a Cast As setting."""


def draw_cast_as(layout, item, **options) -> None:
    """Draw an object's Cast As setting, or nothing for types that are never cast."""
    if item is not None and item.type in CASTABLE:
        layout.prop(getattr(item, GROUP), PRIMITIVE.name, **options)


class ObjectPanel(bpy.types.Panel):
    """Object properties: Cast As."""

    bl_idname = "CAMERA_RAY_CASTER_PT_object"
    bl_label = "Ray Caster"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type in CASTABLE

    def draw(self, context):
        self.layout.use_property_split = True
        draw_cast_as(self.layout, context.object)


CLASSES = (ObjectPanel,)
