"""The add-on's own settings of a camera or an object, from its property group or else from the file's ID properties.

If the add-on is not registered, as in a script that only imports it, Blender still has the stored values: a group of ID
properties with the settings that were ever set, enums as numbers. Other settings have their defaults.
"""

from collections.abc import Iterator

import bpy
import numpy as np

from ...core.cameras.parts.settings import Setting
from ...core.records import InputError
from ..properties.declared import GROUP

HAS_SYSTEM_PROPERTIES = bpy.app.version >= (5, 0, 0)
"""Whether Blender stores the properties of add-ons separately from those that a user adds."""


def own_value(owner, setting: Setting):
    """Return the value of a setting of a camera's data or of an object, as Blender has evaluated it.

    An unknown number of an enum, as from a newer version, is returned as a string of digits. Raises InputError if the
    setting is animated and the add-on is not registered, since Blender cannot evaluate it then, for a text that is
    not UTF-8, and for a vector that is stored as one number, of which Blender reads memory that is not its own.
    """
    group = getattr(owner, GROUP, None)
    if setting.kind == "VECTOR" and isinstance(_raw(owner, setting), float | int):
        raise InputError(
            f"{setting.name} of {owner.name!r} is stored as one number, not as {len(setting.default)}: "
            "reset it to its default, then set it again"
        )
    if group is not None:
        try:
            value = getattr(group, setting.name)
        except UnicodeDecodeError as error:
            raise InputError(f"{setting.name} of {owner.name!r} is not valid UTF-8 text: type it again") from error
        return _stored(owner, setting) if setting.kind == "ENUM" and not value else value
    if f"{GROUP}.{setting.name}" in _animated(owner):
        raise InputError(
            f"{setting.name} of {owner.name!r} is animated, which Blender evaluates only where the add-on is "
            "registered: call camera_ray_caster.register() before the file is opened"
        )
    return _stored(owner, setting)


def _raw(owner, setting: Setting):
    """Return the ID property of a setting, None if it was never set."""
    properties = owner.bl_system_properties_get() if HAS_SYSTEM_PROPERTIES else owner
    group = properties.get(GROUP) if properties is not None else None
    return group.get(setting.name) if group is not None else None


def _stored(owner, setting: Setting):
    value = _raw(owner, setting)
    value = setting.default if value is None else value
    return CONVERSIONS[setting.kind](setting, value) if setting.kind in CONVERSIONS else value


CONVERSIONS = {
    "FLOAT": lambda setting, value: float(np.float32(value)),
    "VECTOR": lambda setting, value: tuple(np.array(value, np.float32).tolist()),
    "BOOLEAN": lambda setting, value: bool(value),
    "ENUM": lambda setting, value: {item.number: item.key for item in setting.items}.get(value, str(value)),
}
"""Conversions of a stored or default value to the value that the property would have: its numbers are float32."""


def _animated(owner) -> Iterator[str]:
    """Yield the data paths that drivers, the action and NLA strips of an ID animate."""
    animation = owner.animation_data
    if animation is None:
        return
    yield from (driver.data_path for driver in animation.drivers)
    strips = [strip for track in animation.nla_tracks for strip in track.strips]
    for user in (animation, *strips):
        if user.action is not None and user.action_slot is not None:
            bags = (strip.channelbag(user.action_slot) for layer in user.action.layers for strip in layer.strips)
            yield from (curve.data_path for bag in bags if bag is not None for curve in bag.fcurves)
