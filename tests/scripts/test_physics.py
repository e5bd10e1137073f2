"""Physics that are not baked: each frame is simulated from the first one on, however it is reached."""

import json

import numpy as np
import pytest

import camera_ray_caster as crc
from camera_ray_caster.blender.read import physics

from .physics_scenes import KINDS, cloth, nodes, particles, rigid_body
from .running import left, refused

PASSES = "position", "normal", "shape_index", "flow_forward", "flow_hidden"
WORDS = "--passes", ",".join(PASSES), "--format", "npz"


FULL = [pytest.param(kind, marks=pytest.mark.full) for kind in KINDS if kind != particles]


@pytest.fixture(params=[particles, *FULL])
def kind(request):
    """A function that makes a scene."""
    return request.param


@pytest.fixture
def file(blender, kind, tmp_path):
    """A file of physics that was saved at frame 16, which was jumped to, and so holds a wrong frame in its caches."""
    kind(blender)
    for frame in (15, 16):
        blender.context.scene.frame_set(frame)
    blender.ops.wm.save_as_mainfile(filepath=str(tmp_path / "physics.blend"))
    return tmp_path / "physics.blend"


def simulated(bpy, file, frame):
    """Camera and shapes at a frame and at the next, evaluated by Blender frame by frame from the first one."""
    bpy.ops.wm.open_mainfile(filepath=str(file))
    scene = bpy.context.scene
    for item in scene.objects:
        item.location = item.location  # Blender forgets the frames that the file holds
    for step in range(1, frame + 2):
        scene.frame_set(step)
    there = crc.read_scene(scene)
    scene.frame_set(frame)
    return crc.read_scene(scene), there


def same(one, other):
    """Whether two NPZ files have the same arrays, bit for bit."""
    with np.load(one) as first, np.load(other) as second:
        assert first.keys() == second.keys()
        return all(np.array_equal(first[name], second[name], equal_nan=first[name].dtype.kind == "f") for name in first)


def test_each_way_to_a_frame_leads_to_the_same_frame(blender, command, file, tmp_path):
    run = lambda *words, out: command("cast", file, *WORDS, *words, "--output", tmp_path / out)  # noqa: E731
    assert run("--frames", "1:16", out="whole").returncode == 0
    picture = "physics_{:04}.npz".format
    here, there = simulated(blender, file, 16)
    images = crc.cast(here.camera, here.shapes, passes=("position", "shape_index"))
    with np.load(tmp_path / "whole" / picture(16)) as whole:
        assert (whole["shape_index"] >= 0).any()
        assert all(np.array_equal(whole[name], images[name]) for name in images)
        assert np.nanmax(np.abs(whole["flow_forward"])) > 0.1, "the next frame is simulated, too"
    assert not np.array_equal(here.shapes.center, there.shapes.center) or here.shapes.meshes != there.shapes.meshes
    assert run("--frame", "16", out="single").returncode == 0
    assert same(tmp_path / "whole" / picture(16), tmp_path / "single" / "physics.npz")
    assert run("--frames", "1:16:5", out="some").returncode == 0
    assert run("--frames", "1:16", "--shard", "2/3", out="shard").returncode == 0
    for folder, frames in (("some", (1, 6, 11, 16)), ("shard", (2, 5, 8, 11, 14))):
        assert all(same(tmp_path / "whole" / picture(frame), tmp_path / folder / picture(frame)) for frame in frames)
    assert run(out="file_s_own").returncode == 0
    assert same(tmp_path / "whole" / picture(16), tmp_path / "file_s_own" / "physics.npz")


@pytest.mark.full
def test_sets_of_several_processes_and_of_several_runs_are_the_same(command, file, tmp_path):
    words = (*WORDS, "--frames", "9:16", "--output")
    assert command("dataset", file, *words, tmp_path / "one").returncode == 0
    names = [name for name in left(tmp_path / "one") if name.endswith("npz")]
    assert len(names) == 8
    assert command("dataset", file, *words, tmp_path / "two", "--workers", "2").returncode == 0
    assert all(same(tmp_path / "one" / name, tmp_path / "two" / name) for name in names)
    for name in names[5:]:
        (tmp_path / "two" / name).unlink()
    assert "Wrote 3 of 8" in command("dataset", file, *words, tmp_path / "two").stdout
    assert all(same(tmp_path / "one" / name, tmp_path / "two" / name) for name in names)


@pytest.mark.full
def test_frames_are_simulated_once(blender, command, file, tmp_path, monkeypatch):
    evaluated = []
    monkeypatch.setattr(physics, "raise_if_stopping", lambda: evaluated.append(blender.context.scene.frame_current))
    assert command("cast", file, *WORDS, "--frames", "1:8", "--output", tmp_path / "out").returncode == 0
    assert len(evaluated) < 20, "each frame for itself, and from where the last picture has left it"


