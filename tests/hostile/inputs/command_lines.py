"""Command lines of every script, each with a word that is wrong."""

from .parts import Hostile

COUNT = 150

WRONG = {
    "": (
        ("--frame", "nan"), ("--frame", "inf"), ("--frame", "1e300"), ("--frame", "half"), ("--frame", ""),
        ("--frame",), ("--camera",), ("--camera", ""), ("--camera", "\n"), ("--camera", "x" * 5000),
        ("--camera", "\udcff"), ("--unknown",), ("--frame", "1", "2", "3"), ("second.blend",), ("--json=1",), ("\n",),
        ("--frame", "1" * 5000),
    ),
    "cast": (
        ("--frames", "2:1"), ("--frames", ":"), ("--frames", "1"), ("--frames", "1:2:0"), ("--frames", "-9999999:1"),
        ("--frames", "a:b"), ("--frames", "1" * 5000 + ":2"), ("--frames", "1:" + "9" * 20), ("--passes", ""),
        ("--passes", "depth,,"), ("--passes", "\n"), ("--passes", "combined," * 999 + "z"), ("--shading", "toon"),
        ("--precision", "double"), ("--output", ""), ("--output", "/proc/x"), ("--output", "/dev/null"),
        ("--output", "/dev/null/x"), ("--output", "x" * 300), ("--output",),
        ("--output", "x/" * 3000),
    ),
    "benchmark": (("--rounds", "0"), ("--rounds", "-1"), ("--rounds", "nan"), ("--threads", "0"), ("--size", "0x0"),
                  ("--size", "1x"), ("--size", "ax b"), ("--size", "1" * 5000), ("--json",), ("--x",), ("word",)),
    "work_precision": (("--only", "nothing"), ("--only",), ("--output",), ("--x",), ("no such case \n",)),
    "side_by_side": (("no such case",), ("\n",), ("--x",), ("--details=1",)),
    "make_scenes": (("no such scene",), ("\n",), ("--x",), ("../x",)),
    "make_pictures": (("no such picture",), ("\n",), ("--x",), ("../x",)),
    "make_docs": (("--x",), ("word",), ("--check=1",), ("\n",)),
}  # fmt: skip
LINES = [(script, words) for script, lines in WRONG.items() for words in lines]


def make(chance, number, folder):
    """Return one of the lines, or two of a script together."""
    script, words = LINES[number % len(LINES)]
    if number >= len(LINES):
        words = (*words, *chance.choice(WRONG[script]))
    script, name = "" if script == "cast" else script, script
    return Hostile(f"{name or 'cast and verify'} {[word[:30] for word in words]}", words, script=script)
