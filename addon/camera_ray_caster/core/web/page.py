"""The page."""

from __future__ import annotations

from ..camera.camera import Camera
from ..cameras.model import Model
from ..library.cameras import camera

FRAME = 640, 360
"""Width and height in pixels of the page's own cameras."""

LINES = {
    "slit_1": ((-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
    "slit_2": ((0.0, -1.0, 0.5), (0.0, 1.0, 0.5)),
    "path": ((-2.0, 0.0, 0.0), (2.0, 0.0, 0.0)),
}
"""The objects of the page's own cameras, in their frames."""


def example(model: type[Model]) -> Camera:
    """Return the camera of a model with which the page begins."""
    lines = {setting.name: LINES[setting.name] for setting in model.SETTINGS if setting.name in LINES}
    return camera(model.key, FRAME, **lines)
