"""What was read of evaluated geometry, kept until Blender tells of a change.

A reading keeps what it has used, and the next one of a depsgraph of the same mode finds it by the address of the
evaluated data and by the object that Blender evaluated it for. Blender tells handlers which objects got another
geometry; what it has told of is read again. Three things it does not tell, and then everything is:

* handlers of others may change something, after which Blender evaluates once more without calling handlers;
* sculpting and painting change evaluated data in place, and so does editing that of the mesh that is edited;
* without registration there are no handlers.

What is read again is compared with what was kept, so that the same triangles stay the same record.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from functools import cached_property

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ...core.records import Mesh
from ...core.shapes.instances import Primitive, mesh_primitive

Found = tuple[Primitive | None, str]
"""What data stands for, and in words what of it cannot be cast."""

STEADY = {"OBJECT", "POSE", "EDIT"}
"""Modes of the active object in which Blender tells of every change."""

PACKAGE = __name__.rpartition("blender.")[0]


@dataclass
class _Entry:
    found: Found
    owners: set[int] = field(default_factory=set)
    """The session_uid of the objects that Blender evaluated it for; none where something may have changed since."""

    @property
    def mesh(self) -> Mesh | None:
        primitive, _ = self.found
        return None if primitive is None else primitive.mesh


_entries: dict[str, dict[tuple[int, str], _Entry]] = {}
"""By the depsgraph's mode: VIEWPORT or RENDER. A render's thread and the window's do not meet here."""


class Reading:
    """One reading of a depsgraph."""

    def __init__(self, depsgraph):
        self._mode = depsgraph.mode
        active = depsgraph.view_layer.objects.active
        self._trusted = _is_told() and (active is None or active.mode in STEADY)
        self._before = _entries.get(self._mode, {})
        self._used: dict[tuple[int, str], _Entry] = {}

    def find(self, data, owner, setting: str, read: Callable[[], Found]) -> Found:
        """Return what evaluated data of an original object stands for: what was kept, or what ``read`` gives."""
        key, uid = (data.as_pointer(), setting), owner.session_uid
        entry = self._used.get(key)
        if entry is None:
            entry = self._before.get(key) if self._trusted else None
            if entry is None or uid not in entry.owners:
                entry = self._shared(_Entry(read()))
            self._used[key] = entry
        if not getattr(data, "is_editmode", False):
            entry.owners.add(uid)
        return entry.found

    def _shared(self, entry: _Entry) -> _Entry:
        """Return an entry with the record of the same triangles, if there is one."""
        mesh = entry.mesh
        if mesh is None:
            return entry
        known = self._meshes.setdefault(_sample(mesh), mesh)
        return entry if known is mesh or not _same(known, mesh) else _Entry((mesh_primitive(known), ""))

    @cached_property
    def _meshes(self) -> dict[tuple, Mesh]:
        return {_sample(entry.mesh): entry.mesh for entry in self._before.values() if entry.mesh is not None}

    def keep(self) -> None:
        """Keep what was used, and nothing else."""
        _entries[self._mode] = self._used


def _sample(mesh: Mesh) -> tuple:
    """Return what two meshes that are the same have in common."""
    vertices = mesh.vertices[:, :: max(1, mesh.vertices.shape[1] // 64)]
    return len(mesh), mesh.vertices.shape[1], vertices.tobytes()


def _same(one: Mesh, other: Mesh) -> bool:
    pairs = ((getattr(one, each.name), getattr(other, each.name)) for each in fields(Mesh))
    return all(a is b or (a is not None and b is not None and np.array_equal(a, b)) for a, b in pairs)


def _is_told() -> bool:
    """Whether this module's handlers are there, and none of others that may change what they were told."""
    for event in ("depsgraph_update_post", "frame_change_post"):
        handlers = getattr(bpy.app.handlers, event)
        if tag not in handlers or not all(str(getattr(one, "__module__", "")).startswith(PACKAGE) for one in handlers):
            return False
    return True


@persistent
def tag(scene, depsgraph):
    """Something was evaluated: distrust what got another geometry."""
    if not _is_told():
        distrust()
        return
    changed = {update.id.original.session_uid for update in depsgraph.updates if update.is_updated_geometry}
    for entry in _entries.get(depsgraph.mode, {}).values():
        if not changed.isdisjoint(entry.owners):
            entry.owners.clear()


@persistent
def watch(*_):
    """Something is going to be evaluated: a handler of others may have gone when that is done."""
    if not _is_told():
        distrust()


@persistent
def distrust(*_):
    """Everything may be another one than it was."""
    for entries in _entries.values():
        for entry in entries.values():
            entry.owners.clear()


@persistent
def forget(*_):
    """Another file: keep nothing of this one."""
    _entries.clear()


HANDLERS = (
    ("depsgraph_update_pre", watch),
    ("depsgraph_update_post", tag),
    ("frame_change_pre", watch),
    ("frame_change_post", tag),
    ("undo_post", distrust),
    ("redo_post", distrust),
    ("load_pre", forget),
)


def register(undo) -> None:
    """See ``registration``."""
    undo.callback(forget)
    undo.add_handlers(HANDLERS)
