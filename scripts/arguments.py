"""What the scripts for measuring are told in words: bad input is refused in one line, with exit status 2."""

import argparse
import re


class Parser(argparse.ArgumentParser):
    """A parser that refuses in one line."""

    def error(self, message):
        """Say what is wrong and end; of the words that were given it shows no control characters."""
        message = "".join(sign if sign.isprintable() else "?" for sign in message)
        self.exit(2, f"{self.prog}: {message} (--help shows what can be given)\n")


def size(word: str) -> tuple[int, int]:
    """Return the width and the height of a word such as 1920x1080."""
    found = re.fullmatch(r"([1-9]\d*)x([1-9]\d*)", word)
    if not found:
        raise argparse.ArgumentTypeError(f"{word!r} is no size in pixels such as 1920x1080")
    return int(found[1]), int(found[2])


def count(word: str) -> int:
    """Return a number of things from a word: 1 or more."""
    if not re.fullmatch(r"[1-9]\d*", word):
        raise argparse.ArgumentTypeError(f"{word!r} is not a whole number from 1 up")
    return int(word)
