"""What the rays meet in place of an object: in its properties, and beside its name wherever it is named."""

import bpy

from ..properties.declared import GROUP, PRIMITIVE

CASTABLE = {"MESH", "CURVE", "SURFACE", "FONT", "META", "POINTCLOUD"}
"""Types of objects whose setting says what they are cast as."""


def draw_cast_as(layout, item, **options) -> None:
    """Draw an object's Cast As; nothing for what is cast as nothing in any case."""
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
        """Show it for what has a surface or points."""
        return context.object is not None and context.object.type in CASTABLE

    def draw(self, context):
        """The one setting."""
        self.layout.use_property_split = True
        draw_cast_as(self.layout, context.object)


CLASSES = (ObjectPanel,)
