"""Selection of extreme cases by words on the command line."""

from tests.core.errors.extreme_cases import CASES


def cases_named(parser, words):
    """Return the extreme cases whose names contain one of the words; all cases if there are no words.

    A word that no name contains is a parser error.
    """
    for word in words:
        if not any(word in case.name for case in CASES):
            parser.error(f"no extreme case has {word!r} in its name: tests/core/errors/extreme_cases.py lists them")
    return [case for case in CASES if not words or any(word in case.name for word in words)]
