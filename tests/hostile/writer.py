"""A process that writes sets of files into a folder, COUNT or until it is stopped: NAME FOLDER COUNT. No Blender."""

import sys
from itertools import count
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))

import ends

FILES = {f"{number:02}.exr": 3000 for number in range(24)}
"""The files of a set, and their bytes: each says of all of them which set it is of. So many that moving them to their
places takes as long as writing them, and is hit as often.
"""


def content(name, number, size):
    """A file of a set."""
    line = f"{name} {number}\n"
    return (line * (size // len(line) + 1))[:size]


def write(folder, name, number):
    """Write one set."""
    from camera_ray_caster.blender.process import signals
    from camera_ray_caster.core.file_set import atomic_folder

    with atomic_folder(folder) as new:
        for file, size in FILES.items():
            (new / file).write_text(content(name, number, size))
            signals.raise_if_stopping()


def main():
    """Write until stopped, as a command of the terminal does: a signal is remembered, and the work asks."""
    name, folder, most = sys.argv[1:]
    sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "addon"))
    from camera_ray_caster.blender.process import signals
    from camera_ray_caster.core.records import Cancelled

    ends.listen(signals.stop)
    print("ready", flush=True)
    for number in count() if int(most) < 0 else range(int(most)):
        try:
            write(Path(folder), name, number)
        except Cancelled:
            return 130
    return 0


if __name__ == "__main__":
    ends.begin(__file__)
    sys.exit(ends.run(__file__, main))
