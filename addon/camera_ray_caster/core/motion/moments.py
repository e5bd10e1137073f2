"""Pictures whose pixels have their own times: what annotations and points, whose numbers of shapes are of one moment,
can say of them.
"""

from collections.abc import Collection

from ..records import InputError, Shapes
from .evaluations import Motion
from .matching import same_rows


def check_rows(shapes: Shapes) -> None:
    """Raise InputError if a shape index means another shape at the time of another pixel."""
    for frame, other in _others(shapes):
        if not same_rows(shapes, other):
            known, here = ({then.names[k] for k in then.name_index.tolist()} for then in (shapes, other))
            names = ", ".join(map(repr, sorted(known ^ here))) or "instances"
            raise InputError(
                "shapes are numbered only if they are the same at the times of all pixels, and frame "
                f"{frame:g} differs in {names}: show it at all of these times, or at none"
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
    motion = shapes.motion
    return [(frame, other) for frame, (_, other) in sorted(motion.states.items())] if isinstance(motion, Motion) else []
