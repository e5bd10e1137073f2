"""The shapes and lights that a depsgraph gives to a renderer, and the names of geometry that cannot be cast."""

from collections import Counter
from collections.abc import Hashable, Iterable
from dataclasses import replace
from functools import partial

import bpy

from ...core.mesh import Mesh
from ...core.records import Shapes
from ...core.shape_records import World
from ..properties.declared import EXACT_SHAPES, PRIMITIVE
from .geometry import mesh_shapes, shapes_of
from .instance_groups import Group, cancellable, gathered, listed
from .lights import cone_of, light_color, world_of
from .materials import LayerLooks, Look, first_slot, is_finite
from .nodes import Unread
from .render_visibility import ItemVisibility, original_source
from .shape_cache import Found, Reading
from .stored import own_value
from .unique import unique_name

NO_SURFACE = frozenset(
    {"EMPTY", "CAMERA", "LIGHT", "ARMATURE", "SPEAKER", "LIGHT_PROBE", "LATTICE", "CURVE", "SURFACE", "FONT", "META"}
)
"""Object types to skip. Surfaces of curves, texts and metaballs are listed separately, as meshes of their objects."""

HIDDEN = "it is hidden in the viewport, so Blender evaluates it only in a render: show it, or render (F12)"
DAZZLING = "its strength or color is not finite: set both again"
HAIR = "its hair {!r} is not a surface"
HOLDOUT = "it is a holdout: a hole in the combined pass, a surface like others in all other passes"


def shapes_record(depsgraph, has_colors: bool = True) -> Shapes:
    """Return the shapes of a depsgraph, the viewport's or a render's: every instance separately, in the world.

    Rows are grouped by object and mesh, in the order in which the depsgraph first lists them. Objects that a render
    hides are skipped. Geometry that cannot be cast is in ``left_out``, once for each object and reason.

    ``has_colors``: whether passes show colors. Otherwise images are read only where they decide what is hit.
    """
    scene = _Scene(depsgraph, has_colors)
    for instance in cancellable(depsgraph.object_instances):
        scene.add(instance)
    shapes = scene.record()
    scene.reading.keep()
    return shapes


