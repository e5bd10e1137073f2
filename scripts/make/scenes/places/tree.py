"""A tree, for outdoor places."""

from __future__ import annotations

from ..solids import modified, turned


def tree(scene, location, tall: float = 1.0, kind: int = 0) -> None:
    """Add a tree of one of four kinds: a crown and a trunk, 2.7 times ``tall`` high."""
    crown = [(0, 0.9), (0.45, 0.95), (0.75, 1.3), (0.8, 1.75), (0.62, 2.25), (0.35, 2.6), (0, 2.72)]
    color = ("6fa35a", "4f8f63", "8fb25f", "d99a4e")[kind % 4]
    made = turned(scene, "Crown", crown, location, (0, 0, 30 * kind), steps=16, sharp=180, color=color, index=10)
    modified(made, "SUBSURF", levels=1, render_levels=1)
    trunk = turned(scene, "Trunk", [(0.14, 0), (0.1, 1.2)], location, steps=12, color="8a6a52", index=11)
    made.scale = trunk.scale = (tall,) * 3
