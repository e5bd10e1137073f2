"""The shapes of several records as one record."""

from collections.abc import Sequence
from itertools import chain
from typing import Any

import numpy as np

from ..records import EVERYWHERE, InputError, Lights, Shapes, Slots, no_shapes

ROWS = "kind", "center", "axes", "object_index", "material_index", "color"
"""Arrays of ``Shapes`` with one entry per shape."""
TABLES = "names", "meshes", "surfaces", "left_out", "unread", "exact", "notes"
"""Tuples of ``Shapes`` that are put one after the other."""
INDICES = {"name_index": "names", "mesh": "meshes", "surface": "surfaces"}
"""Arrays with an index into a table for each shape; empty where the table is."""
LIGHTS = "position", "is_sun", "color"
SAME_UV = np.eye(2, 3)
"""The UV map of ``Shapes.uv`` that changes nothing."""


def join(*shapes: Shapes) -> Shapes:
    """Return the shapes of several records as one, in their order. The world's color and background are the first
    record's; all lights are kept.

    Raises InputError for shapes that move, and TypeError for anything but shapes.
    """
    for record in shapes:
        if not isinstance(record, Shapes):
            raise TypeError(f"join takes shapes one by one, as join(*shapes), not {type(record).__name__}")
        if (record.motion, record.next, record.previous) != (None, None, None):
            raise InputError("shapes that move cannot be joined: join those of one frame")
    if len(shapes) < 2:
        return shapes[0] if shapes else no_shapes()
    tables: dict[str, Any] = {name: _chained(getattr(record, name) for record in shapes) for name in TABLES}
    rows: dict[str, Any] = {name: np.concatenate([getattr(record, name) for record in shapes]) for name in ROWS}
    for name, table in INDICES.items():
        columns = [_column(getattr(record, name), len(record)) for record in shapes]
        moved = _moved(columns, [getattr(record, table) for record in shapes])
        rows[name] = moved if tables[table] else np.zeros(0, np.int32)
    shared = [record.shared if len(record.shared) else np.zeros(len(record), bool) for record in shapes]
    maps = [np.tile(SAME_UV, (len(record.names), 1, 1)) if record.uv is None else record.uv for record in shapes]
    return Shapes(
        **rows,
        **tables,
        instanced=_chained(record.instanced or (False,) * len(record.names) for record in shapes),
        materials=tuple(dict.fromkeys(_chained(record.materials for record in shapes))),
        lights=_lights([record.lights for record in shapes]),
        world=shapes[0].world,
        identity=_identity(shapes),
        shared=np.concatenate(shared) if tables["meshes"] else np.zeros(0, bool),
        slots=_slots(shapes, bool(tables["surfaces"])),
        uv=None if all(record.uv is None for record in shapes) else np.concatenate(maps),
    )


def _identity(shapes: Sequence[Shapes]) -> np.ndarray:
    """Return the identities of the shapes if all of them have one, each its own."""
    identities = np.concatenate([record.identity for record in shapes])
    is_whole = len(identities) == sum(map(len, shapes)) == len(np.unique(identities))
    return identities if is_whole else np.zeros(0, np.int64)


def _chained(parts) -> tuple:
    return tuple(chain.from_iterable(parts))


def _column(indices: np.ndarray, n: int) -> np.ndarray:
    """Return indices for n rows, -1 where there are none."""
    return indices if len(indices) == n else np.full(n, -1, np.int32)


def _moved(columns: Sequence[np.ndarray], tables: Sequence[Any]) -> np.ndarray:
    """Return indices into several tables as indices into all of them, one after the other; -1 stays."""
    firsts = np.cumsum([0, *map(len, tables)])[: len(columns)]
    moved = [np.where(column < 0, column, column + first) for column, first in zip(columns, firsts, strict=True)]
    return np.concatenate(moved).astype(columns[0].dtype)


def _lights(lights: Sequence[Lights]) -> Lights:
    parts: dict[str, Any] = {name: np.concatenate([getattr(record, name) for record in lights]) for name in LIGHTS}
    if any(len(record.axis) for record in lights):
        for name, other in (("axis", (0.0, 0.0, 0.0)), ("cone", EVERYWHERE)):
            columns = [getattr(record, name) for record in lights]
            filled = [
                column if len(column) else np.tile(other, (len(record.is_sun), 1))
                for column, record in zip(columns, lights, strict=True)
            ]
            parts[name] = np.concatenate(filled)
    return Lights(**parts, left_out=_chained(record.left_out for record in lights))


def _slots(shapes: Sequence[Shapes], has_surfaces: bool) -> Slots | None:
    none = np.zeros(0, np.int32)
    if all(record.slots is None for record in shapes):
        return None
    slots = [record.slots or Slots(np.full(len(record), -1), none, np.zeros((0, 4), np.float32)) for record in shapes]
    surfaces = [_column(slot.surface, len(slot.material_index)) for slot in slots]
    return Slots(
        first=_moved([slot.first for slot in slots], [slot.material_index for slot in slots]),
        material_index=np.concatenate([slot.material_index for slot in slots]),
        color=np.concatenate([slot.color for slot in slots]),
        surface=_moved(surfaces, [record.surfaces for record in shapes]) if has_surfaces else none,
    )
