"""Every test in this folder starts from an empty file with the extension registered."""

import pytest


@pytest.fixture(autouse=True)
def empty_file(blender):
    """See ``blender``, which does the work and takes it back."""
    return blender
