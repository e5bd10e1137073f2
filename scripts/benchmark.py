"""Time this caster against Blender, Cycles and the compiled ray tracers that are installed, in one run.

    python scripts/benchmark.py                 1920 x 1080: 10, 1,000, 10,000 and 100,000 spheres
    python scripts/benchmark.py --quick         the first two, fewer rounds
    python scripts/benchmark.py --meshes        triangle meshes, also against Open3D
    python scripts/benchmark.py --models        rays and pictures of every camera model
    python scripts/benchmark.py --redraws       every camera model in scenes of triangles, by processor time
    python scripts/benchmark.py --rays          rays given as arrays, beside filling these, and beside Open3D
    python scripts/benchmark.py --passes        each pass beside writing its array alone
    python scripts/benchmark.py --casts         whole casts beside writing their arrays; one thread and two
    python scripts/benchmark.py --renders --size 3840x2160    F12 beside the cast alone, and beside Blender's own share
    python scripts/benchmark.py --dataset       a data set of meshes: cost against writing alone, and two processes
    python scripts/benchmark.py --sets          sets of 100, 400 and 1,600 small pictures: processor time, memory, bytes
    python scripts/benchmark.py --against v0.1.0    this checkout against a commit: casts and the rays of each model
    python scripts/benchmark.py --against v0.1.0 --same    whether the pictures of the example scenes are the same
    python scripts/benchmark.py --scaling --picture FILE.png    cost against pixels, shapes and triangles

In each round all contenders run in turn, so that other load on the machine affects all of them. A pause before each run
lets the threads of the previous contender come to rest. Times are in milliseconds: minimum, median, and spread (the
middle half of the rounds). Ratios are ratios of medians.
"""

if __name__ == "__main__":
    import ends  # in this folder

    ends.begin(__file__)

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))

from measure.benchmark import main

if __name__ == "__main__":
    sys.exit(ends.run(__file__, lambda: main(__doc__.splitlines()[0])))
