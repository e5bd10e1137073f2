"""Groups of instances that differ only in their placement, and the record made from them."""

from array import array
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from ...core.records import EVERYWHERE, Shapes, Slots
from ...core.shape_records import World
from ...core.shapes.instances import Primitive, castable, lights_in_world, put_in_world
from ..process.signals import raise_if_stopping
from .materials import Look
from .shape_cache import Found

SINGULAR = "its size is zero in some direction, or not finite: clear its scale (Alt S) or apply it"
VANISHED = "its size is zero in some direction, and others share its mesh: it is not shown, as in Cycles"

MIX = 0x5851F42D4C957F2D
"""Factor with which several numbers make one, modulo 2^64, that is another for other numbers (Knuth, MMIX)."""

LISTEN = 256
"""Number of instances or groups between two checks for a request to stop: some hundredths of a second."""


@dataclass
class Group:
    """The instances of one mesh, point cloud or light of one object."""

    name: str
    objects: tuple[int, int]
    """The session_uid of the object and of the one that instances it, else 0."""
    is_instanced: bool = False
    """Whether something else shows the object here: a collection, vertices, a modifier."""
    primitive: Primitive | None = None
    reason: str = ""
    object_index: int = 0
    looks: tuple[Look, ...] = ()
    """Look of the shape; for a mesh of several materials the look of each slot; for a light its color."""
    notes: tuple[str, ...] = ()
    """What the passes show otherwise than the object's settings say."""
    is_displaced: bool = False
    """Whether a material moves its mesh. Cycles then has the mesh in its object's space, whoever shares it."""
    is_light: bool = False
    is_sun: bool | None = None
    cone: tuple[float, float] = EVERYWHERE
    """How a light shines: see ``Lights.cone``."""
    flattened: Callable[[], Found] | None = None
    """Function that returns the triangles that replace an exact shape if its matrix is singular."""
    geometry: Hashable | None = None
    """Key that is equal for groups whose geometry Cycles shares; None if Cycles has no geometry of the group."""
    matrices: list[tuple[float, ...]] = field(default_factory=list)
    ids: array = field(default_factory=lambda: array("i"))
    """Blender's ``persistent_id`` of each instance, one after the other."""

    def placings(self) -> "Placings":
        """Return the instances."""
        matrices = np.array(self.matrices, np.float64).reshape(-1, 3, 4)
        identities = np.zeros(len(matrices), np.int64)
        for numbers in (*self.objects, *np.array(self.ids, np.int64).reshape(len(matrices), -1).T):
            identities = identities * MIX + numbers
        return Placings(matrices, identities)


@dataclass(frozen=True)
class Placings:
    """Some instances of a group."""

    matrices: np.ndarray
    """World matrices, (k, 3, 4) float64."""
    identities: np.ndarray
    """(k,) int64: numbers that the same instances have in other readings, too."""

    def __len__(self) -> int:
        return len(self.matrices)

    def __getitem__(self, selected: np.ndarray) -> "Placings":
        return Placings(self.matrices[selected], self.identities[selected])

    def all_of(self, primitive: Primitive) -> np.ndarray:
        """Return the identities (k n,) of n shapes under each of the instances, as ``put_in_world`` orders them."""
        if primitive.ids is None:
            return self.identities
        return (self.identities[:, None] * MIX + primitive.ids).ravel()


def cancellable(items: Iterable) -> Iterator:
    """Yield items; raise Cancelled if a request to stop has arrived."""
    for count, item in enumerate(items):
        if count % LISTEN == 0:
            raise_if_stopping()
        yield item


