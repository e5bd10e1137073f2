"""Passes as NPZ files of NumPy: one array per pass, with the rows from the bottom or from the top.

The arrays hold the pixels that were cast, which are those of the render border. Images and EXR files have the whole
frame, unless it is cropped to the border.
"""

import zipfile
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from ...core.casting.passes import PASSES
from ...core.casting.top_down import top_down
from ...core.conventions import BOTTOM, TOP
from ...core.names import file_names
from ...core.records import InputError
from ..process.signals import raise_if_stopping

LEVEL = 1
"""Level of deflate compression. All passes of a picture of meshes take 0.52 s of processor time and 11.5 MB; at
numpy's level, 6, they take 1.1 s and 11.2 MB. A cast takes 0.25 s.
"""

HALF = np.finfo(np.float16)


def save(
    path: Path,
    images: Mapping[tuple[str, str], Mapping[str, np.ndarray]],
    suffixes: Mapping[str, str],
    half: bool,
    rows: str = BOTTOM,
) -> None:
    """Write the images of each layer and view: one file per view, with the view's suffix.

    Arrays are named after their passes, with the layer's name in front if there are several layers: "Layer.depth"; see
    ``entry_names``.
    ``half`` stores real numbers as float16, ``rows`` TOP the passes of ``top_down``. Raises InputError for numbers that
    are too large for float16.
    """
    layers = entry_names({layer for layer, _ in images})
    for view in dict.fromkeys(view for _, view in images):
        of_view = path.with_stem(path.stem + suffixes.get(view, ""))
        with zipfile.ZipFile(of_view, "w", zipfile.ZIP_DEFLATED, compresslevel=LEVEL) as file:
            for layer in sorted(layers):
                for key, image in images[layer, view].items():
                    raise_if_stopping()
                    stored = _halved(key, images[layer, view]) if half and image.dtype.kind == "f" else image
                    stored = top_down({key: stored})[key] if rows == TOP else stored
                    name = f"{layers[layer]}.{key}" if len(layers) > 1 else key
                    with file.open(f"{name}.npy", "w", force_zip64=True) as entry:
                        np.lib.format.write_array(entry, stored, allow_pickle=False)


def entry_names(layers: Iterable[str]) -> dict[str, str]:
    """Return the name of each layer in a file: a plain one, since the entries may be unpacked as files. Raises
    InputError if two would be equal.
    """
    return file_names(sorted(layers))


def _halved(key: str, images: Mapping[str, np.ndarray]) -> np.ndarray:
    """Return a pass as float16; a bound includes the rounding of the passes that are stored with it, and is rounded up.
    """
    image, bounded = images[key], PASSES[key].bounds
    if bounded:
        image = image.astype(np.float64)
        for other in (images[name] for name in bounded if name in images):
            image = np.maximum(image, images[key] + _rounding(other))
    with np.errstate(over="ignore"):  # refused, or an infinite bound
        stored = image.astype(np.float16)
    if bounded:
        return np.where(stored < image, np.nextafter(stored, np.float16(np.inf)), stored)
    if np.isinf(stored[np.isfinite(image)]).any():
        raise InputError(f"{key} has numbers above {HALF.max:g}, the largest of 16 bits: write it without --half")
    return stored


def _rounding(image: np.ndarray) -> np.ndarray:
    """Return how far float16 moves the numbers of each pixel: as a vector's length; 0 where they are infinite."""
    with np.errstate(over="ignore", invalid="ignore"):
        moved = np.nan_to_num(image.astype(np.float16) - image.astype(np.float64), posinf=0, neginf=0)
    return np.abs(moved) if image.ndim == 2 else np.sqrt((moved * moved).sum(axis=-1))
