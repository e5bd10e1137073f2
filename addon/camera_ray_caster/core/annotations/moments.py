"""Pictures whose pixels have their own times: what annotations, which are of one moment, can say of them."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from ..motion.evaluations import Motion
from ..records import InputError, Shapes


def check_rows(shapes: Shapes) -> None:
    """Raise InputError if a shape index means another shape at the time of another pixel."""
    for frame, other in _others(shapes):
        if shapes.names != other.names or not np.array_equal(shapes.name_index, other.name_index):
            known, here = ({one.names[k] for k in one.name_index.tolist()} for one in (shapes, other))
            names = ", ".join(map(repr, sorted(known ^ here))) or "instances"
            raise InputError(
                f"annotations need the same objects at the times of all pixels, and frame {frame:g} differs in "
                f"{names}: show it at all of these times, or at none"
            )


def check_still(shapes: Shapes, owners: Collection[str]) -> None:
    """Raise InputError if one of the objects with these names moves between the times of pixels."""
    for frame, other in _others(shapes):
        moved = (shapes.center != other.center).any(axis=1) | (shapes.axes != other.axes).any(axis=(1, 2))
        for k in shapes.name_index[moved].tolist():
            if shapes.names[k] in owners:
                raise InputError(
                    f"key points of {shapes.names[k]!r} are places at one time, and at frame {frame:g}, the time of "
                    "other pixels, it is elsewhere: leave out --keypoints, or set the camera's pixel time to None"
                )


def _others(shapes: Shapes) -> list[tuple[float, Shapes]]:
    """Return the frames and shapes of all evaluations, none for a picture of one time."""
    motion = shapes.timeline.motion
    return [(frame, other) for frame, (_, other) in sorted(motion.states.items())] if isinstance(motion, Motion) else []
