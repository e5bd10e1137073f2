"""Cache of the shapes of evaluated geometry, kept until Blender reports a change.

A reading keeps the entries that it has used. The next reading of a depsgraph of the same mode finds an entry by the
address of the evaluated data and the object that Blender evaluated the data for. Blender reports to handlers which
objects have new geometry; such geometry is read again. In three cases Blender reports nothing or reports may be
missed, and all geometry is read again:

* handlers of other add-ons may change something, after which Blender evaluates once more without calling handlers;
* sculpting and painting change evaluated data in place, and so does editing the data of the edited mesh;
* without registration there are no handlers.

Meshes that are read again are compared with the cached meshes, so that equal triangles keep the same record.
"""

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace
from functools import cached_property

import bpy
from bpy.app.handlers import persistent

from ...core.mesh import Mesh
from ...core.motion.means import same
from ...core.shapes.instances import Primitive
from . import texels

Found = tuple[Primitive | None, str]
"""Shapes of evaluated data, and a text on the parts that cannot be cast."""

STEADY = {"OBJECT", "POSE", "EDIT"}
"""Modes of the active object in which Blender reports every change."""

PACKAGE = __name__.rpartition("blender.")[0]


@dataclass
class _Entry:
    geometry: Found
    owners: set[int] = field(default_factory=set)
    """The session_uid of the objects that the data was evaluated for; empty if something may have changed since."""

    @property
    def mesh(self) -> Mesh | None:
        primitive, _ = self.geometry
        return None if primitive is None else primitive.mesh


_entries: dict[str, dict[tuple[int, Hashable], _Entry]] = {}
"""Entries by the depsgraph's mode, VIEWPORT or RENDER: a render's thread and the window's share no entries; those of a
copy of the scene by COPY.
"""
COPY = "COPY"
copies: set[int] = set()
"""The session_uid of each copy of a scene that is evaluated at other frames than the scene: see ``copied``."""


class Reading:
    """One reading of a depsgraph."""

    def __init__(self, depsgraph):
        self._mode = _mode(depsgraph)
        active = depsgraph.view_layer.objects.active
        self._trusted = _is_told() and (active is None or active.mode in STEADY)
        self._before = _entries.get(self._mode, {})
        self._used: dict[tuple[int, Hashable], _Entry] = {}

    def find(self, data, owner, setting: Hashable, read: Callable[[], Found]) -> Found:
        """Return the shapes of an original object's evaluated data, from the cache or from ``read``."""
        key, uid = (data.as_pointer(), setting), owner.session_uid
        entry = self._used.get(key)
        if entry is None:
            entry = self._before.get(key) if self._trusted else None
            if entry is None or uid not in entry.owners:
                entry = self._shared(_Entry(read()))
            self._used[key] = entry
        if not getattr(data, "is_editmode", False):
            entry.owners.add(uid)
        return entry.geometry

    def _shared(self, entry: _Entry) -> _Entry:
        """Return an entry with the cached record of the same triangles, if there is one; otherwise ``entry`` itself."""
        mesh = entry.mesh
        if mesh is None:
            return entry
        known = self._meshes.setdefault(_sample(mesh), mesh)
        if known is mesh or not same(known, mesh):
            return entry
        primitive, reason = entry.geometry
        return _Entry((replace(primitive, mesh=known), reason))

    @cached_property
    def _meshes(self) -> dict[tuple, Mesh]:
        known = {**_entries.get("VIEWPORT", {}), **self._before} if self._mode == COPY else self._before
        return {_sample(entry.mesh): entry.mesh for entry in known.values() if entry.mesh is not None}

    def keep(self) -> None:
        """Keep the entries that were used and discard all others."""
        _entries[self._mode] = self._used


def _mode(depsgraph) -> str:
    return COPY if depsgraph.scene.session_uid in copies else depsgraph.mode


def forget_copy() -> None:
    """Discard the entries of a copy, whose evaluated data is freed."""
    copies.clear()
    _entries.pop(COPY, None)


def _sample(mesh: Mesh) -> tuple:
    """Return a key that is the same for equal meshes: sizes and some of the vertices."""
    vertices = mesh.vertices[:, :: max(1, mesh.vertices.shape[1] // 64)]
    return len(mesh), mesh.vertices.shape[1], vertices.tobytes()


def _is_told() -> bool:
    """Whether this module's handlers are registered, and no handlers of others, whose changes it may miss."""
    for event in ("depsgraph_update_post", "frame_change_post"):
        handlers = getattr(bpy.app.handlers, event)
        if tag not in handlers or not all(
            str(getattr(handler, "__module__", "")).startswith(PACKAGE) for handler in handlers
        ):
            return False
    return True


@persistent
def tag(scene, depsgraph):
    """Mark the entries of objects whose evaluation gave them new geometry as outdated."""
    if not _is_told():
        mark_all()
        return
    changed = {update.id.original.session_uid for update in depsgraph.updates if update.is_updated_geometry}
    for entry in _entries.get(_mode(depsgraph), {}).values():
        if not changed.isdisjoint(entry.owners):
            entry.owners.clear()


@persistent
def watch(*_):
    """Check the handlers before an evaluation, since another handler may be removed during it."""
    if not _is_told():
        mark_all()


@persistent
def mark_all(*_):
    """Mark all entries as possibly outdated, since any object may have changed."""
    for entries in _entries.values():
        for entry in entries.values():
            entry.owners.clear()


@persistent
def forget(*_):
    """Discard all entries when another file is loaded."""
    _entries.clear()


def register(undo) -> None:
    undo.callback(forget)
    undo.add_handlers(watch, "depsgraph_update_pre", "frame_change_pre")
    undo.add_handlers(tag, "depsgraph_update_post", "frame_change_post")
    undo.add_handlers(mark_all, "undo_post", "redo_post")
    undo.add_handlers(forget, "load_pre")
    undo.add_handlers(texels.forget, "load_pre")
