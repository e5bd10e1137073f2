"""Time Stretching: a frame is one place on the timeline, however a picture of it is asked for."""

import pytest

from .physics_scenes import empty
from .running import left
from .test_physics import same

WORDS = "--passes", "position,shape_index,flow_forward,flow_backward", "--format", "npz"


@pytest.fixture(params=[(100, 50), pytest.param((30, 100), marks=pytest.mark.full)])
def file(blender, request, tmp_path):
    """A ball that moves past a camera with a rolling shutter, in stretched time."""
    scene = empty(blender)
    scene.render.frame_map_old, scene.render.frame_map_new = request.param
    scene.render.resolution_x, scene.render.resolution_y = 16, 12
    scene.camera.data.camera_ray_caster.time_mode = "ROLLING_SHUTTER"
    blender.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=1.5, location=(-3, 0, 1))
    ball = blender.context.object
    ball.keyframe_insert("location", frame=1)
    ball.location.x = 3
    ball.keyframe_insert("location", frame=30)
    path = tmp_path / "stretched.blend"
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_single_frames_and_shares_are_those_of_a_whole_run(command, file, tmp_path):
    run = lambda *words, out: command("cast", file, *WORDS, *words, "--output", tmp_path / out)  # noqa: E731
    assert run("--frames", "1:5", out="whole").returncode == 0
    picture = "stretched_{:04}.npz".format
    assert not same(tmp_path / "whole" / picture(3), tmp_path / "whole" / picture(4))
    assert run("--frame", "4", out="single").returncode == 0
    assert same(tmp_path / "whole" / picture(4), tmp_path / "single" / "stretched.npz")
    assert run("--frames", "1:5:4", out="some").returncode == 0
    assert run("--frames", "1:5", "--shard", "2/3", out="share").returncode == 0
    for folder, frames in (("some", (1, 5)), ("share", (2, 5))):
        assert all(same(tmp_path / "whole" / picture(frame), tmp_path / folder / picture(frame)) for frame in frames)


@pytest.mark.full
def test_sets_of_several_processes_and_of_several_runs_are_the_same(command, file, tmp_path):
    words = (*WORDS, "--frames", "2:5", "--output")
    assert command("dataset", file, *words, tmp_path / "one").returncode == 0
    assert command("dataset", file, *words, tmp_path / "two", "--workers", "2").returncode == 0
    names = [name for name in left(tmp_path / "one") if name.endswith("npz")]
    assert len(names) == 4
    (tmp_path / "two" / names[2]).unlink()
    assert command("dataset", file, *words, tmp_path / "two").returncode == 0
    assert all(same(tmp_path / "one" / name, tmp_path / "two" / name) for name in names)
