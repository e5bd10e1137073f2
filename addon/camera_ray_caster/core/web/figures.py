"""Figures of a lecture on cameras and ray generation, as states with which the page can begin."""

from typing import Any


def _figure(
    label: str, text: str, model: str, view: str = "outside", values: Any = (), look: Any = (), **state: Any
) -> dict[str, Any]:
    """Return a figure. view: the name of a point of view; look: where it differs from that."""
    figure: dict[str, Any] = {"label": label, "text": text, "model": model, "view": view}
    return figure | {"values": dict(values), "look": dict(look), "state": state}


ALL_AROUND = "The picture is the whole sphere of directions: its left and right edges show the same."
FIGURES = [
    _figure(
        "Pinhole box",
        "A box with a tiny hole: light comes through the hole to the wall, so that the image is inverted.",
        "CAMERA_OBSCURA",
    ),
    _figure(
        "Pyramid of view",
        "The eye and the image span a pyramid. How far away the image is does not matter: only its angle does.",
        "PERSP", values={"lens": 28.0},
    ),
    _figure(
        "Ray generation in 2D",
        "From above: the image over [-1, 1] lies at the distance d = 1 / tan(fov / 2) from the eye.",
        "PERSP", "above", {"lens": 28.0}, {"far": 5.0, "ahead": 1.4}, x=540.0, y=180.0,
    ),
    _figure(
        "Perspective", "All rays leave one eye: what is twice as far is half as large.", "PERSP", values={"lens": 35.0},
        x=460.0, y=200.0,
    ),
    _figure(
        "Orthographic",
        "From the same viewpoint: all rays are parallel to w, and their origins differ. Distance changes no size.",
        "ORTHO", values={"ortho_scale": 4.0}, x=460.0, y=200.0,
    ),
    _figure("Fisheye", "The angle from the axis grows with the radius: 180 degrees in a circle.", "FISHEYE_EQUIDISTANT",
            x=225.0, y=260.0, walk=0.9),
    _figure("Omnimax", "The fisheye of dome theaters: its axis lies below the middle of the film.", "OMNIMAX",
            walk=0.9),
    _figure("Panorama", ALL_AROUND, "EQUIRECTANGULAR", walk=0.9, x=240.0, y=200.0),
    _figure(
        "Multiperspective",
        "A pushbroom: the eye flies along a line while the picture is taken. Rows are in perspective, columns are not.",
        "PUSHBROOM", values={"ortho_scale": 6.0}, x=560.0, y=220.0,
    ),
    _figure(
        "Slit scan", "Each row is taken at a time of its own while the balls turn: straight things twist.", "PERSP",
        values={"lens": 35.0}, times="rows", spread=0.5,
    ),
    _figure(
        "Time displacement", "The time of a pixel grows from the middle of the picture out.", "PERSP",
        values={"lens": 35.0}, times="circles", spread=1.0,
    ),
]  # fmt: skip
"""Each with its model, and where they differ from the page's own, its settings and its state."""
