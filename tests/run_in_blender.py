"""Runs pytest inside Blender, with Blender's own Python and numpy.

    blender --background --factory-startup --python tests/run_in_blender.py -- SITE_PACKAGES [pytest arguments]
"""

import sys

if __name__ == "__main__":
    site_packages, *arguments = sys.argv[sys.argv.index("--") + 1 :]
    sys.path.append(site_packages)  # last: nothing in it may stand before what Blender brings
    import pytest

    sys.exit(pytest.main(arguments))
