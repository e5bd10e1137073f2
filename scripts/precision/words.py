"""The extreme cases that a script is told to take, in words."""

from tests.core.errors.extreme_cases import CASES


def cases_named(parser, words):
    """Return the extreme cases that have one of the words in their names, all without a word; refuse an idle word."""
    for word in words:
        if not any(word in case.name for case in CASES):
            parser.error(f"no extreme case has {word!r} in its name: tests/core/errors/extreme_cases.py lists them")
    return [case for case in CASES if not words or any(word in case.name for word in words)]
