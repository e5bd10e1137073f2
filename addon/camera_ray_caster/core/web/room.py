"""The scene of the page: a room with a grid, and balls in it. Lengths are Blender units; x right, y up, z backward."""

from typing import Any

BALLS = (
    ("red ball", (0.0, 0.1, -0.6), 0.6, (0.78, 0.10, 0.09)),
    ("yellow ball", (1.25, -0.2, 0.1), 0.3, (0.86, 0.55, 0.06)),
    ("green ball", (-1.3, -0.1, 0.0), 0.4, (0.10, 0.50, 0.16)),
    ("blue ball", (1.5, 0.55, -1.7), 0.75, (0.09, 0.26, 0.75)),
    ("white ball", (-1.6, 0.9, -1.9), 0.5, (0.80, 0.80, 0.78)),
    ("violet ball", (0.35, 1.35, -1.1), 0.28, (0.42, 0.13, 0.62)),
    ("orange ball", (-0.55, -0.32, 0.7), 0.18, (0.90, 0.27, 0.03)),
)
"""Name, center, radius and linear color."""

LEFT, RIGHT, FLOOR, CEILING, BACK, FRONT = -6.0, 6.0, -0.5, 5.5, -8.0, 4.0
WIDE, HIGH, DEEP = (RIGHT - LEFT) / 2, (CEILING - FLOOR) / 2, (FRONT - BACK) / 2
MIDDLE = (LEFT + RIGHT) / 2, (FLOOR + CEILING) / 2, (BACK + FRONT) / 2
WALLS = (
    ("floor", (0.0, -HIGH, 0.0), (WIDE, 0.0, 0.0), (0.0, 0.0, -DEEP), (0.62, 0.60, 0.55)),
    ("ceiling", (0.0, HIGH, 0.0), (WIDE, 0.0, 0.0), (0.0, 0.0, DEEP), (0.72, 0.74, 0.76)),
    ("back wall", (0.0, 0.0, -DEEP), (WIDE, 0.0, 0.0), (0.0, HIGH, 0.0), (0.38, 0.52, 0.66)),
    ("wall behind the camera", (0.0, 0.0, DEEP), (WIDE, 0.0, 0.0), (0.0, HIGH, 0.0), (0.60, 0.44, 0.40)),
    ("left wall", (-WIDE, 0.0, 0.0), (0.0, 0.0, DEEP), (0.0, HIGH, 0.0), (0.46, 0.62, 0.46)),
    ("right wall", (WIDE, 0.0, 0.0), (0.0, 0.0, DEEP), (0.0, HIGH, 0.0), (0.64, 0.58, 0.38)),
)
"""Name, center from MIDDLE, half sides and linear color."""

EYE, NEAR = 0.6, 1e-4

SCENE: dict[str, Any] = {
    "spheres": [dict(zip(("name", "center", "radius", "color"), ball, strict=True)) for ball in BALLS],
    "rectangles": [
        {"name": name, "center": [a + b for a, b in zip(MIDDLE, off, strict=True)], "u": u, "v": v, "color": color}
        for name, off, u, v, color in WALLS
    ],
    "turn": (0.0, -0.6),
    "height": EYE, "floor": FLOOR, "back": BACK, "near": NEAR, "scale": 1.0,
    "camera": {"eye": (0.0, EYE, 0.0), "u": (1.0, 0.0, 0.0), "v": (0.0, 1.0, 0.0), "w": (0.0, 0.0, -1.0)},
    "nodes": 0, "triangles": 0, "names": [], "facets": "",
}  # fmt: skip
"""What the page's scripts know of the room. ``turn``: x and z of the axis about which the balls turn; ``height``: of
the eye; ``near``: least distance of a hit; ``camera``: its place and axes when it is not moved; ``scale``: of what the
second view draws; the others are those of ``page_scene``, of which the room has none.
"""
