"""Blender's properties, made from declared settings."""

from itertools import groupby

import bpy
import numpy as np
from bpy import props

from ...core.cameras.parts.settings import Setting

LARGEST, LARGEST_INT = float(np.finfo(np.float32).max), 2**31 - 1
SMALLEST = float(np.finfo(np.float32).tiny)
"""The minimum of a property in place of a smaller number above 0, which float32 cannot hold."""

UNITS = {"angle": {"subtype": "ANGLE", "step": 100}, "length": {"unit": "LENGTH"}}


def property_of(setting: Setting):
    """Return the property that holds a setting, for a class's annotations."""
    named = {"name": setting.label, "description": setting.text, "update": _tag}
    return KINDS[setting.kind](setting, named)


def _tag(self, context):
    """Have the depsgraph evaluate what a script has changed; what is changed in a window it evaluates by itself."""
    self.id_data.update_tag()


def _float(setting, named):
    low = max(setting.low, SMALLEST) if setting.low > 0 else setting.low
    shown = {"precision": setting.digits, "step": setting.step} | UNITS.get(setting.unit, {})
    return props.FloatProperty(**named, **shown, default=setting.default, **_range(setting, low, LARGEST))


def _int(setting, named):
    return props.IntProperty(**named, default=setting.default, **_range(setting, setting.low, LARGEST_INT))


def _range(setting, low, largest) -> dict[str, float]:
    ends = {"min": low, "max": setting.high, "soft_max": min(setting.high, setting.soft_high)}
    return {name: min(max(end, -largest), largest) for name, end in ends.items()}


def _boolean(setting, named):
    return props.BoolProperty(**named, default=setting.default)


def _enum(setting, named):
    items = []
    for group, members in groupby(setting.items, lambda item: item.group):
        items += [("", group, "", 0)] if group else []  # an item without a key is a heading
        items += [(item.key, item.label, item.text, item.number) for item in members]
    return props.EnumProperty(**named, default=setting.default, items=items)


def _vector(setting, named):
    return props.FloatVectorProperty(**named, default=setting.default, size=len(setting.default))


def _text(setting, named):
    return props.StringProperty(**named, default=setting.default)


def _file(setting, named):
    shown = {"subtype": "FILE_PATH", "options": {"PATH_SUPPORTS_BLEND_RELATIVE"}}
    return props.StringProperty(**named, **shown, default=setting.default)


def _object(setting, named):
    return props.PointerProperty(**named, type=bpy.types.Object, poll=lambda group, item: item.type in setting.types)


def _image(setting, named):
    return props.PointerProperty(**named, type=bpy.types.Image)


KINDS = {
    "FLOAT": _float, "INT": _int, "BOOLEAN": _boolean, "ENUM": _enum, "VECTOR": _vector, "TEXT": _text,
    "FILE": _file, "OBJECT": _object, "IMAGE": _image,
}  # fmt: skip
"""How the property of each kind of setting is made."""
