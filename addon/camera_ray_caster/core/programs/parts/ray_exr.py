"""Tables of rays as OpenEXR images: directions as red, green and blue, or channels of origins and directions by name.

Names are as the passes of renders have them: the last part is X, Y, Z or R, G, B, and what stands before it has the
word direction or origin. The rays are in the camera's frame; a direction of NaN or 0 is no ray. Numbers have to be
float32: half floats turn rays by up to 2.4e-4 radians.
"""

from collections.abc import Mapping

import numpy as np

from ...openexr.reading import MAGIC, channels_of, is_part
from .document import Document
from .lens import Lens
from .ray_arrays import table

AXES = "xyz", "rgb"

OFF_MIDDLE = 0.3
"""How far the middle of an STMap may be from the picture's, as a part of its sides."""


def looks(document: Document) -> bool:
    """Whether it is an EXR image."""
    return document.data.startswith(MAGIC)


def lens_of(document: Document) -> Lens:
    """Return the lens of an image. Raises InputError."""
    channels = channels_of(document.data, document.path)
    if any(values.dtype == np.float16 for values in channels.values()):
        reason = "its numbers are half floats, which turn rays by up to 2.4e-4 radians: save it as float32"
        raise document.refusal(reason)
    if is_part(document.data):
        raise document.refusal("its data window is not its display window: save the whole picture")
    vectors = _vectors(channels)
    directions = [name for name in vectors if "direction" in name]
    if len(vectors) == 1:
        directions = list(vectors)
        if not directions[0] and _is_stmap(vectors[""]):
            raise document.refusal("it is an STMap, with places in a picture and no directions: load the calibration "
                                   "of the lens, or a table of rays")  # fmt: skip
    origins = [name for name in vectors if "origin" in name]
    if len(directions) != 1 or len(origins) > 1:
        raise document.refusal(
            f"its channels are {', '.join(channels)}: it must have one direction, such as direction.X, direction.Y, "
            "direction.Z, and one origin or none"
        )
    ahead = vectors[directions[0]]
    ahead[(ahead == 0).all(axis=2)] = np.nan
    return table(document, ahead, vectors[origins[0]] if origins else None, np.array((0.0, 0.0, 1.0, 1.0)))


def _is_stmap(values: np.ndarray) -> bool:
    """Whether vectors (rows, columns, 3) are places in a picture: blue is one number, and red and green are parts of
    its sides, whose middle is at 0.5. The middle of directions in a camera's frame is near 0.
    """
    places = values[np.isfinite(values).all(axis=2) & values.any(axis=2)]
    if not len(places) or np.ptp(places[:, 2]):
        return False
    return bool((np.abs(np.median(places[:, :2], axis=0) - 0.5) < OFF_MIDDLE).all())


def _vectors(channels: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return the vectors (rows, columns, 3), from the bottom, of which channels are the components, by lower-case name.
    """
    parts: dict[str, dict[str, np.ndarray]] = {}
    for name, values in channels.items():
        before, _, last = name.lower().rpartition(".")
        parts.setdefault(before, {})[last] = values
    return {
        name: np.stack([components[axis] for axis in axes], axis=2).astype(np.float64)[::-1].copy()
        for name, components in parts.items()
        for axes in AXES
        if set(axes) <= set(components)
    }
