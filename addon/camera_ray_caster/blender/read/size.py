"""The size of a camera's own pictures: a custom property of the camera object, in place of the scene's resolution."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from ...core.records import InputError
from .changes import changed

SIZE = "resolution"
"""Name of the custom property: width and height in pixels."""


def own_size(camera_object) -> tuple[int, int] | None:
    """Return width and height of a camera's own pictures; None if it has those of the scene.

    Raises InputError for a property that is no size.
    """
    stored = camera_object.get(SIZE)
    if stored is None:
        return None
    sides = stored.to_list() if hasattr(stored, "to_list") else []
    if len(sides) != 2 or not all(isinstance(side, int) and side >= 4 for side in sides):
        raise InputError(f"{SIZE} of {camera_object.name!r} must be two whole numbers, width and height, 4 or more")
    return sides[0], sides[1]


def size_of(scene) -> tuple[int, int]:
    """Return width and height of a scene's pictures."""
    render = scene.render
    return tuple(side * render.resolution_percentage // 100 for side in (render.resolution_x, render.resolution_y))


@contextmanager
def sized(scene, size: tuple[int, int] | None) -> Iterator[None]:
    """Give a scene's pictures a size inside the context; without one they keep the scene's own."""
    with ExitStack() as stack:
        if size is not None:
            changed(stack, scene.render, **settings_of(size))
        yield


def set_size(scene, size: tuple[int, int]) -> None:
    """Give a scene's pictures a size."""
    for name, value in settings_of(size).items():
        setattr(scene.render, name, value)


def settings_of(size: tuple[int, int]) -> dict[str, int]:
    """Return the render settings of pictures of a size."""
    return {"resolution_x": size[0], "resolution_y": size[1], "resolution_percentage": 100}
