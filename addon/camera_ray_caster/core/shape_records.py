"""The records of shapes: where they are, how they look, what lights them, what is behind them, and remarks on them.

Records with arrays compare by identity: one is equal to itself only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from .materials.surface import Surface
from .materials.values import Value
from .mesh import Mesh
from .other_names import OF_SHAPES, instead

SPHERE, PLANE, INFINITE_PLANE, MESH = 0, 1, 2, 3
"""Values of ``Shapes.kind``."""
KIND_NAMES = "sphere", "plane", "infinite plane", "mesh"
"""What these kinds are called, in their order."""


@dataclass(frozen=True, eq=False)
class Slots:
    """The materials of meshes that have several: those of row k of ``Shapes`` begin at ``first[k]``."""

    first: np.ndarray
    """(n,) int64; -1 for shapes with one material, which is stored in ``Shapes``."""
    material_index: np.ndarray
    """(s,) int32: pass indices of the materials."""
    color: np.ndarray
    """(s, 4) float32: linear RGBA, as ``Shapes.color``."""
    surface: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    """(s,) int32: indices into ``Shapes.surfaces``, as ``Shapes.surface``."""


AREA, EVERYWHERE = (0.0, 0.0), (-2.0, 1.0)
"""Values of ``Lights.cone``: of lights that shine by the cosine, as a small area does, and in all directions alike."""


@dataclass(frozen=True, eq=False)
class Lights:
    """Lights: ``position[k]`` is a point, or with ``is_sun`` the unit direction towards the sun.

    The arrays are (n, 3), (n,) and (n, 3). ``color`` is the light's color times its strength in Blender's units: watts
    for a lamp, watts per square meter for a sun.
    """

    position: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    is_sun: np.ndarray = field(default_factory=lambda: np.zeros(0, bool))
    color: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    axis: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))
    """(n, 3): the unit directions in which spot and area lights shine, 0 for others; empty if there are only others."""
    cone: np.ndarray = field(default_factory=lambda: np.zeros((0, 2)))
    """(n, 2): of spot lights the cosine at the edge of the cone and the width, in cosines, over which the light fades
    within it; AREA of area lights, EVERYWHERE of others. Empty where ``axis`` is.
    """
    left_out: tuple[tuple[str, str], ...] = ()
    """Lights that are not used, each with the reason in one line."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Geometry:
    """Where shapes are, and what they are called, one row per shape.

    world = center + axes @ q with the unit sphere or square in q (see the conventions): a sphere may be any ellipsoid,
    a plane any parallelogram. The lengths of an infinite plane's first two axes do not limit it; they scale its uv. For
    a mesh q is a vertex minus the mesh's ``middle``; the axes of a mesh may lie in one plane.
    """

    kind: np.ndarray
    """(n,) uint8: SPHERE, PLANE, INFINITE_PLANE or MESH, places in ``KIND_NAMES``."""
    center: np.ndarray
    """(n, 3) float64, world."""
    axes: np.ndarray
    """(n, 3, 3) float64: the columns are the images of the shape's axes. Invertible, which the reader ensures, except
    for meshes.
    """
    name_index: np.ndarray
    """(n,) int32: indices into ``names``; instances and points share the name of their object."""
    names: tuple[str, ...] = ()
    instanced: tuple[bool, ...] = ()
    """Whether each of ``names`` stands for instances of the object, not for the object itself; empty if none does."""
    identity: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int64))
    """(n,) int64: equal in two readings of a scene for the same instance of the same object and the same point of a
    cloud; empty if shapes are known by their names only.
    """
    meshes: tuple[Mesh, ...] = ()
    mesh: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    """(n,) int32: indices into ``meshes``, -1 for other shapes; empty if there are no meshes."""
    shared: np.ndarray = field(default_factory=lambda: np.zeros(0, bool))
    """(n,) bool: whether normals of the mesh are interpolated in its own frame, as in Cycles for a mesh that several
    objects share, and not in the world; empty if there are no meshes.
    """


@dataclass(frozen=True, eq=False, kw_only=True)
class Looks:
    """How shapes look, one row per shape."""

    object_index: np.ndarray
    """(n,) int32: the object's pass index."""
    material_index: np.ndarray
    """(n,) int32: the material's pass index, 0 without a material."""
    color: np.ndarray
    """(n, 4) float32: linear RGBA for the combined pass."""
    materials: tuple[tuple[int, str], ...] = ()
    """Pass index and name of each material of the shapes."""
    slots: Slots | None = None
    """Materials of meshes that have several; None if no mesh has more than one."""
    surfaces: tuple[Surface, ...] = ()
    """The materials that change over a surface or glow."""
    surface: np.ndarray = field(default_factory=lambda: np.zeros(0, np.int32))
    """(n,) int32: indices into ``surfaces``, -1 where ``color`` is the material's; empty if there are no surfaces."""
    uv: np.ndarray | None = None
    """(names, 2, 3) float64: the UV map of spheres and planes by ``name_index``, affine in the two coordinates of the
    surface: (u, v) = uv @ (first, second, 1). None if u and v are the coordinates themselves.
    """


