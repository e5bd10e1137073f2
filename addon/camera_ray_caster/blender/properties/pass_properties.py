"""The passes in Blender's terms: their names in the render result, their channels, and their checkboxes."""

from dataclasses import dataclass

import bpy
import numpy as np

from ...core.casting.passes import PASSES as CASTS
from ...core.casting.passes import Pass

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
    text: str
    """Tooltip of the checkbox."""
    tick: str
    """Name of the checkbox."""
    on_scene: bool = False
    """Whether the checkbox is in the add-on's settings of the scene instead of in the view layer."""

    def settings(self, scene, view_layer):
        """Return the struct that holds the checkbox."""
        return scene.camera_ray_caster if self.on_scene else view_layer


def _of(key: str, declared: Pass) -> RenderPass:
    """Return a declared pass in Blender's terms."""
    plain = declared.label or key.replace("_", " ").title()
    label = plain if FROM_5_0 else declared.label_before_5_0 or plain
    is_color = declared.letters.startswith("RGB")
    kind = "COLOR" if is_color else "VECTOR" if declared.channels else "VALUE"
    tick = declared.blender or f"use_pass_{key}"
    return RenderPass(key, label, declared.letters, kind, declared.text, tick, not declared.blender)


PASSES = tuple(sorted((_of(key, declared) for key, declared in CASTS.items()), key=lambda entry: entry.on_scene))
"""Blender's own passes, and then the add-on's."""


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