def test_the_library_asks_for_a_bake_or_reads_it(blender):
    """It leaves the caches of a session alone."""
    rigid_body(blender)
    scene = blender.context.scene
    for read in (crc.read_scene, crc.read_shapes):
        with pytest.raises(crc.InputError, match="the physics of 'Body' is not baked, and frame 8 was not simulated"):
            read(scene, frame=8)
    with pytest.raises(crc.InputError, match="frame 2 was not simulated: bake it first"):
        crc.read_scene(scene, passes=("flow_forward",))
    assert crc.read_scene(scene).shapes.names[0] == "Body", "the current frame is what Blender shows"
    with blender.context.temp_override(point_cache=scene.rigidbody_world.point_cache):
        blender.ops.ptcache.bake(bake=True)
    moving = crc.read_scene(scene, frame=8, passes=("flow_forward",))
    height, then = (shapes.center[shapes.names.index("Body"), 2] for shapes in (moving.shapes, moving.next.shapes))
    assert height == pytest.approx(2 - 9.81 / 2 * (7 / 24) ** 2, abs=0.1), "it falls freely, but for damping"
    assert height - then == pytest.approx(9.81 * (7.5 / 24) / 24, rel=0.1)


def test_the_library_plays_simulation_nodes(blender):
    """Blender does not tell whether they are baked into the file."""
    nodes(blender)
    scene = blender.context.scene
    start, moving = crc.read_shapes(scene), crc.read_scene(scene, frame=8, passes=("flow_forward",))
    step = np.hypot(0.03, 0.07)
    first, now, then = (shapes.center[0] for shapes in (start, moving.shapes, moving.next.shapes))
    assert np.linalg.norm(now - first) == pytest.approx(7 * step, rel=0.1)
    assert np.linalg.norm(then - now) == pytest.approx(step, rel=0.2)


@pytest.mark.parametrize("case", ["hidden", "on the disk", "stretched"])
def test_what_cannot_be_simulated_is_to_be_baked(blender, command, tmp_path, case):
    cloth(blender)
    scene, item = blender.context.scene, blender.data.objects["Body"]
    if case == "hidden":
        item.hide_set(True)
    elif case == "stretched":
        scene.render.frame_map_new = 50
    path = tmp_path / "physics.blend"
    blender.ops.wm.save_as_mainfile(filepath=str(path))
    if case == "on the disk":
        item.modifiers["Cloth"].point_cache.use_disk_cache = True
        blender.ops.wm.save_as_mainfile(filepath=str(path))
    line = refused(command("cast", path, "--frame", "16", "--output", tmp_path / "out"))
    assert "the physics of 'Body' is not baked" in line
    assert line.endswith("bake it first")
    assert not (tmp_path / "out").exists()
    done = command("cast", path, "--frame", "1", "--passes", "depth", "--output", tmp_path / "out")
    assert done.returncode == 0, "its first frame is not simulated"
    moving = command("cast", path, "--frame", "1", "--passes", "flow_forward", "--output", tmp_path / "moving")
    assert "bake it first" in refused(moving), "but the next one is"


def test_blender_s_own_rendering_asks_for_a_bake(blender, tmp_path):
    """F12 and --render-frame evaluate a frame before an engine is asked, and it cannot simulate others."""
    rigid_body(blender)
    scene = blender.context.scene
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.frame_set(16)
    blender.ops.render.render()
    from camera_ray_caster.blender.output import reports

    assert "the physics of 'Body' is not baked" in json.dumps(reports.latest().warnings)
    scene.camera_ray_caster.use_pass_flow_forward = True
    with pytest.raises(RuntimeError, match="'Body' is not baked, and frame 17 was not simulated: bake it first"):
        blender.ops.render.render()
    with blender.context.temp_override(point_cache=scene.rigidbody_world.point_cache):
        blender.ops.ptcache.bake(bake=True)
    scene.frame_set(16)
    blender.ops.render.render()
    assert not reports.latest().warnings


def test_particles_without_physics_are_what_they_are_at_a_frame(blender, command, tmp_path):
    """Scattered things that do not move are often hidden in the viewport: nothing has to be baked."""
    particles(blender)
    settings = blender.data.objects["Body"].particle_systems[0].settings
    settings.physics_type, settings.lifetime = "NO", 100
    path = tmp_path / "scattered.blend"
    for hidden in (False, True):
        blender.data.objects["Body"].hide_set(hidden)
        blender.ops.wm.save_as_mainfile(filepath=str(path))
        run = lambda *words, out: command("cast", path, *WORDS, *words, "--output", tmp_path / out)  # noqa: E731
        assert run("--frames", "9:11", out=f"whole{hidden}").returncode == 0
        assert run("--frame", "11", out=f"single{hidden}").returncode == 0
        assert same(tmp_path / f"whole{hidden}" / "scattered_0011.npz", tmp_path / f"single{hidden}" / "scattered.npz")
        with np.load(tmp_path / f"single{hidden}" / "scattered.npz") as images:
            assert len(np.unique(images["shape_index"])) > 3