@dataclass(frozen=True, eq=False)
class World:
    """What is behind all shapes."""

    color: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    """RGBA of the background, and of the light from all directions: the mean of a background that changes."""
    background: Value | None = None
    """The color of the background by ``DIRECTION``, three channels; None if it is the world's color."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Remarks:
    """What is to be said about objects and materials, each by its name."""

    left_out: tuple[tuple[str, str], ...] = ()
    """Objects that are not cast, each with the reason in one line."""
    unread: tuple[tuple[str, str], ...] = ()
    """Materials whose colors are not read, each with what is not, in one line: they show their viewport colors."""
    exact: tuple[tuple[str, float], ...] = ()
    """Objects whose mesh is cast as an exact sphere or plane, each with the largest distance between the two, over the
    radius or the plane's longer half side.
    """
    notes: tuple[tuple[str, str], ...] = ()
    """Objects and materials that passes show otherwise than their settings or Cycles, each with the difference."""


GROUPS: Mapping[str, Any] = {
    "geometry": Geometry, "looks": Looks, "lights": Lights, "world": World, "remarks": Remarks,
}  # fmt: skip
NAMES = {group: {entry.name: entry.name for entry in fields(kind)} for group, kind in GROUPS.items()}
NAMES |= {"lights": {}, "world": {"world_color": "color", "background": "background"}}
"""By group, the values that ``Shapes`` has by a name of its own, and their names in the group."""
COLUMNS = "kind", "center", "axes", "object_index", "material_index", "color", "name_index", "names"
"""The values that ``Shapes(...)`` takes by position."""

if TYPE_CHECKING:  # the types of the values by name

    class _Values(Geometry, Looks, Remarks):
        world_color: tuple[float, float, float, float]
        background: Value | None
else:
    _Values = object


class MovingShapes(Protocol):
    """An object that returns the shapes of a scene at any frame, such as ``Motion``."""

    @property
    def is_still(self) -> bool:
        """Whether neither the camera nor the shapes move."""

    def shapes_at(self, frame: float) -> Shapes:
        """Return the shapes at a frame."""


@dataclass(frozen=True, eq=False, init=False, kw_only=True)
class Shapes(_Values):
    """The spheres, planes and meshes of a scene, one row per shape; ``shape_index`` of a pixel is the row.

    Each value of a group is also an attribute of the record, and an argument of ``Shapes(...)`` and ``replace``:
    ``shapes.center`` is ``shapes.geometry.center``; ``world_color`` is ``world.color``.
    """

    geometry: Geometry
    looks: Looks
    lights: Lights
    world: World
    remarks: Remarks
    motion: MovingShapes | None
    """The shapes over the times of a camera's pixels; None if they have one time."""
    next: Shapes | None
    previous: Shapes | None
    """The shapes at the neighboring frames: see ``casting.flow``. None if they were not read."""

    def __init__(self, *columns, **values):
        values |= dict(zip(COLUMNS[: len(columns)], columns, strict=True))
        for group, kind in GROUPS.items():
            whole = values.pop(group, None)
            parts = {name: values.pop(known) for known, name in NAMES[group].items() if known in values}
            record = kind(**parts) if whole is None else replace(whole, **parts) if parts else whole
            object.__setattr__(self, group, record)
        for name in ("motion", "next", "previous"):
            object.__setattr__(self, name, values.pop(name, None))
        if values:
            raise TypeError(f"Shapes has no {', '.join(values)}")

    def __len__(self) -> int:
        return len(self.kind)

    def __repr__(self) -> str:
        counts = zip(np.bincount(self.kind), KIND_NAMES, strict=False)
        return f"<Shapes {', '.join(f'{kind}: {count}' for count, kind in counts if count) or 'none'}>"

    def at(self, frame: float) -> Shapes:
        """Return the shapes at a frame: themselves if they do not move."""
        return self if self.motion is None else self.motion.shapes_at(frame)

    if not TYPE_CHECKING:

        def __getattr__(self, name: str):
            use = instead(name, OF_SHAPES, dir(type(self)))
            raise AttributeError(f"shapes have no {name}{use}", name=name, obj=self)


for _group, _names in NAMES.items():
    for _known, _name in _names.items():
        setattr(Shapes, _known, property(attrgetter(f"{_group}.{_name}"), doc=f"``{_group}.{_name}``"))


def no_shapes() -> Shapes:
    """Return the shapes of an empty scene."""
    none = np.zeros(0, np.int32)
    places, colors = np.zeros((0, 3)), np.zeros((0, 4), np.float32)
    return Shapes(none.astype(np.uint8), places, np.zeros((0, 3, 3)), none, none, colors, none)
