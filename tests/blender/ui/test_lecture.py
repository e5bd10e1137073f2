"""Lecture mode of Step Through: its steps, its keys' operator, the size of its text, and views of its ray."""

from types import SimpleNamespace

import numpy as np
import pytest

from camera_ray_caster.blender.ui import lecture_operators
from camera_ray_caster.blender.view3d import lecture, pixel_lessons


@pytest.fixture
def lecture_state(blender):
    lecture_state = blender.context.window_manager.camera_ray_caster_place
    yield lecture_state
    lecture_state.lecture, lecture_state.step, lecture_state.all_digits = False, 0, False
    pixel_lessons.forget()


def test_a_lecture_writes_one_step_large_and_keys_stay_within_the_steps(blender, scene, lecture_state, monkeypatch):
    written = []
    step = blender.ops.camera_ray_caster.lecture_step
    pixel_lessons.clicked.choose([(12, 8)])
    assert not step.poll()
    lecture_state.lecture = True
    (explained,) = pixel_lessons.lessons(blender.context).values()
    seen = [step(by=by) and lecture_state.step for by in (-1, 1, 1, 100, -1)]
    assert seen == [0, 1, 2, len(explained.screens) - 1, len(explained.screens) - 2]
    blender.ops.camera_ray_caster.choose_type(key="PERSP")
    assert lecture_state.step == 0, "another model begins with its formula"
    note = lambda view, lines, left, size, corner: written.append((lines, size))  # noqa: E731
    monkeypatch.setattr(lecture.text, "write", note)
    monkeypatch.setattr(lecture.text, "wrapped", lambda context, line, width, size: [line])
    monkeypatch.setattr(lecture.text, "uncovered", lambda context: (0, 900))
    monkeypatch.setattr(lecture.text, "below_headers", lambda context: context.region.height)
    preferences = SimpleNamespace(system=SimpleNamespace(ui_scale=2.0),
                                  ui_styles=[SimpleNamespace(widget=SimpleNamespace(points=11))])  # fmt: skip
    for height in (2000, 300):
        view = SimpleNamespace(preferences=preferences, region=SimpleNamespace(height=height))
        lecture.write_step(view, explained, 0)
    (large, size), (small, least) = written
    assert size == 2.4 * 22
    assert large[0] == ("", f"Perspective (1/{len(explained.screens)})")
    assert least < size
    assert 1.5 * least * len(small) <= 300


def test_a_lecture_without_a_pixel_begins_in_the_middle_with_four_digits_until_more_are_asked_for(
    blender, scene, lecture_state
):
    lecture_state.lecture = True
    width, height = scene.render.resolution_x, scene.render.resolution_y
    assert pixel_lessons.clicked.pixels == [(width // 2, height // 2)]
    (few,) = pixel_lessons.lessons(blender.context).values()
    lecture_state.all_digits = True
    (all_digits,) = pixel_lessons.lessons(blender.context).values()
    lecture_state.lecture = False
    (usual,) = pixel_lessons.lessons(blender.context).values()
    assert len(str(few)) < len(str(all_digits))
    assert str(all_digits) == str(usual)


@pytest.mark.parametrize("side", ["SIDE", "ABOVE"])
def test_a_view_of_the_ray_shows_eye_and_hit_below_the_text_and_beside_the_sidebar(
    blender, scene, lecture_state, monkeypatch, side
):
    pixel_lessons.clicked.choose([(12, 8)])
    (explained,) = pixel_lessons.lessons(blender.context).values()
    view, region = SimpleNamespace(view_perspective="CAMERA"), SimpleNamespace(width=900, height=600)
    space = SimpleNamespace(overlay=SimpleNamespace(show_overlays=False), lens=40.0)
    context = SimpleNamespace(region_data=view, region=region, space_data=space, scene=scene)
    monkeypatch.setattr(lecture_operators.text, "uncovered", lambda context: (60, 640))
    monkeypatch.setattr(lecture_operators, "cached_scene", lambda _: pixel_lessons.cached_scene(blender.context))
    lecture_operators.look_at(context, explained, side)
    assert (view.view_perspective, space.overlay.show_overlays) == ("ORTHO", True)
    right, up, _ = np.array(view.view_rotation.to_matrix()).T
    pixel = view.view_distance * 72 / space.lens / region.width

    def projected(point):
        away = point - view.view_location
        return away @ right / pixel + region.width / 2, away @ up / pixel + region.height / 2

    eye, hit = projected(explained.seen.origin), projected(explained.point)
    assert all(60 <= x <= 640 and 0 <= y <= 330 for x, y in (eye, hit)), (eye, hit)
    axis = 0 if side == "SIDE" else 1
    assert hit[axis] - eye[axis] > 150
    monkeypatch.setattr(lecture_operators.text, "uncovered", lambda context: (640, 60))  # all covered
    lecture_operators.look_at(context, explained, side)
    assert 0 < view.view_distance < np.inf
