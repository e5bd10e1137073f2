"""The links of a node tree: which expression a socket has, through groups, reroutes and muted nodes."""

from collections.abc import Callable, Hashable, Iterator, Mapping
from typing import Any, TypeVar

import bpy
import numpy as np

from ...core.materials.values import Value, constant, function_of, gray, mean

DEEPEST = 100
"""Nodes in a row that are followed: each takes some five of the thousand calls that Python nests."""

FLATTENED = bpy.app.version >= (5, 0, 0)
"""Whether Cycles merges the outputs of a tree and of its groups into one list. Earlier versions link the inputs of the
outputs one by one, those in groups first.
"""

ONLY_USABLE = bpy.app.version >= (5, 2, 0)
"""Whether the first active output is sought among those that Cycles can use; among all in earlier versions."""

OUTPUTS = {"ShaderNodeOutputMaterial", "ShaderNodeOutputWorld", "ShaderNodeOutputLight"}
"""The nodes that Cycles renders, by type."""

T = TypeVar("T")

NUMBERS = {"VALUE", "INT", "BOOLEAN"}


class Unread(Exception):
    """A node, or a setting of it, that is not read; the message names it."""


Source = tuple[Any, Any, tuple]
"""A node, its output socket and the group nodes around it, the innermost last; or None and a socket that has a value of
its own.
"""


Output = Mapping[str, tuple[Any, tuple]]
"""The input sockets of an output by name, each with the group nodes around it."""


def output_of(tree) -> Output | None:
    """Return the output of a node tree that Cycles renders, which may be inside a group; None if there is none."""
    if FLATTENED:
        there = list(_outputs(tree, ()))
        chosen = _chosen([node for node, _ in there])
        return next((_inputs(node, groups) for node, groups in there if node == chosen), None)
    there = [_inputs(node, groups) for node, groups in _linked_first(tree, ())]
    first = {name: inputs[name] for inputs in reversed(there) for name in inputs if inputs[name][0].is_linked}
    return {**there[-1], **first} if there else None


def _inputs(node, groups: tuple) -> Output:
    return {socket.name: (socket, groups) for socket in node.inputs}


def _groups(tree) -> Iterator:
    """Yield the group nodes of a tree that have an output inside."""
    known: dict[int, bool] = {}
    for node in tree.nodes:
        if node.type == "GROUP" and not node.mute and node.node_tree is not None and _has_output(node.node_tree, known):
            yield node


def _has_output(tree, known: dict[int, bool]) -> bool:
    """Return whether a tree or a group in it has an output; each tree is looked at once, by its address."""
    key = tree.as_pointer()
    if key not in known:
        known[key] = False
        inner = (node.node_tree for node in tree.nodes if node.type == "GROUP" and node.node_tree is not None)
        is_around = any(node.bl_idname in OUTPUTS for node in tree.nodes)
        known[key] = is_around or any(_has_output(group, known) for group in inner)
    return known[key]


def _outputs(tree, groups: tuple) -> Iterator[tuple[Any, tuple]]:
    """Yield the outputs of a tree, then those of its groups, each with the group nodes around it."""
    yield from ((node, groups) for node in tree.nodes if node.bl_idname in OUTPUTS)
    for group in _groups(tree):
        yield from _outputs(group.node_tree, (*groups, group))


def _linked_first(tree, groups: tuple) -> Iterator[tuple[Any, tuple]]:
    """Yield the output of each group, then that of the tree, in the order in which Cycles 4 links them."""
    for group in _groups(tree):
        yield from _linked_first(group.node_tree, (*groups, group))
    output = _chosen([node for node in tree.nodes if node.bl_idname in OUTPUTS])
    if output is not None and not output.mute:
        yield output, groups


def _chosen(outputs: list):
    """Return the output that Cycles prefers: one of its own before one of all engines, then the active one."""
    usable = [node for node in outputs if node.target != "EEVEE"]
    active = next((node for node in (usable if ONLY_USABLE else outputs) if node.is_active_output), None)
    for target in ("CYCLES", "ALL"):
        candidates = [node for node in usable if node.target == target]
        if candidates:
            return active if active in candidates else candidates[0]
    return None


