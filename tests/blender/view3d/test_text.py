"""Where there is room for text in a 3D View."""

from types import SimpleNamespace

import pytest

from camera_ray_caster.blender.view3d import text


def region(kind, x, width):
    return SimpleNamespace(type=kind, x=x, width=width)


@pytest.mark.parametrize(
    ("sidebar", "expected"),
    [((1000, 300), 950), ((1250, 1), 1200), ((1250, 300), 1200), ((50, 300), 1200)],
    ids=["over the view", "closed", "beside the view", "on the left"],
)
def test_a_sidebar_over_the_view_leaves_less_of_it(sidebar, expected):
    view = region("WINDOW", 50, 1200)
    area = SimpleNamespace(regions=[region("HEADER", 50, 1200), view, region("UI", *sidebar)])
    assert text.visible_width(SimpleNamespace(region=view, area=area)) == expected
