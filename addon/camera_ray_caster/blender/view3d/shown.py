"""What a 3D View in camera view shows: the picture of the camera's model, or Blender's own view from the camera."""

from typing import Any

from ..properties.declared import BLENDERS_OWN, ENGINE, GROUP
from ..read.camera_fields import shader_mark
from ..read.view import camera_frame

ENGINES = "BLENDER_EEVEE", "BLENDER_EEVEE_NEXT", "BLENDER_WORKBENCH"
"""Engines whose Rendered shading is shown live."""

live: dict[int, dict[int, Any]] = {}
"""The live views of the regions of each live 3D View, by pointers."""


def is_live(space) -> bool:
    """Return whether a 3D View is live."""
    return bool(live) and space.as_pointer() in live


def can_show(space, scene) -> bool:
    """Return whether the shading of a 3D View is one that can be live."""
    return space.shading.type != "RENDERED" or scene.render.engine in ENGINES


def drawn_alike(camera) -> bool:
    """Return whether Blender's own view from a camera object is the picture of its model."""
    if camera is None or camera.type != "CAMERA":
        return True
    return getattr(camera.data, GROUP).model == BLENDERS_OWN and camera.data.type in {"PERSP", "ORTHO"}


def is_other(space, scene) -> bool:
    """Return whether a 3D View shows, in camera view, another picture than that of the camera's model."""
    camera = scene.camera
    if drawn_alike(camera) or (is_live(space) and can_show(space, scene)):
        return False
    if space.shading.type != "RENDERED" or scene.render.engine in ENGINES:
        return True
    is_cycles_own = getattr(camera.data, GROUP).model == BLENDERS_OWN or shader_mark(camera.data) is not None
    return not (scene.render.engine == ENGINE or is_cycles_own)


def picture_frame(context) -> tuple[float, float, float, float] | None:
    """Return left, bottom, right, top of the picture of the camera's model in the region's pixels, or None if the view
    does not show it.
    """
    frame = camera_frame(context)
    return None if frame is None or is_other(context.space_data, context.scene) else frame
