"""A rotunda: columns around a fountain, under a dome with ribs."""

from __future__ import annotations

from math import cos, degrees, pi, radians, sin

from ..parts import add, square, sun
from ..solids import assembled, block, drawn, modified, monkey, stand, turned
from .tree import tree

STONE, PALE = "d8cbb2", "ece4d3"


def rotunda(scene) -> None:
    """Fill the scene with twelve columns around a fountain, r <= 6, under a ribbed dome with an opening at the top."""
    add(scene, "Lawn", square(), (0, 0, -0.35), scale=99, color="93b06f", index=1)
    for k, radius in enumerate((7.8, 7.4, 7.0)):
        disc = [(0, 0.12 * (k - 2)), (radius, 0.12 * (k - 2)), (radius, 0.12 * (k - 3))]
        turned(scene, f"Step {k}", disc, steps=96, color=("c3b59b", "cfc2a9", "b7876a")[k], index=2)
    tiles(scene)
    order = assembled(scene, "Column", [
        turned(scene, "Shaft", [(0.42 - 0.1 * (k / 8) ** 2, 0.35 + 0.4 * k) for k in range(9)], color=PALE, index=3),
        turned(scene, "Base", [(0, 0.35), (0.43, 0.35), (0.5, 0.3), (0.52, 0.25), (0.48, 0.2), (0.56, 0.14),
                               (0.56, 0.1)], color=STONE, index=3),
        block(scene, "Plinth", (1.2, 1.2, 0.12), (0, 0, 0.06), color=STONE, index=3),
        turned(scene, "Echinus", [(0.32, 3.5), (0.36, 3.55), (0.34, 3.6), (0.36, 3.64), (0.5, 3.8), (0.5, 3.84)],
               color=STONE, index=3),
        block(scene, "Abacus", (1.1, 1.1, 0.14), (0, 0, 3.9), color=STONE, index=3),
    ])  # fmt: skip
    for k in range(12):
        angle = 2 * pi * (k + 0.5) / 12
        stand(scene, order, (6 * cos(angle), 6 * sin(angle), 0), (0, 0, degrees(angle)))
    beam = [(5.5, 3.97), (5.5, 4.3), (5.45, 4.3), (5.45, 4.6), (5.3, 4.68), (5.3, 4.75)]
    turned(scene, "Entablature", [*beam, (6.7, 4.75), (6.7, 4.68), (6.55, 4.6), (6.55, 3.97), (5.5, 3.97)],
           steps=96, sharp=20, color=PALE, index=4)  # fmt: skip
    dome(scene)
    fountain(scene)
    for k in range(16):
        angle, away = 2 * pi * (k + 0.2 * sin(3 * k)) / 16, 15 + 4 * sin(2.1 * k)
        tree(scene, (away * cos(angle), away * sin(angle), -0.35), 1.5 + 0.4 * sin(1.3 * k), k)
    sun(scene, (46, 0, -46), 1.9, "ffedcf")
    sun(scene, (150, 0, 20), 0.5, "ffe9cf")


def tiles(scene) -> None:
    """Add a floor of rings with alternating light and dark tiles."""
    rings = 1.6, 2.5, 3.4, 4.3, 5.2
    for k, inner in enumerate(rings):
        outer, count = inner + 0.9, 36
        step = 2 * pi / count
        for shade, color in enumerate(("e9dfca", "a8644a")):
            corners, faces = [], []
            for j in range(count):
                if (j + k) % 2 == shade:
                    for a, r in ((j, inner), (j, outer), (j + 1, outer), (j + 1, inner)):
                        corners.append((r * cos(a * step), r * sin(a * step), 0.004))
                    faces.append(tuple(range(len(corners) - 4, len(corners))))
            add(scene, "Tiles", drawn(f"tiles {k} {shade}", corners, faces=faces), color=color, index=2)


def dome(scene) -> None:
    """Add the dome: a shell with a hole, and ribs inside it, the wireframe of a coarser dome."""

    def arc(radius, count):
        angles = [radians(2 + 72 * k / count) for k in range(count + 1)]
        return [(radius * cos(angle), 4.75 + 0.82 * radius * sin(angle)) for angle in angles]

    turned(scene, "Dome", arc(5.95, 24), steps=96, color="7fa3bd", index=5)
    ribs = turned(scene, "Ribs", arc(5.9, 5), steps=24, color=PALE, index=6)
    modified(ribs, "WIREFRAME", thickness=0.3)


def fountain(scene) -> None:
    """Add a basin and a bowl with water, and a golden monkey."""
    basin = [
        (0, 0),
        (1.5, 0),
        (1.5, 0.12),
        (1.3, 0.16),
        (1.34, 0.5),
        (1.42, 0.56),
        (1.4, 0.6),
        (1.25, 0.6),
        (1.2, 0.2),
        (0, 0.2),
    ]
    turned(scene, "Basin", basin, steps=64, color=STONE, index=7)
    turned(scene, "Water", [(0, 0.5), (1.23, 0.5)], steps=64, color="5f9fc0", index=8)
    stem = [
        (0, 0.2),
        (0.34, 0.2),
        (0.2, 0.5),
        (0.16, 0.9),
        (0.3, 1.1),
        (0.75, 1.3),
        (0.8, 1.36),
        (0.7, 1.36),
        (0.2, 1.2),
        (0, 1.2),
    ]
    turned(scene, "Bowl", stem, steps=48, color=STONE, index=7)
    turned(scene, "Water", [(0, 1.31), (0.7, 1.31)], steps=48, color="7fb6d0", index=8)
    turned(
        scene,
        "Pedestal",
        [(0, 1.2), (0.14, 1.2), (0.1, 1.35), (0.1, 1.55), (0.22, 1.65), (0.22, 1.72), (0, 1.72)],
        color=STONE,
        index=7,
    )
    monkey(scene, (0, 0, 2.12), (-14, 0, 0), 0.5, color="e0b040", index=9)
