"""Make a data set of cameras and frames of a .blend, in one process or on many machines: ``cast.py --dataset``.

    python scripts/dataset.py FILE.blend --cameras ALL --frames 1:100                        in this process
    python scripts/dataset.py FILE.blend --cameras ALL --frames 1:100 --workers 4            in four
    python scripts/dataset.py FILE.blend --cameras ALL --frames 1:100 --scheduler tcp://...  on a cluster of Dask

``python scripts/dataset.py --help`` lists all options.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))  # Blender does not add it

import ends

if __name__ == "__main__":
    ends.begin(__file__)
    from door import through

    sys.exit(ends.run(__file__, lambda: through("dataset")))
