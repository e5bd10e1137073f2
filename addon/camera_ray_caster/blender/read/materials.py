"""Looks of materials, which are what passes show of them: colors, transparent points and pass indices."""

import math
from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import bpy
import numpy as np

from ...core.materials.surface import Surface
from ...core.materials.values import Constant, Value, constant, function_of
from ...core.shapes.mesh.displaced import Displacement
from .nodes import Nodes, Output, Unread, output_of
from .outputs import displacement_of, has_bump, is_volume_alone
from .shader_nodes import ShaderParts, alpha_of, colors, transparency
from .unique import unique_name
from .value_nodes import READ

ALWAYS_NODES = bpy.app.version >= (5, 0, 0)
"""Whether materials and worlds always use nodes."""

OWN_IS_EMPTY = bpy.app.version >= (5, 2, 0)
"""Whether an empty slot that is linked to its object has no material in Cycles; the mesh's in earlier versions."""

MESH_HAS_SLOTS = bpy.app.version >= (5, 2, 0)
"""Whether Cycles knows as many slots as the evaluated mesh has materials; as many as the object has, if these are more,
in earlier versions. They differ where nodes make the mesh.
"""

NO_MATERIAL = (0.8, 0.8, 0.8, 1.0)
"""Color of a surface without a material, as in Cycles."""

BLACK = (0.0, 0.0, 0.0, 1.0)

VIEWPORT_COLOR, MAGENTA = "Its viewport color is shown", "it is shown in magenta"
"""Ends of the reasons why a color is not read, of materials and worlds that are cast all the same."""
VOLUME = "it has a volume and no surface: rays pass through it"
UNMOVED = "the displacement of its material {!r} is not read: {}. It is cast where the mesh is"
BUMP = "its normal or bump map is not in the normal pass, which is that of the mesh"
OPAQUE = "where its alpha is less than 1, but at least {:g}, it is cast as opaque"


class Look(NamedTuple):
    """What passes show of a material, or of an object without one."""

    index: int
    """Pass index."""
    color: tuple[float, ...]
    """Linear RGBA, if nothing changes over the surface."""
    surface: Surface | None = None
    """The surface, if something changes over it, and of materials that glow or are transparent."""
    needs: frozenset[str] = frozenset()
    """What the surface needs of the mesh: see ``Nodes.needs``."""
    left_out: tuple[str, ...] = ()
    """Why not all of its surface is cast, in words."""
    unread: tuple[str, ...] = ()
    """What is not read of the material, in words."""
    displacement: Displacement | None = None
    """How the material moves the mesh."""
    unmoved: str = ""
    """Why a displacement is not read."""
    notes: tuple[str, ...] = ()
    """What passes show otherwise than Cycles' passes, in words."""

    def held_out(self) -> "Look":
        """Return the look of a holdout: a hole, with the same transparent points."""
        surface = self.surface and replace(self.surface, lit=constant(0, 0, 0), emission=None, glow=None)
        return self._replace(color=(0.0,) * 4, surface=surface)


class LayerLooks:
    """Looks of objects in a view layer; each material is looked up once."""

    def __init__(self, layer, has_colors: bool):
        """Take the evaluated view layer, with its material override, if there is one, and its Alpha Threshold; and
        whether the images of colors are read.
        """
        self._override, self._threshold = layer.material_override, layer.pass_alpha_threshold
        self._has_colors = has_colors
        self._known: dict[object, Look] = {}

    def of_slots(self, item, slots: Iterable[int]) -> tuple[Look, ...]:
        """Return the looks of an evaluated object's material slots; a single look if there is an override."""
        if self._override is not None:
            return (self._of(self._override),)
        return tuple(self._of_slot(item, slot) for slot in slots)

    @property
    def materials(self) -> tuple[tuple[int, str], ...]:
        """Pass index and name of each material that has been looked up."""
        return tuple((look.index, _name(material)) for material, look in self._known.items())

    def lines(self, field: str) -> list[tuple[str, str]]:
        """Return the lines in a field of ``Look``, such as "unread", with the names of their materials."""
        return [(_name(material), line) for material, look in self._known.items() for line in getattr(look, field)]

    def of_item(self, item) -> tuple[Look, ...]:
        """Return the looks of all slots of an evaluated object."""
        return self.of_slots(item, range(max(1, slot_count(item))))

    def _of_slot(self, item, slot: int) -> Look:
        """Return the look of a slot, or of the last one for slots after it."""
        slots, original_slots = item.material_slots, item.original.material_slots
        index = min(slot, slot_count(item) - 1)
        material = slots[index].material if index >= 0 else None
        if OWN_IS_EMPTY and 0 <= index < len(original_slots):
            original = original_slots[index]
            if original.link == "OBJECT" and original.material is None:
                material = None
        return Look(0, NO_MATERIAL) if material is None else self._of(material)

    def _of(self, material) -> Look:
        if material not in self._known:
            self._known[material] = _look(material, self._threshold, self._has_colors)
        return self._known[material]


