"""The picture of the house: the rooms of the package in layers, from the table of who may import whom.

A room stands one layer above the highest room that it may import; an arrow that follows from others is left out. Rooms
of a layer are ordered by the means of their neighbors: K. Sugiyama, S. Tagawa and M. Toda, Methods for Visual
Understanding of Hierarchical System Structures, IEEE Transactions on Systems, Man, and Cybernetics 11 (1981).
"""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

Arrows = dict[str, set[str]]
"""The rooms that a room may import, by name."""
Place = str | tuple[str, str, int]
"""What stands in a layer: a room, or an arrow from a room to another that passes, at this layer."""

WIDTH, HEIGHT = 98, 26
"""Of a room, in units of the picture."""
COLUMN, ROW, MARGIN, GAP = 108, 58, 16, 34
SWEEPS = 24
COLORS = {"blender": ("#fdf1e3", "#b5651d"), "core": ("#eaf2fb", "#2f6db3")}
"""Of the bands, from the top: inside, and lines."""
SVG = """\
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">
<title>The rooms of the package, and what each may import: arrows point down</title>
<rect width="{width}" height="{height}" rx="8" fill="#fff"/>
{bands}
<g fill="none" stroke="#888">
{arrows}
</g>
<g text-anchor="middle">
{rooms}
</g>
</svg>
"""


def picture(test: Path) -> str:
    """Return the picture as SVG, from the test that holds the table."""
    table = table_of(test)
    drawn = {band: layers(rooms_of(table, band)) for band in COLORS}
    width = max(COLUMN * max(map(len, rows)) for rows, _ in drawn.values()) + 2 * MARGIN
    top = 2 * MARGIN + HEIGHT
    bands, arrows, rooms = [], [], [room(width / 2, MARGIN + HEIGHT / 2, "camera_ray_caster", "#444", 150)]
    for band, (rows, below) in drawn.items():
        fill, stroke = COLORS[band]
        height = ROW * len(rows) + MARGIN
        arrows.append(f'<path d="M{width / 2:g} {top - (MARGIN if top < 2 * ROW else GAP)}V{top}" stroke-width="3"/>')
        bands.append(f'<rect x="4" y="{top}" width="{width - 8}" height="{height}" rx="8" fill="{fill}"/>')
        bands.append(f'<text x="14" y="{top + 20}" fill="{stroke}" font-weight="bold">{band}</text>')
        at = {
            name: (width / 2 + COLUMN * (k - (len(row) - 1) / 2), top + MARGIN / 2 + ROW * (line + 0.5))
            for line, row in enumerate(reversed(rows))
            for k, name in enumerate(row)
        }
        level = {name: line for line, row in enumerate(rows) for name in row}
        for name in sorted(below):
            for lower in sorted(below[name]):
                passed = [(name, lower, line) for line in range(level[name] - 1, level[lower], -1)]
                arrows.append(curve([at[position] for position in (name, *passed, lower)]))
            rooms.append(room(*at[name], name, stroke))
        top += height + GAP
    return SVG.format(
        width=width,
        height=top - GAP + 4,
        bands="\n".join(bands),
        arrows="\n".join(arrows),
        rooms="\n".join(rooms),
    )


def table_of(test: Path) -> dict[str, set[str]]:
    """Return the table of who may import whom: MAY_IMPORT of the test, by the names that it is written with."""
    body = ast.parse(test.read_text(encoding="utf-8")).body
    assigned = {ast.unparse(node.targets[0]): node.value for node in body if isinstance(node, ast.Assign)}

    def value(name: str):
        used = {node.id for node in ast.walk(assigned[name]) if isinstance(node, ast.Name)}
        return eval(ast.unparse(assigned[name]), {used_name: value(used_name) for used_name in used & assigned.keys()})

    return value("MAY_IMPORT")


def rooms_of(table: dict[str, set[str]], band: str) -> Arrows:
    """Return the rooms of a band, each with those that it may import, but for what follows."""
    inner = {name for name in table if name.startswith(f"{band}.") and name.count(".") == 1}
    allowed = {
        name: set().union(*(below for inner_name, below in table.items() if f"{inner_name}.".startswith(f"{name}.")))
        & inner - {name}
        for name in inner
    }
    if band == "blender":
        allowed["blender.registration"] = inner  # of all

    @cache
    def reach(name: str) -> frozenset[str]:
        return frozenset().union(*({other} | reach(other) for other in allowed[name]))

    direct = {
        name: {other for other in others if not any(other in reach(above) for above in others)}
        for name, others in allowed.items()
    }
    return {short(name): set(map(short, others)) for name, others in direct.items()}


def short(name: str) -> str:
    """Return a room's name without its band."""
    return name.partition(".")[2]


def layers(below: Arrows) -> tuple[list[list[Place]], Arrows]:
    """Return the layers from the lowest up, with the places where arrows pass, and the arrows."""

    @cache
    def level(name: str) -> int:
        return max((level(other) + 1 for other in below[name]), default=0)

    rows: list[list[Place]] = [[] for _ in range(1 + max(map(level, below)))]
    ends: list[tuple[Place, Place]] = []
    for name in sorted(below):
        rows[level(name)].append(name)
        for other in sorted(below[name]):
            passed: list[Place] = [(name, other, line) for line in range(level(name) - 1, level(other), -1)]
            for passage in passed:
                rows[passage[2]].append(passage)
            ends += zip((name, *passed), (*passed, other), strict=True)
    near: dict[Place, list[Place]] = {node: [] for row in rows for node in row}
    for upper, lower in ends:
        near[upper].append(lower)
        near[lower].append(upper)
    order = {node: k - len(row) / 2 for row in rows for k, node in enumerate(row)}
    for _ in range(SWEEPS):
        for row in rows:
            row.sort(key=lambda node: sum(order[other] for other in near[node]) / max(1, len(near[node])))
            order |= {node: k - (len(row) - 1) / 2 for k, node in enumerate(row)}
    return rows, below


def room(x: float, y: float, name: str, stroke: str, width: float = WIDTH) -> str:
    """Return a room around its middle."""
    left, top = x - width / 2, y - HEIGHT / 2
    return (
        f'<rect x="{left:g}" y="{top:g}" width="{width}" height="{HEIGHT}" rx="4" fill="#fff" stroke="{stroke}"/>'
        f'<text x="{x:g}" y="{y + 4.5:g}">{name}</text>'
    )


def curve(points: list[tuple[float, float]]) -> str:
    """Return an arrow through places, from the lower side of a room to the upper side of another."""
    (x, y), *others = points
    path = f"M{x:g} {y + HEIGHT / 2:g}"
    y += HEIGHT / 2
    for k, (to_x, to_y) in enumerate(others):
        end = to_y - HEIGHT / 2 if k == len(others) - 1 else to_y
        middle = (y + end) / 2
        path += f"C{x:g} {middle:g} {to_x:g} {middle:g} {to_x:g} {end:g}"
        x, y = to_x, end
    return f'<path d="{path}"/>'
