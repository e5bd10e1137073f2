"""Blender's kinds of properties, for settings that are read from the evaluated scene.

What is changed in Blender's windows is evaluated anew by itself; what a script changes, only if it is told.
"""

from functools import partial

from bpy import props


def _tell(self, context):
    self.id_data.update_tag()


BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty, StringProperty = (
    partial(kind, update=_tell)
    for kind in (
        props.BoolProperty, props.EnumProperty, props.FloatProperty, props.FloatVectorProperty, props.IntProperty,
        props.PointerProperty, props.StringProperty,
    )
)  # fmt: skip
