"""Blender properties made from declared settings."""

from itertools import groupby

import bpy
import numpy as np
from bpy import props

from ...core.cameras.parts.settings import Setting

LARGEST, LARGEST_INT = float(np.finfo(np.float32).max), 2**31 - 1
SMALLEST = float(np.finfo(np.float32).tiny)
"""Minimum of a property whose declared minimum is positive but too small for float32."""

UNITS = {"angle": {"subtype": "ANGLE", "step": 100}, "length": {"unit": "LENGTH"}}


def property_of(setting: Setting):
    """Return the Blender property of a setting, for a class's annotations."""
    named = {"name": setting.label, "description": setting.text, "update": _tag, "override": {"LIBRARY_OVERRIDABLE"}}
    return PROPERTY_MAKERS[setting.kind](setting, named)


def _tag(self, context):
    """Tag the data-block for the depsgraph: a change by a script is otherwise not evaluated, unlike one in a window."""
    self.id_data.update_tag()


def _float(setting, named):
    low = max(setting.low, SMALLEST) if setting.low > 0 else setting.low
    shown = {"precision": setting.digits, "step": setting.step} | UNITS.get(setting.unit, {})
    return props.FloatProperty(**named, **shown, default=setting.default, **_range(setting, low, LARGEST))


def _range(setting, low, largest) -> dict[str, float]:
    ends = {"min": low, "max": setting.high, "soft_max": min(setting.high, setting.soft_high)}
    return {name: min(max(end, -largest), largest) for name, end in ends.items()}


def _enum(setting, named):
    items = []
    for group, members in groupby(setting.items, lambda item: item.group):
        items += [("", group, "", 0)] if group else []  # an item with an empty key is a heading
        items += [(item.key, item.label, item.text, item.number) for item in members]
    return props.EnumProperty(**named, default=setting.default, items=items)


PROPERTY_MAKERS = {
    "FLOAT": _float,
    "INT": lambda setting, named: props.IntProperty(
        **named, default=setting.default, **_range(setting, setting.low, LARGEST_INT)
    ),
    "BOOLEAN": lambda setting, named: props.BoolProperty(**named, default=setting.default),
    "ENUM": _enum,
    "VECTOR": lambda setting, named: props.FloatVectorProperty(
        **named, default=setting.default, size=len(setting.default)
    ),
    "TEXT": lambda setting, named: props.StringProperty(**named, default=setting.default),
    "FILE": lambda setting, named: props.StringProperty(
        **named, default=setting.default, subtype="FILE_PATH", options={"PATH_SUPPORTS_BLEND_RELATIVE"}
    ),
    "OBJECT": lambda setting, named: props.PointerProperty(
        **named, type=bpy.types.Object, poll=lambda group, item: item.type in setting.types
    ),
    "IMAGE": lambda setting, named: props.PointerProperty(**named, type=bpy.types.Image),
}
"""Functions that make the property, by kind of setting."""
