"""The rolling shutter against Cycles: when each row was exposed is told by where things were that move."""

import numpy as np
import pytest

from camera_ray_caster.blender.cycles import to_cycles
from camera_ray_caster.blender.read.scene_reader import read_camera, read_shapes
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.records import InputError

from ..read.scene_parts import curves
from .cycles import cycles_surface
from .test_hits import add_points

SIZE = 24
REACH = 64.0
"""More than any coordinate in these scenes."""
ROUNDING = 32 * 2**-24 * REACH
"""What float32 may lose in Cycles: an interpolated matrix, a ray through it, a position and its color."""

SHUTTERS = [("START", 0.5, 0.0), ("CENTER", 0.5, 0.0), ("END", 0.5, 0.0), ("CENTER", 2.0, 0.0), ("START", 1.0, 0.25),
            ("END", 0.5, 0.9)]  # fmt: skip


@pytest.fixture
def scene(blender):
    """A camera that looks down with parallel rays, at frame 5."""
    scene = blender.context.scene
    camera = blender.data.objects.new("Camera", blender.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.data.type, camera.data.ortho_scale = "ORTHO", 12.0
    camera.location.z = 10
    camera.data.camera_ray_caster.time_mode = "ROLLING_SHUTTER"
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    return scene


def move(scene, item, speed):
    """Let an object move along x by ``speed`` a frame, and be at frame 5."""
    for frame in (0, 10):
        item.location.x = speed * (frame - 5)
        item.keyframe_insert("location", frame=frame)
    for curve in curves(item):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.frame_set(5)


def set_shutter(scene, position, shutter, duration):
    scene.render.use_motion_blur = True
    scene.render.motion_blur_position, scene.render.motion_blur_shutter = position, shutter
    scene.cycles.rolling_shutter_type, scene.cycles.rolling_shutter_duration = "TOP", duration


def exposed(scene, position, shutter, duration):
    """The first and the last moment of each row by our pixel_time, (rows,) each."""
    middle = read_camera(scene).rays().time[:, 0]
    return middle - shutter * duration / 2, middle + shutter * duration / 2


@pytest.mark.parametrize("setting", SHUTTERS)
def test_a_moving_camera_is_exposed_row_by_row(blender, scene, setting):
    blender.ops.mesh.primitive_plane_add(size=100)
    move(scene, scene.camera, 2.0)
    set_shutter(scene, *setting)
    seen = cycles_surface(scene, "Position", REACH)[..., 0]
    centers = (np.arange(SIZE) + 0.5 - SIZE / 2) / 2
    times = 5 + (seen - centers) / 2.0
    check(times, exposed(scene, *setting))


@pytest.mark.parametrize("setting", SHUTTERS)
def test_a_moving_thing_is_exposed_row_by_row(blender, scene, setting):
    """A plane at 45 degrees: the height that is seen tells how far it has moved to the side."""
    blender.ops.mesh.primitive_plane_add(size=100, rotation=(0, -np.pi / 4, 0))
    move(scene, blender.context.object, 2.0)
    set_shutter(scene, *setting)
    seen = cycles_surface(scene, "Position", REACH)
    times = 5 + (seen[..., 0] - seen[..., 2]) / 2.0
    check(times, exposed(scene, *setting))


def check(times, exposed):
    """Times (h, w) lie in their rows' exposures and are spread over them."""
    first, last = (moment[:, None] for moment in exposed)
    error = ROUNDING / 2.0  # at two units a frame
    assert (times >= first - error).all()
    assert (times <= last + error).all()
    duration = float((last - first)[0, 0])
    if duration > 0:
        share = (times - first) / duration
        # of n even samples the mean lies within 5 / sqrt(12 n)
        assert share.mean() == pytest.approx(0.5, abs=5 / np.sqrt(12 * share.size))
        assert np.ptp(share) > 0.9


def test_a_sphere_that_moves_is_the_same_picture(blender, scene):
    """Cycles' point is an exact sphere, so is ours: positions agree wherever both see it, the rims to a pixel."""
    item = add_points(blender, "Cloud", 0, np.random.default_rng(0), 1)
    item.data.attributes["position"].data[0].vector = (0, 0, 0)
    item.data.attributes["radius"].data[0].value = 2.0
    move(scene, item, 4.0)
    set_shutter(scene, "CENTER", 1.0, 0.0)
    ours = cast(read_camera(scene), read_shapes(scene), passes=("position", "valid", "shape_index"), dtype=np.float64)
    theirs = cycles_surface(scene, "Position", REACH)
    hit, seen = ours["shape_index"] == 0, ~np.isnan(theirs[..., 0])
    time = read_camera(scene).rays().time[:, :1]
    x, y = (np.arange(SIZE) + 0.5 - SIZE / 2) / 2, (np.arange(SIZE)[:, None] + 0.5 - SIZE / 2) / 2
    rim = np.abs(np.hypot(x - 4.0 * (time - 5), y) - 2.0) < 1e-3
    assert np.array_equal(hit[~rim], seen[~rim])
    assert np.count_nonzero(hit) > 30
    assert not np.array_equal(hit, hit[:, ::-1])  # it leans
    steep = 2.0 / np.maximum(ours["position"][..., 2], 1e-3)  # how much height changes where the side is off
    apart = np.linalg.norm(theirs - ours["position"], axis=-1)
    assert (apart <= ROUNDING * (1 + steep))[hit & seen].all()


@pytest.mark.parametrize("moving", ["camera", "thing"])
def test_a_slit_scan_by_rows_is_the_rolling_shutter_of_a_custom_camera(osl, blender, scene, moving):
    """From frame 8 at the bottom to frame 2 at the top, seen of a wall in a slant, which tells where its camera was."""
    blender.ops.mesh.primitive_plane_add(size=100, rotation=(0, -np.pi / 4, 0))
    move(scene, scene.camera if moving == "camera" else blender.context.object, 1.0)
    settings = scene.camera.data.camera_ray_caster
    settings.time_mode, settings.time_start, settings.time_end = "ROWS", 8.0, 2.0
    rows = read_camera(scene).rays().time[:, :1]
    (warning,) = [line for line in to_cycles(scene) if "slit scan" in line]
    assert "from frame" in warning
    seen = cycles_surface(scene, "Position", REACH)
    centers = (np.arange(SIZE) + 0.5 - SIZE / 2) / 2
    moved = seen[..., 0] - (centers if moving == "camera" else seen[..., 2])
    assert np.abs(5 + moved - rows).max() <= 2 * ROUNDING
    assert np.array_equal(read_camera(scene).rays().time[:, :1], rows)


def test_rows_from_the_bottom_up_are_not_cycles_order(osl, scene):
    scene.camera.data.camera_ray_caster.time_mode = "ROWS"
    with pytest.raises(InputError, match="set End to an earlier frame"):
        to_cycles(scene)
    assert scene.camera.data.type == "ORTHO"
