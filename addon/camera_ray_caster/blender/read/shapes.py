"""The spheres, planes and lights that a depsgraph shows to a renderer; geometry that is neither is named."""

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from ...core.records import Shapes
from ...core.shapes.instances import Primitive, is_invertible, lights_in_world, put_in_world
from ..properties.declared import PRIMITIVE
from ..terminal.signals import raise_if_stopping
from .geometry import shapes_of
from .lights import USED, is_finite, light_color, shown, world_color
from .stored import own_value
from .visibility import Visibility, original_source

NO_SURFACE = frozenset(
    {"EMPTY", "CAMERA", "LIGHT", "ARMATURE", "SPEAKER", "LIGHT_PROBE", "LATTICE", "CURVE", "SURFACE", "FONT", "META"}
)
"""Object types to pass over. The surface of curves, texts and metaballs is listed apart, as a mesh of their object."""

HIDDEN = "it is hidden in the viewport, so that Blender evaluates it only in a render: show it, or render (F12)"
HAIR = "its hair {!r} is neither sphere nor plane"
SINGULAR = "its size is zero in some direction, or not finite: clear its scale (Alt S) or apply it"
LISTEN = 256
"""Instances after which a reading asks whether to go on: some hundredths of a second."""
DAZZLING = "its strength or color is not finite: set them anew"


@dataclass
class _Group:
    """The instances of one mesh, point cloud or light of one object."""

    name: str
    primitive: Primitive | None = None
    reason: str = ""
    object_index: int = 0
    material_index: int = 0
    color: tuple[float, ...] = ()
    is_sun: bool | None = None
    matrices: list[tuple[float, ...]] = field(default_factory=list)

    def placings(self) -> np.ndarray:
        """Return the world matrices of the instances, (k, 3, 4) float64."""
        return np.array(self.matrices, np.float64).reshape(-1, 3, 4)


def shapes_record(depsgraph) -> Shapes:
    """Return what can be cast of a depsgraph, the viewport's or a render's: every instance by itself, in the world.

    Rows stand together by object and mesh, in the order in which the depsgraph lists them first. What a render hides is
    passed over; geometry that cannot be cast is in ``left_out``, once for each object and reason.
    """
    visibility = Visibility(depsgraph)
    groups: dict[tuple, _Group] = {}
    found: dict[tuple, tuple[Primitive | None, str]] = {}
    left_out: Counter[tuple[str, str]] = Counter()
    listed = set()
    for count, instance in enumerate(depsgraph.object_instances):
        if count % LISTEN == 0:
            raise_if_stopping()
        item = instance.object  # for an instance, a stand-in that the next one overwrites
        owner = instance.parent
        key = instance.instance_object or item, owner, item.data
        group = groups.get(key)
        if group is None:
            group = groups[key] = _group(instance, visibility, found)
            if owner is None:
                listed.add(item.original)
                left_out.update((group.name, HAIR.format(name)) for name in visibility.strands(item))
        matrix = instance.matrix_world
        group.matrices.append((*matrix[0], *matrix[1], *matrix[2]))
    for group in groups.values():
        if group.reason:
            left_out[group.name, group.reason] += len(group.matrices)
    for item in visibility.unlisted(listed):
        if item.type not in NO_SURFACE or item.instance_type == "COLLECTION":
            left_out[item.name, HIDDEN] += 1
    return _gathered(list(groups.values()), left_out, depsgraph.scene_eval)


def _group(instance, visibility, found) -> _Group:
    """Return the group, still empty, that the first of its instances opens."""
    item = instance.object
    group = _Group(original_source(instance).name)
    if not visibility.is_rendered(instance):
        return group
    if item.type == "LIGHT":
        if item.data.type in USED:
            group.is_sun, group.color = USED[item.data.type], light_color(item.data)
            if not is_finite(group.color):
                group.is_sun, group.reason = None, DAZZLING
        else:
            group.reason = f"it is a light of type {item.data.type.lower()}: only sun and point lights are used"
    elif item.type not in NO_SURFACE:
        _fill(group, instance, visibility, found)
    return group


def _fill(group, instance, visibility, found) -> None:
    """Set what the geometry of an instance stands for, or why it cannot be cast."""
    item = instance.object
    setting = own_value(original_source(instance), PRIMITIVE)  # the file's own: setting it evaluates nothing anew
    group.reason = _refusal(setting) or visibility.objection(instance)
    if group.reason:
        return
    key = item.data.as_pointer(), setting
    if key not in found:
        found[key] = shapes_of(item.data, setting)
    group.primitive, group.reason = found[key]
    material = _material(item)
    group.object_index = item.pass_index
    group.material_index = material.pass_index if material else 0
    group.color = shown(material.diffuse_color if material else item.color)
    if visibility.is_holdout(instance):
        group.color = 0.0, 0.0, 0.0, 0.0


def _refusal(setting: str) -> str:
    """Return why an object is not cast by its own setting; "" if it is."""
    if setting == "IGNORE":
        return "it is ignored by its own setting"
    known = setting in {item.key for item in PRIMITIVE.items}
    return "" if known else f"its Cast As is {setting}, which this version does not know: choose another one"


def _material(item):
    """Return the material of the first face, or of the first slot where there are no faces; None without one."""
    slots = item.material_slots
    if not len(slots):
        return None
    has_faces = item.type == "MESH" and len(item.data.polygons)
    return slots[min(item.data.polygons[0].material_index if has_faces else 0, len(slots) - 1)].material


def _gathered(groups: list[_Group], left_out: Counter, scene) -> Shapes:
    """Return the record of all groups: their instances placed in the world, one row a shape."""
    lights = [group for group in groups if group.is_sun is not None]
    cast = [group for group in groups if group.primitive is not None]
    placings = []
    for count, group in enumerate(cast):
        if count % LISTEN == 0:
            raise_if_stopping()
        matrices = group.placings()
        usable = is_invertible(matrices, group.primitive)
        if not usable.all():
            left_out[group.name, SINGULAR] += int((~usable).sum())
        placings.append(matrices[usable])
    counts = [len(matrices) * len(group.primitive) for group, matrices in zip(cast, placings, strict=True)]
    ends = np.cumsum(counts, dtype=int)
    center, axes = np.empty((sum(counts), 3)), np.empty((sum(counts), 3, 3))
    for group, matrices, count, end in zip(cast, placings, counts, ends, strict=True):
        rows = slice(end - count, end)
        put_in_world(group.primitive, matrices, center[rows], axes[rows])

    def column(values, dtype, width=()):
        return np.repeat(np.array(values, dtype).reshape(len(cast), *width), counts, axis=0)

    return Shapes(
        kind=column([group.primitive.kind for group in cast], np.uint8),
        center=center,
        axes=axes,
        object_index=column([group.object_index for group in cast], np.int32),
        material_index=column([group.material_index for group in cast], np.int32),
        color=column([group.color for group in cast], np.float32, (4,)),
        name_index=column(range(len(cast)), np.int32),
        names=tuple(group.name for group in cast),
        lights=lights_in_world([(group.is_sun, group.color, group.placings()) for group in lights]),
        world_color=world_color(scene),
        left_out=tuple((name, _counted(reason, count)) for (name, reason), count in left_out.items()),
    )


def _counted(reason: str, count: int) -> str:
    return reason if count == 1 else f"{reason} ({count} instances)"
