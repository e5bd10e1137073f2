"""When the pixels of Step Through are drawn."""

from types import SimpleNamespace
from unittest.mock import MagicMock

import pytest

from camera_ray_caster.blender.view3d import pixel_lessons


@pytest.mark.parametrize("function", ["draw", "draw_marks"])
@pytest.mark.parametrize(("pixels", "overlays"), [([(1, 2)], True), ([(1, 2)], False), ([], True)])
def test_rays_and_marks_are_drawn_for_pixels_where_overlays_are_shown(function, pixels, overlays, monkeypatch):
    asked = []
    space = SimpleNamespace(overlay=SimpleNamespace(show_overlays=overlays))
    preferences = SimpleNamespace(system=SimpleNamespace(ui_scale=1.0))
    scene = SimpleNamespace(camera=None)
    region = SimpleNamespace(as_pointer=lambda: 1)
    context = SimpleNamespace(space_data=space, region_data=None, region=region, scene=scene, preferences=preferences)
    monkeypatch.setattr(pixel_lessons, "bpy", SimpleNamespace(context=context))
    monkeypatch.setattr(pixel_lessons, "gpu", MagicMock())
    monkeypatch.setattr(pixel_lessons.clicked, "pixels", pixels)
    monkeypatch.setattr(pixel_lessons, "lessons", lambda context: asked.append(context) or {})
    getattr(pixel_lessons, function)()
    assert len(asked) == (overlays and len(pixels) > 0)