class _Scene:
    """Collector of the groups in a depsgraph's list of instances."""

    def __init__(self, depsgraph, has_colors: bool):
        self.world, self.unread = world_of(depsgraph) if has_colors else (World(), ())
        self.visibility = ItemVisibility(depsgraph)
        self.reading = Reading(depsgraph)
        self.looks = LayerLooks(depsgraph.view_layer_eval, has_colors)
        self.exact = own_value(depsgraph.scene_eval, EXACT_SHAPES)
        self.groups: dict[tuple, Group] = {}
        self.left_out: Counter[tuple[str, str]] = Counter()
        self.listed, self.instanced = set(), set()

    def add(self, instance) -> None:
        """Add an instance to its group; the first instance of a group creates it."""
        item = instance.object  # for an instance, temporary data that the next instance overwrites
        owner = instance.parent
        key = instance.instance_object or item, owner, item.data
        group = self.groups.get(key)
        if group is None:
            group = self.groups[key] = self.opened(instance)
            (self.listed if owner is None else self.instanced).add(original_source(instance))
            if owner is None:
                self.left_out.update((group.name, HAIR.format(name)) for name in self.visibility.strands(item))
        matrix = instance.matrix_world
        group.matrices.append((*matrix[0], *matrix[1], *matrix[2]))
        if owner is not None:
            group.ids.extend(instance.persistent_id)

    def opened(self, instance) -> Group:
        """Return the group of an instance, without any matrices."""
        item = instance.object
        source, owner = original_source(instance), instance.parent
        objects = source.session_uid, owner.original.session_uid if owner else 0
        group = Group(unique_name(source, bpy.data.objects), objects, instance.is_instance)
        if not self.visibility.is_rendered(instance):
            return group
        if item.type == "LIGHT":
            group.is_light = True
            self.light(group, item.data)
        elif item.type not in NO_SURFACE:
            self.fill(group, instance)
        return group

    def light(self, group: Group, data) -> None:
        """Set the kind and color of a light, or the reason why it is not used."""
        try:
            color = light_color(data)
        except Unread as error:
            group.reason = f"its light is not read: {error}"
            return
        if not is_finite(color):
            group.reason = DAZZLING
        else:
            group.is_sun, group.looks, group.cone = data.type == "SUN", (Look(0, color),), cone_of(data)

    def fill(self, group: Group, instance) -> None:
        """Set the primitive of an instance's geometry, or the reason why it cannot be cast."""
        item, source = instance.object, original_source(instance)
        if self.visibility.is_met(instance):
            group.geometry = self.geometry(instance)
        setting = own_value(source, PRIMITIVE)  # of the original: a change of it does not cause an evaluation
        group.reason = _refusal(setting) or self.visibility.objection(instance)
        if group.reason:
            return
        looks = self.looks.of_item(item)
        needs, moves = frozenset().union(*(look.needs for look in looks)), tuple(look.displacement for look in looks)
        self.left_out.update((group.name, look.unmoved) for look in looks if look.unmoved)
        group.is_displaced = any(moves)
        if setting == "AUTOMATIC" and (needs or group.is_displaced or not self.exact):
            setting = "MESH"
        find = partial(self.reading.find, item.data, source)

        def read(setting: str) -> Found:
            return find((setting, needs, moves), partial(shapes_of, item, setting, needs, moves))

        group.primitive, group.reason = read(setting)
        if group.primitive is None:
            return
        is_textured = any(look.surface is not None and look.surface.changes for look in looks)
        if setting == "AUTOMATIC" and group.primitive.note and is_textured:
            group.primitive, group.reason = read("MESH")  # whose map the material may read
        if setting == "AUTOMATIC" and group.primitive.apart is not None:
            group.flattened = partial(find, ("MESH", frozenset(), ()), partial(mesh_shapes, item.data, "MESH"))
        group.object_index = item.pass_index
        group.looks = self.looks.of_slots(item, _slots(item, group.primitive.mesh))
        if self.visibility.is_holdout(instance):
            group.looks = tuple(look.held_out() for look in group.looks)
            group.notes += (HOLDOUT,)

    def geometry(self, instance) -> Hashable:
        """Return a key of Cycles' geometry of an instance: its data, or its object if that has its own materials."""
        data, item = instance.object.data, instance.instance_object or instance.object
        has_slots = item.data == data and any(slot.link == "OBJECT" for slot in item.material_slots)
        return item.original.session_uid if has_slots else data.as_pointer()

    def record(self) -> Shapes:
        """Return the record of all groups."""
        dark: Counter[tuple[str, str]] = Counter(self.unread)
        for group in self.groups.values():
            if group.reason:
                (dark if group.is_light else self.left_out)[group.name, group.reason] += len(group.matrices)
        for item in self.visibility.unlisted(self.listed, self.instanced):
            if _may_have_surface(item) or item.instance_type == "COLLECTION":
                self.left_out[unique_name(item, bpy.data.objects), HIDDEN] += 1
        looks = self.looks
        self.left_out.update(looks.lines("left_out"))
        shapes = gathered(list(self.groups.values()), self.left_out, self.world)
        lights = replace(shapes.lights, left_out=listed(dark))
        unread, notes = tuple(looks.lines("unread")), (*shapes.notes, *looks.lines("notes"))
        return replace(shapes, lights=lights, materials=looks.materials, unread=unread, notes=notes)


def _may_have_surface(item) -> bool:
    """Return whether an object that Blender has not evaluated would have something to cast."""
    data = item.data
    if item.type == "CURVE":
        is_filled = data.dimensions == "2D" and data.fill_mode != "NONE"
        return bool(data.bevel_depth or data.extrude or data.bevel_object or is_filled)
    return item.type not in NO_SURFACE or item.type in {"SURFACE", "FONT", "META"}


def _slots(item, mesh: Mesh | None) -> Iterable[int]:
    """Return the material slots that are needed: the object's first face's, or 0 .. the largest of a mesh record."""
    if mesh is None:
        return (first_slot(item),)
    return (0,) if mesh.slot is None else range(int(mesh.slot.max()) + 1)


def _refusal(setting: str) -> str:
    """Return the reason why an object's own setting excludes it; "" if it does not."""
    if setting == "IGNORE":
        return "its Cast As setting is Ignore"
    known = setting in {item.key for item in PRIMITIVE.items}
    return "" if known else f"its Cast As is {setting}, which this version does not know: choose another shape"
