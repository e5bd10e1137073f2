"""Compare cameras read from calibration files with the files' own programs: see measure/calibration_readers.py.

    python scripts/calibration_readers.py
"""

import sys

import ends  # in this folder

if __name__ == "__main__":
    ends.begin(__file__)
    from measure.calibration_readers import main

    sys.exit(ends.run(__file__, main))