class Nodes:
    """A node tree and the expressions of its sockets."""

    def __init__(self, read: dict[str, Callable], reads_images: bool = True):
        """Take the functions that read nodes by type: each returns the expression of an output, given this object,
        the node as a ``Node`` and the output socket. ``reads_images``: whether the expressions are evaluated.
        """
        self.read, self.reads_images = read, reads_images
        self.needs: set[str] = set()
        """The layers of the mesh that expressions use, and OBJECT for places in the object's space."""
        self.missing: set[str] = set()
        """The names of images that cannot be loaded."""
        self._known: dict[Hashable, Any] = {}
        self._open: set[Hashable] = set()

    def source(self, socket, groups: tuple) -> Source:
        """Return where the value of an input socket comes from."""
        for _ in range(DEEPEST):
            links = socket.links if socket.is_linked else ()
            if not links or links[0].is_muted:
                return None, socket, groups
            node, output = links[0].from_node, links[0].from_socket
            if node.type == "REROUTE":
                following = node.inputs[0]
            elif node.mute:
                inner = [link.from_socket for link in node.internal_links if link.to_socket == output]
                following = inner[0] if inner else None
            elif node.type == "GROUP_INPUT" and groups:
                groups, outer = groups[:-1], groups[-1]
                following = _by_identifier(outer.inputs, output.identifier)
            elif node.type == "GROUP" and node.node_tree is not None:
                inside = node.node_tree.nodes
                ends = [node for node in inside if node.type == "GROUP_OUTPUT" and node.is_active_output]
                following = _by_identifier(ends[0].inputs, output.identifier) if ends else None
                groups = (*groups, node)
            else:
                return node, output, groups
            if following is None:
                return None, output, groups
            socket = following
        raise Unread("its nodes form a loop")

    def value(self, socket, groups: tuple, kind: str = "") -> Value:
        """Return the expression of an input socket as a value of a type: VALUE, RGBA or VECTOR, by default its own."""
        kind = kind or socket.type
        node, output, inner = self.source(socket, groups)
        value = own_value(output) if node is None else self.output(node, output, inner)
        return converted(converted(value, output.type, socket.type), socket.type, kind)

    def output(self, node, output, groups: tuple) -> Value:
        """Return the expression of an output of a node."""
        read = self.read.get(node.bl_idname)
        if read is None:
            raise Unread(f"node {node.name!r} ({node.bl_rna.name})")
        node_in_group = Node(self, node, groups)
        return self.once(node_in_group, output.identifier, lambda: read(self, node_in_group, output))

    def once(self, node: "Node", name: str, read: Callable[[], T]) -> T:
        """Return what is read of a node, by name: it is read at its first use. Raises Unread in a loop, and if more
        than DEEPEST nodes are in a row.
        """
        key = node.as_pointer(), name, tuple(group.as_pointer() for group in node.groups)
        if key in self._open:
            raise Unread("its nodes form a loop")
        if len(self._open) >= DEEPEST:
            raise Unread(f"more than {DEEPEST} nodes in a row")
        if key not in self._known:
            self._open.add(key)
            try:
                self._known[key] = read()
            finally:
                self._open.discard(key)
        return self._known[key]


class Node:
    """A node inside some groups, and the expressions of its inputs."""

    def __init__(self, nodes: Nodes, node, groups: tuple):
        self.nodes, self.node, self.groups = nodes, node, groups

    def __getattr__(self, name: str):
        return getattr(self.node, name)

    def socket(self, key: str | int):
        """Return an input socket by its place, its identifier or its name."""
        if isinstance(key, int):
            return self.node.inputs[key]
        return _by_identifier(self.node.inputs, key) or self.node.inputs[key]

    def input(self, key: str | int, kind: str = "") -> Value:
        """Return the expression of an input."""
        return self.nodes.value(self.socket(key), self.groups, kind)

    def is_linked(self, key: str | int) -> bool:
        """Whether an input gets its value from another node."""
        return self.nodes.source(self.socket(key), self.groups)[0] is not None

    def unread(self, setting: str) -> Unread:
        """Return the error that names a setting of the node."""
        return Unread(f"node {self.node.name!r} ({self.node.bl_rna.name}): {setting}")


def own_value(socket) -> Value:
    """Return the value that is set at a socket."""
    value = getattr(socket, "default_value", 0.0)
    numbers = tuple(value)[:3] if hasattr(value, "__len__") else (float(value),)
    return constant(*numbers)


def converted(value: Value, of: str, to: str) -> Value:
    """Return a value of one type of socket as another type, as Blender converts it."""
    if (of in NUMBERS) == (to in NUMBERS):
        return value
    if to in NUMBERS:
        return gray(value) if of == "RGBA" else mean(value)
    return function_of(lambda values: np.repeat(values, 3, axis=0), value)


def _by_identifier(sockets, identifier: str):
    return next((socket for socket in sockets if socket.identifier == identifier), None)
