"""Where there is room for text in a 3D View."""

from itertools import pairwise
from types import SimpleNamespace

import blf
import bpy
import pytest

from camera_ray_caster.blender.read.scene_cache import cached_scene
from camera_ray_caster.blender.view3d import mouse_gizmo, notice, text


@pytest.fixture
def interface():
    """A context with an interface of scale 1, which a Blender without a window does not have."""
    return SimpleNamespace(preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)))


def region(kind, x, width):
    return SimpleNamespace(type=kind, x=x, width=width)


@pytest.mark.parametrize(
    ("sidebar", "expected"),
    [((1000, 300), (40, 950)), ((1250, 1), (40, 1200)), ((1250, 300), (40, 1200)), ((50, 300), (300, 1200))],
    ids=["over the view", "closed", "beside the view", "on the left"],
)
def test_a_toolbar_and_a_sidebar_over_the_view_leave_less_of_it(sidebar, expected):
    view = region("WINDOW", 50, 1200)
    regions = [region("HEADER", 50, 1200), region("TOOLS", 50, 40), view, region("UI", *sidebar)]
    assert text.uncovered(SimpleNamespace(region=view, area=SimpleNamespace(regions=regions))) == expected
    regions[1] = region("TOOLS", 10, 40)  # beside the view
    assert text.uncovered(SimpleNamespace(region=view, area=SimpleNamespace(regions=regions)))[1] == expected[1]


SENTENCE = "Every pixel is shown at frame 5; in a render, each pixel has its own time, from frame 1.024 to 24.98"


def test_a_value_stays_beside_its_sign_and_a_vector_in_one_line(interface):
    sentence = "light 1, towards (0.497, -0.3, 1), cosine 0, distance = 6.684"
    words = ["light", "1,", "towards", "(0.497, -0.3, 1),", "cosine", "0,", "distance", "= 6.684"]
    assert text.wrapped(interface, sentence, 1) == words


@pytest.mark.parametrize("width", [40, 120, 300, 5000])
def test_a_sentence_is_wrapped_to_the_width_of_the_view(width, interface):
    lines = text.wrapped(interface, SENTENCE, width)
    assert " ".join(lines) == SENTENCE
    assert (len(lines) == 1) == (width == 5000)
    blf.size(0, text.SIZE)
    for line, after in pairwise([*lines, ""]):
        assert " " not in line or blf.dimensions(0, line)[0] <= width
        assert not after or blf.dimensions(0, f"{line} {after.split()[0]}")[0] > width


@pytest.mark.parametrize(("left", "right"), [(0, 120), (40, 1000)])
def test_the_notice_is_wrapped_and_stays_in_the_view(left, right, interface, monkeypatch):
    written = []
    monkeypatch.setattr(notice, "bpy", SimpleNamespace(context=interface))
    monkeypatch.setattr(notice, "_sentences", lambda context: iter([SENTENCE]))
    monkeypatch.setattr(text, "uncovered", lambda context: (left, right))
    monkeypatch.setattr(text, "write", lambda context, lines, corner_of: written.append((lines, corner_of)))
    notice.draw()
    ((lines, corner_of),) = written
    assert " ".join(line for _, line in lines) == SENTENCE
    blf.size(0, text.SIZE)
    width = max(blf.dimensions(0, line)[0] for _, line in lines)
    assert left + text.SIZE <= corner_of(width, 20)[0] <= right - width - text.SIZE  # the ground's margin


@pytest.mark.parametrize(("mouse", "side"), [(40, "right"), (700, "left"), (400, "edge")])
def test_the_text_at_the_mouse_is_of_the_ray_alone_and_in_the_view(mouse, side, camera_scene, interface, monkeypatch):
    camera_scene.camera.data.dof.use_dof = True
    camera_scene.camera.data.camera_ray_caster.time_mode = "ROWS"
    scene, written, width = cached_scene(bpy.context), [], 500
    assert len(scene.differences) == 2
    context = SimpleNamespace(**vars(interface), scene=camera_scene)
    monkeypatch.setattr(mouse_gizmo, "cached_scene", lambda context: scene)
    monkeypatch.setattr(mouse_gizmo, "picture_frame", lambda context: (0, 0, 800, 600))
    monkeypatch.setattr(text, "uncovered", lambda context: (40, 800))
    monkeypatch.setattr(text, "write", lambda context, lines, corner_of: written.append((lines, corner_of)))
    mouse_gizmo.RayUnderMouse.draw(SimpleNamespace(mouse=(mouse, 300)), context)
    ((lines, corner_of),) = written
    assert [name for name, _ in lines] == ["Pixel", "View", "Direction", "Hit"]
    left, margin = corner_of(width, 60)[0], mouse_gizmo.TEXT_DISTANCE
    assert left == {"right": mouse + 2 * margin, "left": mouse - 2 * margin - width, "edge": 40 + margin}[side]


@pytest.mark.parametrize("perspective", ["CAMERA", "PERSP"])
@pytest.mark.parametrize("shading", ["RENDERED", "SOLID"])
@pytest.mark.parametrize("local_view", [None, "a view"])
@pytest.mark.parametrize(("show", "show_overlays"), [(True, True), (True, False), (False, True)])
def test_the_notice_is_in_views_that_show_rays(perspective, shading, local_view, show, show_overlays, monkeypatch):
    context = SimpleNamespace(
        scene=SimpleNamespace(
            render=SimpleNamespace(engine="CAMERA_RAY_CASTER"), camera_ray_caster_overlay=SimpleNamespace(show=show)
        ),
        space_data=SimpleNamespace(
            shading=SimpleNamespace(type=shading),
            overlay=SimpleNamespace(show_overlays=show_overlays),
            local_view=local_view,
        ),
        region_data=SimpleNamespace(view_perspective=perspective), view_layer=None,
    )  # fmt: skip
    sentence = f"{SENTENCE}, in a view that is read on"
    monkeypatch.setattr(notice.other_times, "sentences", lambda scene, layer: iter([sentence]))
    monkeypatch.setattr(notice, "cached_scene", lambda context: SimpleNamespace(differences=(SENTENCE,), reason=""))
    sentences, overlaid = list(notice._sentences(context)), show and show_overlays
    is_cast = (shading, perspective) == ("RENDERED", "CAMERA")
    assert ((sentence in sentences), (SENTENCE in sentences)) == (is_cast, overlaid and not is_cast)
    assert (notice.LOCAL_VIEW in sentences) == (local_view is not None and (overlaid or shading == "RENDERED"))
