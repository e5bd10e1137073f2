"""Parsing of the command line: a parser with one-line errors, and functions that convert arguments to values."""

import argparse
import re
from collections.abc import Callable, Sequence
from functools import wraps
from math import isnan, pi, radians
from typing import TypeVar

from ...core.arguments import unknown
from ...core.camera.pixel_time import LAST_FRAME
from ...core.cast import MOST_SAMPLES
from ...core.casting.passes import PASSES
from ...core.records import InputError
from ..read.camera_fields import ALL

LEAST_SIDE, LARGEST_SIDE = 4, 65536
"""Blender's limits of a picture's width and height, in pixels."""


MAY_BE_NEGATIVE = "--frame", "--frames", "--pixel"
"""Options whose values may begin with a minus, such as -3:-1, which argparse would take for an option."""


class Parser(argparse.ArgumentParser):
    """A parser that reports errors in one line."""

    def parse_args(self, args: Sequence[str]) -> argparse.Namespace:
        """Return the options of a command line; a value of MAY_BE_NEGATIVE belongs to the option before it."""
        words: list[str] = []
        for word in args:
            if words and words[-1] in MAY_BE_NEGATIVE:
                words[-1] += f"={word}"
            else:
                words.append(word)
        options = super().parse_args(words)
        stamped = (action.dest for action in self._actions if getattr(action, "stamped", True))
        options.stamped = [name for name in stamped if hasattr(options, name)]  # --help has no value
        return options

    def print_help(self, file=None):
        """Write the help. argparse ignores errors of writing, which tell of a full disk or a closed pipe."""
        print(self.format_help(), end="", file=file)

    def error(self, message):
        """Raise InputError."""
        raise InputError(f"{message} (--help lists the options)")


def unstamped(option: argparse.Action) -> None:
    """Declare an option that says which pictures are made, where and by whom, or a file whose content the stamp holds:
    pictures that were made with another value of it stay valid. All other options are settings of the pictures.
    """
    option.stamped = False  # type: ignore[attr-defined]


T = TypeVar("T")


def of_form(form: str) -> Callable[[Callable[[str], T]], Callable[[str], T]]:
    """Return a decorator for a function that converts an argument: a ValueError becomes the message that an argument of
    this form is wanted.
    """

    def decorator(convert: Callable[[str], T]) -> Callable[[str], T]:
        @wraps(convert)
        def converted(text: str) -> T:
            try:
                return convert(text)
            except ValueError as error:
                raise argparse.ArgumentTypeError(f"{text!r} is not {form}") from error

        return converted

    return decorator


@of_form("a frame number")
def frame_number(text: str) -> float:
    """Return a frame number."""
    frame = float(text)
    if isnan(frame):
        raise ValueError(text)
    if abs(frame) > LAST_FRAME:
        raise argparse.ArgumentTypeError(f"{text} is beyond Blender's last frame, {LAST_FRAME}")
    return frame


@of_form("a range of frames: give A:B, or A:B:S for every S-th frame, in whole numbers")
def frame_range(text: str) -> range:
    """Return the frames of "A:B" or "A:B:S": every S-th frame from A to B."""
    first, last, step = (int(number) for number in (text if text.count(":") > 1 else f"{text}:1").split(":"))
    frame_number(str(first)), frame_number(str(last))
    if first > last:
        raise argparse.ArgumentTypeError(f"{text} has no frames: give the first frame before the last")
    if step < 1:
        raise argparse.ArgumentTypeError(f"{text} has the step {step}: it must be 1 or more")
    return range(first, last + 1, step)


def add_frames(parser) -> None:
    """Add --frames A:B[:S]."""
    unstamped(parser.add_argument("--frames", type=frame_range, metavar="A:B[:S]", help=
        "frames A to B, in steps of S (default: 1)"))  # fmt: skip