def slot_count(item) -> int:
    """Return the number of an evaluated object's material slots, as Cycles counts them."""
    return len(item.data.materials) if MESH_HAS_SLOTS else len(item.material_slots)


def _name(material) -> str:
    return unique_name(material.original, bpy.data.materials)


def first_slot(item) -> int:
    """Return the material slot of an evaluated object's first face."""
    has_faces = item.type == "MESH" and len(item.data.polygons)
    return item.data.polygons[0].material_index if has_faces else 0


def is_finite(color) -> bool:
    """Return whether all components of a color are finite."""
    return all(map(math.isfinite, color))


def shown(color) -> tuple[float, ...]:
    """Return a color of three or four components; black if any is NaN or infinite, which would spread to all pixels."""
    return tuple(color) if is_finite(color) else BLACK[: len(color)]


def _look(material, threshold: float, has_colors: bool = True) -> Look:
    """Return a material's look: what its nodes say, or its viewport color if it has none or they are not read."""
    *viewport, opacity = material.diffuse_color
    plain = Look(material.pass_index, shown((*viewport, opacity)))
    if material.node_tree is None or not (ALWAYS_NODES or material.use_nodes):
        return plain
    output = output_of(material.node_tree)
    if output is None:
        return plain._replace(color=BLACK)
    if is_volume_alone(output):
        hollow = Surface(constant(*viewport), alpha=constant(0))
        return plain._replace(surface=hollow, left_out=(VOLUME,))
    plain = plain._replace(notes=(BUMP,) * has_bump(material, output))
    try:
        displacement, needs = displacement_of(material, output)
        plain = plain._replace(displacement=displacement, needs=needs)
    except Unread as error:
        plain = plain._replace(unmoved=UNMOVED.format(_name(material), error))
    return _colored(material, output, plain, threshold, has_colors)


def _colored(material, output: Output, plain: Look, threshold: float, has_colors: bool) -> Look:
    """Return a look with the color and the transparent points that the nodes of a surface say."""
    *viewport, opacity = material.diffuse_color
    nodes, (socket, groups), unread = Nodes(READ), output["Surface"], []
    left_out = plain.left_out
    alpha = through = None
    try:
        through = transparency(nodes, socket, groups) if threshold > 0 else None
        alpha = None if through is None else alpha_of(through)
    except Unread as error:
        left_out += (f"its alpha is not read: {error}. It is cast opaque",)
    of_alpha = set(nodes.missing)
    left_out += tuple(f"{_image(name)} is missing: its alpha is 1" for name in sorted(of_alpha))
    needs = set(plain.needs | nodes.needs if alpha is not None else plain.needs)
    lit: Value = constant(*viewport)
    emission = glow = None
    try:
        painted = nodes if has_colors else Nodes(READ, reads_images=False)
        parts = _divided(colors(painted, socket, groups, through is not None), through, alpha)
        needs |= painted.needs
        base, emission, glow = (color and as_color(color) for color in parts)
        lit = constant(0, 0, 0) if base is None else function_of(lambda values: np.maximum(values, 0), base)
    except Unread as error:
        unread.append(f"its color is not read: {error}. {VIEWPORT_COLOR}")
    unread += [f"{_image(name)} is missing: {MAGENTA}" for name in sorted(nodes.missing - of_alpha)]
    is_hole = isinstance(alpha, Constant) and (alpha.values < threshold).all()
    notes = plain.notes if through is None or is_hole else (*plain.notes, OPAQUE.format(threshold))
    if isinstance(alpha, Constant) and not is_hole:
        alpha = None
    look = plain._replace(left_out=left_out, unread=tuple(unread), notes=notes)
    if alpha is None and emission is None and glow is None and isinstance(lit, Constant):
        return look._replace(color=shown((*lit.values[:, 0].tolist(), opacity)))
    return look._replace(surface=Surface(lit, emission, glow, alpha, threshold), needs=frozenset(needs))


def _image(name: str) -> str:
    return f"its image {name!r}" if name else "the image of an Image Texture"


def _divided(parts: ShaderParts, through: Value | None, alpha: Value | None) -> tuple[Value | None, ...]:
    """Return the parts over alpha: the hit surface is shown unblended."""
    if through is None or alpha is None:
        return parts
    return tuple(color and function_of(lambda a, b: a / np.where(b > 0, b, 1.0), color, alpha) for color in parts)


def as_color(color: Value) -> Value:
    """Return a part with three channels that are finite."""
    if isinstance(color, Constant):
        return constant(*np.broadcast_to(color.values[:, 0], 3))
    return function_of(lambda values: np.nan_to_num(np.broadcast_to(values, (3, values.shape[1]))), color)
