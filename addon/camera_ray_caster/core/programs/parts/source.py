"""Where numbers and words of a file come from: what is wrong with one is told with the file's path."""

from collections.abc import Callable, Collection, Sequence
from math import hypot
from typing import Any

from ...arguments import shown
from ...cameras.parts.calibration import LARGEST
from ...records import InputError
from .lens import FRAME_SIZE, numbers_of

BEYOND = 4
"""Sides of a picture from its corner to its center, above which its size is none of a picture."""
FAR = 0.15
"""Part of a picture's shorter side by which its center is near to its middle, in nearly all calibrations."""


class FileSource:
    """A file by its path; ``check`` raises InputError when the time for it is over."""

    path: str
    check: Callable[[], None]

    def refusal(self, reason: str) -> InputError:
        """Return the error with this reason and the file's path."""
        return InputError(f"calibration file {self.path!r}: {reason}")

    def numbers(self, values, name: str, count: int | None = None) -> list[float]:
        """Return a list of finite numbers, ``count`` of them if given. Raises InputError, with ``name``, otherwise."""
        if values is None:
            raise self.refusal(f"it has no {name}")
        numbers = numbers_of(values)
        is_count = 0 < len(numbers) == (count or len(numbers))
        if not is_count or not all(abs(number) <= LARGEST for number in numbers):
            wanted = f"{count or 'a list of'} finite number{'' if count == 1 else 's'}, up to {LARGEST:g}"
            raise self.refusal(f"{name} is {shown(values)}: it must be {wanted}")
        return numbers

    def one_of(self, value, name: str, known: Collection[str]) -> str:
        """Return a word that is one of ``known``. Raises InputError, with ``name``, otherwise."""
        if value is None:
            raise self.refusal(f"it has no {name}: it must be one of {', '.join(known)}")
        if not isinstance(value, str) or value not in known:
            raise self.refusal(f"{name} is {shown(value)}: it must be one of {', '.join(known)}")
        return value

    def size(self, width: float | None, height: float | None) -> dict[str, Any]:
        """Return the settings of a calibrated picture's size; without one, that of the frame.

        Raises InputError unless both sides are whole pixels.
        """
        if width is None and height is None:
            return dict(FRAME_SIZE)
        if width is None or height is None:
            raise self.refusal(f"it has {'a height and no width' if width is None else 'a width and no height'}")
        if min(width, height) < 1 or width % 1 or height % 1:
            raise self.refusal(f"its image size is {width:g} x {height:g}: it must be of whole numbers above 0")
        return {"calibration_width": width, "calibration_height": height}

    def check_sides(self, size: Sequence[float | None], center: Sequence[float]) -> None:
        """Raise InputError if a list of two sides seems to be rows and columns: the center is far from the middle, and
        near to that of the sides in the other order; or if it seems to be of a chessboard: the center is far beyond.
        """
        (width, height), (cx, cy) = size, center
        if width is None or height is None:
            return
        if cx > BEYOND * width or cy > BEYOND * height:
            raise self.refusal(
                f"its image size is {width:g} x {height:g}, but its center {cx:g}, {cy:g}: is the size that of a board?"
            )
        if width == height:
            return
        apart = hypot(cx - width / 2, cy - height / 2)
        if apart > FAR * min(width, height) and 2 * hypot(cx - height / 2, cy - width / 2) < apart:
            raise self.refusal(
                f"its image size is {width:g} x {height:g}, but its center, {cx:g}, {cy:g}, is near the middle of "
                f"{height:g} x {width:g}: swap the two numbers, or name them image_width and image_height"
            )
