"""What the scripts are told in words: bad input is refused in one line, with exit status 2."""

import argparse

from tests.core.extreme_cases import CASES


class Parser(argparse.ArgumentParser):
    """A parser that refuses in one line."""

    def error(self, message):
        """Say what is wrong and end."""
        self.exit(2, f"{self.prog}: {message} (--help shows what can be given)\n")


def cases_named(parser, words):
    """Return the extreme cases that have one of the words in their names, all without a word; refuse an idle word."""
    for word in words:
        if not any(word in case.name for case in CASES):
            parser.error(f"no extreme case has {word!r} in its name: tests/core/extreme_cases.py lists them")
    return [case for case in CASES if not words or any(word in case.name for word in words)]