def add_progress(parser) -> None:
    """Add --progress."""
    unstamped(parser.add_argument("--progress", action="store_true", help=
        "print a line on standard error after each picture, frame and file; default: every 30 s"))  # fmt: skip


def add_cameras(parser) -> None:
    """Add --cameras NAME ...; see ``find_cameras``. --poses and --rig set ``own_frames``; see ``shown_at``."""
    unstamped(parser.add_argument("--cameras", nargs="+", metavar="NAME", help=
        f"names of several of the scene's cameras, or {ALL}"))  # fmt: skip
    unstamped(parser.add_argument("--rig", nargs="+", metavar="FILE", help=
        "files with cameras and their poses, or a trajectory: adds these cameras to the scene, below an empty, and "
        "uses them unless --cameras names others"))  # fmt: skip
    parser.add_argument(
        "--rig-parent", metavar="NAME", help="object below which the cameras of --rig are put; default: none"
    )
    unstamped(parser.add_argument("--poses", dest="own_frames", action="store_true", help=
        "use the frames of the poses that were read from files: each camera at its own, one without poses at all of "
        "them"))  # fmt: skip


def check_cameras(options: argparse.Namespace) -> None:
    """Raise InputError for options of cameras that exclude each other."""
    if options.rig and (options.camera or options.calibration):
        raise InputError("--rig reads cameras and lenses from its file: leave out --camera and --calibration")
    if options.rig_parent and not options.rig:
        raise InputError("--rig-parent applies to --rig only: add --rig FILE")
    if options.cameras and options.camera:
        raise InputError("--camera and --cameras exclude each other: leave out --camera")
    if options.cameras and options.calibration:
        raise InputError("--calibration applies to one camera: name the camera with --camera instead of --cameras")


@of_form("an angle")
def degrees(text: str) -> float:
    """Return an angle in radians, given in degrees above 0, up to 180."""
    angle = radians(float(text))
    if not 0 < angle <= pi:
        raise argparse.ArgumentTypeError(f"{text} is not an angle above 0, up to 180 degrees")
    return angle


@of_form("a whole number")
def count(text: str) -> int:
    """Return a number of things, 1 or more."""
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} is not a positive whole number: give 1 or more")
    return number


def scheduler_address(text: str) -> str:
    """Return the address of a scheduler."""
    if not re.fullmatch(r"\w+://[^\s:]\S*:\d+", text):
        raise argparse.ArgumentTypeError(f"{text!r} is not an address: give an address such as tcp://HOST:PORT")
    return text


@of_form("a share: give K/N, such as 1/4")
def share(text: str) -> tuple[int, int]:
    """Return K and N of "K/N"."""
    number, of = (int(number) for number in text.split("/"))
    if of < 1:
        raise ValueError(text)
    if not 1 <= number <= of:
        raise argparse.ArgumentTypeError(f"{text} is not a share: shares of {of} are 1/{of} to {of}/{of}")
    return number, of


@of_form("a size: give WxH, such as 640x480")
def picture_size(text: str) -> tuple[int, int]:
    """Return width and height of "WxH"."""
    width, height = (int(side) for side in text.split("x"))
    if not all(LEAST_SIDE <= side <= LARGEST_SIDE for side in (width, height)):
        raise argparse.ArgumentTypeError(
            f"{text} has a side outside Blender's range of {LEAST_SIDE} to {LARGEST_SIDE} pixels"
        )
    return width, height


@of_form("a whole number")
def sample_count(text: str) -> int:
    """Return the samples per pixel."""
    samples = int(text)
    if not 1 <= samples <= MOST_SAMPLES:
        raise argparse.ArgumentTypeError(f"{text} is not a number of samples: give 1 to {MOST_SAMPLES}")
    return samples


def pass_names(text: str) -> list[str]:
    """Return the pass names of "A,B,..."."""
    names = [name.strip() for name in text.split(",")]
    for name in names:
        if name not in PASSES:
            raise argparse.ArgumentTypeError(str(unknown("pass", name, PASSES)))
    return names
