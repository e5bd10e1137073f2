"""The passes in Blender's terms: their names in the render result, their channels, and their checkboxes."""

from dataclasses import dataclass

import bpy
import numpy as np

FROM_5_0 = bpy.app.version >= (5, 0, 0)

FAR = 1e10
"""Blender's depth where nothing is hit. EEVEE and Cycles store it, and the compositor takes it for the background."""


@dataclass(frozen=True)
class RenderPass:
    """A pass: ``key`` is the caster's name; ``label``, ``channels`` and ``kind`` are arguments of ``register_pass``."""

    key: str
    label: str
    channels: str
    kind: str
    tick: str
    own: bool = False
    """Whether the checkbox is in the add-on's settings of the scene instead of in the view layer."""

    def settings(self, scene, view_layer):
        """Return the struct that holds the checkbox."""
        return scene.camera_ray_caster if self.own else view_layer


PASSES = (
    RenderPass("combined", "Combined", "RGBA", "COLOR", "use_pass_combined"),
    RenderPass("albedo", "Albedo", "RGB", "COLOR", "use_pass_albedo", own=True),
    RenderPass("depth", "Depth", "Z", "VALUE", "use_pass_z"),
    RenderPass("position", "Position", "XYZ", "VECTOR", "use_pass_position"),
    RenderPass("normal", "Normal", "XYZ", "VECTOR", "use_pass_normal"),
    RenderPass("uv", "UV", "UVA", "VECTOR", "use_pass_uv"),
    RenderPass("object_index", "Object Index" if FROM_5_0 else "IndexOB", "X", "VALUE", "use_pass_object_index"),
    RenderPass("material_index", "Material Index" if FROM_5_0 else "IndexMA", "X", "VALUE", "use_pass_material_index"),
    RenderPass("distance", "Distance", "X", "VALUE", "use_pass_distance", own=True),
    RenderPass("shape_index", "Shape Index", "X", "VALUE", "use_pass_shape_index", own=True),
    RenderPass("face_index", "Face Index", "X", "VALUE", "use_pass_face_index", own=True),
    RenderPass("valid", "Valid", "X", "VALUE", "use_pass_valid", own=True),
    RenderPass("ray_origin", "Ray Origin", "XYZ", "VECTOR", "use_pass_ray_origin", own=True),
    RenderPass("ray_direction", "Ray Direction", "XYZ", "VECTOR", "use_pass_ray_direction", own=True),
    RenderPass("solid_angle", "Solid Angle", "X", "VALUE", "use_pass_solid_angle", own=True),
    RenderPass("footprint", "Footprint", "X", "VALUE", "use_pass_footprint", own=True),
    RenderPass("flow_forward", "Flow Forward", "XY", "VECTOR", "use_pass_flow_forward", own=True),
    RenderPass("flow_backward", "Flow Backward", "XY", "VECTOR", "use_pass_flow_backward", own=True),
    RenderPass("flow_hidden", "Flow Hidden", "XY", "VECTOR", "use_pass_flow_hidden", own=True),
    RenderPass("distance_bound", "Distance Bound", "X", "VALUE", "use_pass_distance_bound", own=True),
    RenderPass("position_bound", "Position Bound", "X", "VALUE", "use_pass_position_bound", own=True),
    RenderPass("normal_bound", "Normal Bound", "X", "VALUE", "use_pass_normal_bound", own=True),
)


def ticked(scene, view_layer) -> list[RenderPass]:
    """Return the passes that the user has enabled; if there are none, combined, which Blender always stores."""
    return [entry for entry in PASSES if getattr(entry.settings(scene, view_layer), entry.tick)] or [PASSES[0]]


def tick(scene, view_layer, keys) -> None:
    """Enable these passes and disable all others."""
    for entry in PASSES:
        setattr(entry.settings(scene, view_layer), entry.tick, entry.key in keys)


def stored(key: str, image: np.ndarray) -> np.ndarray:
    """Return an image as Blender stores it: flat float32, rows from the bottom; depth is FAR where nothing is hit."""
    flat = np.ascontiguousarray(image, dtype=np.float32).ravel()
    return np.where(np.isinf(flat), np.float32(FAR), flat) if key == "depth" else flat
