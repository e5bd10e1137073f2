"""The words of a command line: a parser that refuses in one line, and what turns words into values."""

import argparse
import re
from collections.abc import Sequence

from ...core.camera.pixel_time import LAST_FRAME
from ...core.cast import MOST_SAMPLES
from ...core.casting.passes import PASSES
from ...core.records import InputError
from ..read.camera import ALL

LEAST_SIDE, LARGEST_SIDE = 4, 65536
"""Pixels of a picture's width and height in Blender."""


class Parser(argparse.ArgumentParser):
    """A parser that refuses in one line."""

    def error(self, message):
        """Raise InputError."""
        raise InputError(f"{message} (--help shows what can be given)")


def joined(arguments: Sequence[str], option: str) -> list[str]:
    """Return the arguments with an option and its value as one word: argparse would take -3:-1 for an option."""
    words = list(arguments)
    if option in words[:-1]:
        at = words.index(option)
        words[at : at + 2] = [f"{option}={words[at + 1]}"]
    return words


def frame_number(text: str) -> float:
    """Return a frame; argparse names this function where the text is none."""
    frame = float(text)
    if not abs(frame) <= LAST_FRAME:
        raise argparse.ArgumentTypeError(f"{text} is beyond Blender's last frame, {LAST_FRAME}")
    return frame


def frame_range(text: str) -> range:
    """Return the frames of "A:B" or "A:B:S", each S-th from A on."""
    first, last, step = (int(part) for part in (text if text.count(":") > 1 else f"{text}:1").split(":"))
    frame_number(str(first)), frame_number(str(last))
    if first > last:
        raise argparse.ArgumentTypeError(f"{text} holds no frame: give the first one first")
    if step < 1:
        raise argparse.ArgumentTypeError(f"{text} has the step {step}: it must be 1 or more")
    return range(first, last + 1, step)


def add_frames(parser) -> None:
    """Add --frames A:B[:S]."""
    parser.add_argument("--frames", type=frame_range, metavar="A:B[:S]", help="every whole frame from A to B, or each "
                        "S-th of them")  # fmt: skip


def add_cameras(parser) -> None:
    """Add --cameras NAME ...; see ``find_cameras``."""
    parser.add_argument("--cameras", nargs="+", metavar="NAME", help=f"several of the scene's cameras, or {ALL}")


def count(text: str) -> int:
    """Return how many of something; argparse names this function where the text is none."""
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError(f"{text} is none: give 1 or more")
    return number


def scheduler_address(text: str) -> str:
    """Return the address of a scheduler; argparse names this function where the text is none."""
    if not re.fullmatch(r"\w+://[^\s:]\S*:\d+", text):
        raise argparse.ArgumentTypeError(f"{text!r} is no address: give one such as tcp://HOST:PORT")
    return text


def share(text: str) -> tuple[int, int]:
    """Return K and N of "K/N"; argparse names this function where the text is none."""
    number, of = (int(part) for part in text.split("/"))
    if not 1 <= number <= of:
        raise argparse.ArgumentTypeError(f"{text} is no share: shares of {of} are 1/{of} to {of}/{of}")
    return number, of


def picture_size(text: str) -> tuple[int, int]:
    """Return width and height of "WxH"; argparse names this function where the text is none."""
    width, height = (int(part) for part in text.split("x"))
    if not all(LEAST_SIDE <= side <= LARGEST_SIDE for side in (width, height)):
        raise argparse.ArgumentTypeError(f"{text} has a side beyond Blender's {LEAST_SIDE} to {LARGEST_SIDE} pixels")
    return width, height


def sample_count(text: str) -> int:
    """Return samples a pixel; argparse names this function where the text is none."""
    samples = int(text)
    if not 1 <= samples <= MOST_SAMPLES:
        raise argparse.ArgumentTypeError(f"{text} is no number of samples from 1 to {MOST_SAMPLES}")
    return samples


def pass_names(text: str) -> list[str]:
    """Return the passes of "A,B,..."."""
    names = text.split(",")
    unknown = [name for name in names if name not in PASSES]
    if unknown:
        raise argparse.ArgumentTypeError(f"no pass is called {unknown[0]!r}: choose from {', '.join(PASSES)}")
    return names
