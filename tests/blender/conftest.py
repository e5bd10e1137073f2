"""Every test in this folder starts from an empty file with the extension registered."""

import pytest


@pytest.fixture(autouse=True)
def empty_file(blender):
    """See ``blender``, which does the work and takes it back."""
    return blender


@pytest.fixture
def slow(monkeypatch):
    """A picture counts as one that takes long, and so is cast in many tiles."""
    from camera_ray_caster.core import tuning

    monkeypatch.setattr(tuning, "TILE_WORK", 1 << 16)
