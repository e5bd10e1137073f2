"""Looks of materials in the combined pass, and their pass indices."""

import math
from collections.abc import Iterable

import bpy
import numpy as np

from .unique import unique_name

ALWAYS_NODES = bpy.app.version >= (5, 0, 0)
"""Whether materials and worlds always use nodes."""

UNCHANGED = (float(np.float32(0.8)),) * 3
"""Default Base Color of a new Principled BSDF."""

Look = tuple[int, tuple[float, ...]]
"""Pass index and linear RGBA color."""


class Looks:
    """Looks of objects in a view layer; each material is looked up once."""

    def __init__(self, override=None):
        """Take the view layer's material override, if there is one."""
        self._override = override
        self._known: dict[object, Look] = {}

    def of_slots(self, item, slots: Iterable[int]) -> tuple[Look, ...]:
        """Return the looks of an evaluated object's material slots; a single look if there is an override."""
        if self._override is not None:
            return (self._of(self._override),)
        return tuple(self._of_slot(item, slot) for slot in slots)

    @property
    def materials(self) -> tuple[tuple[int, str], ...]:
        """Pass index and name of each material that has been looked up."""
        names = (unique_name(material.original, bpy.data.materials) for material in self._known)
        return tuple((index, name) for name, (index, _) in zip(names, self._known.values(), strict=True))

    def _of_slot(self, item, slot: int) -> Look:
        """Return the look of a slot, or of the last one for slots after it; the object's color without a material."""
        slots = item.material_slots
        material = slots[min(slot, len(slots) - 1)].material if len(slots) else None
        return (0, shown(item.color)) if material is None else self._of(material)

    def _of(self, material) -> Look:
        if material not in self._known:
            self._known[material] = _look(material)
        return self._known[material]


def first_slot(item) -> int:
    """Return the material slot of an evaluated object's first face."""
    has_faces = item.type == "MESH" and len(item.data.polygons)
    return item.data.polygons[0].material_index if has_faces else 0


def is_finite(color) -> bool:
    """Return whether all components of a color are finite."""
    return all(map(math.isfinite, color))


def shown(color) -> tuple[float, ...]:
    """Return a color of three or four components; black if any is NaN or infinite, which would spread to all pixels."""
    return tuple(color) if is_finite(color) else (0.0, 0.0, 0.0, 1.0)[: len(color)]


def surface_node(owner, kind: str):
    """Return the node that is a material's or a world's surface, if it is of that kind; None otherwise."""
    uses_nodes = owner.node_tree is not None and (ALWAYS_NODES or owner.use_nodes)
    output = owner.node_tree.get_output_node("ALL") if uses_nodes else None
    links = output.inputs["Surface"].links if output else ()
    return links[0].from_node if links and links[0].from_node.bl_idname == kind else None


def _look(material) -> Look:
    """Return a material's look: the Base Color of a Principled BSDF, if plain and changed, else the viewport color."""
    node = surface_node(material, "ShaderNodeBsdfPrincipled")
    base = node.inputs["Base Color"] if node else None
    *viewport, alpha = material.diffuse_color
    changed = base is not None and not base.is_linked and tuple(base.default_value)[:3] != UNCHANGED
    return material.pass_index, shown((*(tuple(base.default_value)[:3] if changed else viewport), alpha))
