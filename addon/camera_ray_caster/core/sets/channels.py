"""Passes in the multilayer EXR files of pictures: by their keys, as NPZ files have them.

Blender names channels LAYER.LABEL.LETTER, and writes a depth of inf as 1e10. A file has the whole frame, also where
only the render border was cast.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..casting.passes import PASSES
from ..names import file_names
from ..openexr.reading import channels_of

COMPOSITE = "Composite"
"""Blender's name for the layer of the compositor's result, which is no pass."""
NOTHING = 1e10
"""Depth from which Blender's files mean that nothing is hit."""
LABELS = {label.lower(): key for key, declared in PASSES.items()
          for label in (declared.label or key.replace("_", " "), declared.label_before_5_0) if label}  # fmt: skip


def passes_of(path: Path, camera: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Return the passes of a file, row 0 at the bottom: the pixels of the camera's window, as its report has it. With
    several view layers a key is LAYER.PASS. Raises InputError or OSError for a file that cannot be read.
    """
    channels = channels_of(path.read_bytes(), str(path))
    by_layer: dict[str, dict[str, dict[str, np.ndarray]]] = {}
    for name, values in channels.items():
        layer, label, letter = name.rsplit(".", 2) if name.count(".") > 1 else ("", "", name)
        key = LABELS.get(label.lower())
        if key is not None and layer != COMPOSITE:
            by_layer.setdefault(layer, {}).setdefault(key, {})[letter] = _window(values, camera)
    names = file_names(sorted(by_layer))
    return {
        key if len(by_layer) == 1 else f"{names[layer]}.{key}": _array(key, parts)
        for layer, passes in by_layer.items()
        for key, parts in passes.items()
    }


def _window(values: np.ndarray, camera: Mapping[str, Any]) -> np.ndarray:
    """Return the pixels of the window, of a file that has the whole frame or the window only; row 0 at the bottom."""
    x0, x1, y0, y1 = camera["window"]
    is_whole = values.shape == tuple(camera["raster"][::-1])
    return values[::-1][y0:y1, x0:x1] if is_whole else values[::-1]


def _array(key: str, parts: dict[str, np.ndarray]) -> np.ndarray:
    entry = PASSES[key]
    if not entry.channels:
        values = next(iter(parts.values()))
        if key == "depth":
            values = np.where(values < NOTHING, values, np.float32(np.inf))
        return values.astype(entry.dtype) if entry.dtype else values
    return np.stack([parts[letter] for letter in entry.letters], axis=-1)
