"""Command lines of every script, each with a word that is wrong."""

from .parts import Hostile

COUNT = 260

WITH = {"dataset": ("--frames", "1:1"), "export": ("--format", "json")}
"""Commands that are given a file, other than cast and verify, and the words that they need."""

MANY = (
    ("--cameras",), ("--cameras", ""), ("--cameras", "nobody"), ("--cameras", "\n"),
    ("--cameras", "\udcff"), ("--frames", "2:1"), ("--frames", "1:2:0"), ("--frames", "1:" + "9" * 20),
    ("--frames", "nan"), ("--frames", "0.5:2"), ("--output", "/proc/x"), ("--output", "/dev/null/x"),
    ("--output", "x" * 300), ("--output",), ("--unknown",), ("second.blend",), ("\n",),
)  # fmt: skip
"""What commands of many cameras and frames refuse."""

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
        ("--output", ""), ("--output", "/proc/x"), ("--output", "/dev/null"),
        ("--output", "/dev/null/x"), ("--output", "x" * 300), ("--output",),
        ("--output", "x/" * 3000),
    ),
    "dataset": (
        *MANY, ("--workers", "0"), ("--workers", "-1"), ("--workers", "nan"), ("--workers", "1" * 5000), ("--workers",),
        ("--scheduler", ""), ("--scheduler", "nowhere"), ("--scheduler", "tcp://"),
        ("--scheduler", "tcp://127.0.0.1:x"), ("--scheduler", "tcp://127.0.0.1:1", "--workers", "2"),
        ("--shard", "2/1"), ("--frame", "1"), ("--camera", "Camera", "--cameras", "ALL"),
        ("--resolution", "0x0"), ("--resolution", "-1x1"), ("--resolution", "1x"), ("--resolution", "9" * 20 + "x1"),
        ("--samples", "4"), ("--engine", "CYCLES", "--samples", "0"), ("--engine", "toon"), ("--format", "tiff"),
        ("--half=1",), ("--annotations=1",), ("--keypoints",), ("--keypoints", ""), ("--keypoints", "nobody"),
        ("--keypoints", "\n"), ("--keypoints", "\udcff"), ("--keypoints", "ALL", "nobody"), ("--keypoints", "Plane"),
        ("--passes", "flow"), ("--passes", "flow_forward,"), ("--passes", ""), ("--calibration", "none.yml"),
        ("--calibration", "/dev/null"), ("--calibration", "."),
    ),
    "export": (
        *MANY, ("--format", "png"), ("--format", ""), ("--format",), ("--format", "\n"), ("--to", "nobody"), ("--to",),
        ("--format", "stmap", "--to", "nobody"), ("--format", "stmap", "--to", "Sphere"),
        ("--format", "stmap", "--to", ""), ("--passes", "depth"), ("--calibration", "/dev/null"), ("--frame", "half"),
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
    what = f"{script or 'cast and verify'} {[word[:30] for word in words]}"
    if script in WITH:
        return Hostile(what, (*WITH[script], *words), command=script)
    return Hostile(what, words, script="" if script == "cast" else script)
