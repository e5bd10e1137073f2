"""Lecture mode of Step Through: its steps, its keys' operator, and the size of its text."""

from types import SimpleNamespace

from camera_ray_caster.blender.view3d import lecture, lesson


def test_a_lecture_writes_one_step_large_and_keys_stay_within_the_steps(blender, scene, monkeypatch):
    place, written = blender.context.window_manager.camera_ray_caster_place, []
    step = blender.ops.camera_ray_caster.lecture_step
    lesson.pixels[:] = [(12, 8)]
    try:
        assert not step.poll()
        place.lecture = True
        (explained,) = lesson.lessons(blender.context).values()
        seen = [step(by=by) and place.step for by in (-1, 1, 1, 100, -1)]
        assert seen == [0, 1, 2, len(explained.steps), len(explained.steps) - 1]
        monkeypatch.setattr(lecture.text, "write", lambda context, lines, place, size: written.append((lines, size)))
        monkeypatch.setattr(lecture.text, "wrapped", lambda context, line, width, size: [line])
        monkeypatch.setattr(lecture.text, "uncovered", lambda context: (0, 900))
        preferences = SimpleNamespace(system=SimpleNamespace(ui_scale=2.0),
                                      ui_styles=[SimpleNamespace(widget=SimpleNamespace(points=11))])  # fmt: skip
        for height in (2000, 300):
            view = SimpleNamespace(preferences=preferences, region=SimpleNamespace(height=height))
            lecture.write_step(view, explained, 0)
        (large, size), (small, least) = written
        assert size == 2.4 * 22
        assert large[0] == ("", f"Perspective  1/{len(explained.steps) + 1}")
        assert least < size
        assert 1.5 * least * len(small) <= 300
    finally:
        place.lecture, place.step = False, 0
        lesson.forget()