def gathered(groups: list[Group], left_out: Counter, world: World) -> Shapes:
    """Return the record of all groups: their instances placed in the world, one row per shape."""
    lights = [group for group in groups if group.is_sun is not None]
    users: Counter[Hashable] = Counter()
    for group in groups:
        users[group.geometry] += len(group.matrices)
    notes: dict[tuple[str, str], None] = {}
    there = [(group, group.placings()) for group in cancellable(groups) if group.primitive is not None]

    def is_shared(group: Group) -> bool:
        return group.geometry is not None and (users[group.geometry] > 1 or group.is_displaced)

    parts = list(_castable(list(_with_volume(there, is_shared, notes)), left_out))
    cast, placings = zip(*parts, strict=True) if parts else ((), ())
    notes |= {(group.name, note): None for group in cast for note in (group.primitive.note, *group.notes) if note}
    counts = [len(placed) * len(group.primitive) for group, placed in parts]
    ends = np.cumsum(counts, dtype=int)
    center, axes = np.empty((sum(counts), 3)), np.empty((sum(counts), 3, 3))
    for group, placed, count, end in zip(cast, placings, counts, ends, strict=True):
        block = slice(end - count, end)
        put_in_world(group.primitive, placed.matrices, center[block], axes[block])

    def column(values, dtype, width=()):
        return np.repeat(np.array(values, dtype).reshape(len(cast), *width), counts, axis=0)

    meshes = {id(group.primitive): group.primitive.mesh for group in cast if group.primitive.mesh is not None}
    numbers = {key: number for number, key in enumerate(meshes)}
    rows = [numbers.get(id(group.primitive), -1) for group in cast]
    looks = [group.looks[0] for group in cast]
    surfaces = dict.fromkeys(look.surface for group in cast for look in group.looks if look.surface is not None)
    places = {surface: number for number, surface in enumerate(surfaces)}

    def numbers_of(looks: Iterable[Look]) -> list[int]:
        return [-1 if look.surface is None else places[look.surface] for look in looks]

    return Shapes(
        kind=column([group.primitive.kind for group in cast], np.uint8),
        center=center,
        axes=axes,
        object_index=column([group.object_index for group in cast], np.int32),
        material_index=column([look.index for look in looks], np.int32),
        color=column([look.color for look in looks], np.float32, (4,)),
        name_index=column(range(len(cast)), np.int32),
        names=tuple(group.name for group in cast),
        instanced=tuple(group.is_instanced for group in cast),
        lights=lights_in_world(
            [(light.is_sun, light.looks[0].color, light.cone, light.placings().matrices) for light in lights]
        ),
        world=world,
        left_out=listed(left_out),
        meshes=tuple(meshes.values()),
        mesh=column(rows, np.int32) if meshes else np.zeros(0, np.int32),
        shared=column([is_shared(group) for group in cast], bool) if meshes else np.zeros(0, bool),
        slots=_slots(cast, column, numbers_of),
        uv=np.array([group.primitive.uv for group in cast], np.float64).reshape(-1, 2, 3),
        notes=tuple(notes),
        surfaces=tuple(surfaces),
        surface=column(numbers_of(looks), np.int32) if surfaces else np.zeros(0, np.int32),
        identity=np.concatenate([np.zeros(0, np.int64), *(placed.all_of(group.primitive) for group, placed in parts)]),
        exact=tuple((group.name, group.primitive.apart) for group in cast if group.primitive.apart is not None),
    )


def _with_volume(there, is_shared: Callable[[Group], bool], notes: dict) -> Iterator[tuple[Group, Placings]]:
    """Yield groups with their instances, without those under which Cycles shows nothing of a mesh with several users,
    as it needs the inverse. Such groups are noted. Of a mesh with one user Cycles shows the flat faces.
    """
    for group, placed in there:
        if is_shared(group):
            x, y, z = np.moveaxis(placed.matrices[:, :, :3], 2, 0)
            with np.errstate(all="ignore"):
                has_volume = np.einsum("ij,ij->i", np.cross(x, y), z) != 0
            if not has_volume.all():
                notes[group.name, VANISHED] = None
                placed = placed[has_volume]
        yield group, placed


def _castable(there: list[tuple[Group, Placings]], left_out: Counter) -> Iterator[tuple[Group, Placings]]:
    """Yield groups with the instances with which they can be cast, if necessary as triangles.

    Instances that cannot be cast either way are added to ``left_out``.
    """
    usable = castable([(group.primitive, placed.matrices) for group, placed in there])
    for (group, placed), well in zip(there, usable, strict=True):
        if well.any():
            yield group, placed[well]
        singular = placed[~well]
        triangles = group.flattened()[0] if len(singular) and group.flattened is not None else None
        if triangles is not None:
            (flat,) = castable([(triangles, singular.matrices)])
            if flat.any():
                yield replace(group, primitive=triangles), singular[flat]
            singular = singular[~flat]
        if len(singular):
            left_out[group.name, SINGULAR] += len(singular)


def _slots(groups, column, surfaces_of) -> Slots | None:
    """Return the looks of the groups with several; None if no group has several."""
    several = [group.looks if len(group.looks) > 1 else () for group in groups]
    looks = [look for looks in several for look in looks]
    if not looks:
        return None
    counts = np.array([len(looks) for looks in several])
    return Slots(
        first=column(np.where(counts > 0, np.cumsum(counts) - counts, -1), np.int64),
        material_index=np.array([look.index for look in looks], np.int32),
        color=np.array([look.color for look in looks], np.float32),
        surface=np.array(surfaces_of(looks), np.int32),
    )


def listed(left_out: Counter) -> tuple[tuple[str, str], ...]:
    """Return names and reasons, the number of instances in the reason if there are several."""
    return tuple(
        (name, reason if count == 1 else f"{reason} ({count} instances)") for (name, reason), count in left_out.items()
    )
