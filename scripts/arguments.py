"""Command line parsing for the measuring scripts: bad input gives a one-line error and exit status 2."""

import argparse
import re


class Parser(argparse.ArgumentParser):
    """A parser that reports errors in one line."""

    def error(self, message):
        """Print the error and exit; replace unprintable characters of the message."""
        message = "".join(sign if sign.isprintable() else "?" for sign in message)
        self.exit(2, f"{self.prog}: {message} (--help lists the options)\n")


def size(word: str) -> tuple[int, int]:
    """Return the width and the height given by a word such as 1920x1080."""
    match = re.fullmatch(r"([1-9]\d*)x([1-9]\d*)", word)
    if not match:
        raise argparse.ArgumentTypeError(f"{word!r} is not a size in pixels such as 1920x1080")
    width, height = int(match[1]), int(match[2])
    if not all(4 <= side <= 65536 for side in (width, height)):
        raise argparse.ArgumentTypeError(f"{word} has a side outside Blender's range of 4 to 65536 pixels")
    return width, height


def count(word: str) -> int:
    """Return the whole number, 1 or more, that a word stands for."""
    if not re.fullmatch(r"[1-9]\d*", word):
        raise argparse.ArgumentTypeError(f"{word!r} is not a whole number from 1 up")
    return int(word)
