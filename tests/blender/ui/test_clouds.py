"""Points of a camera as a mesh and as files, and which of them a scanner has swept at a frame."""

import numpy as np
import pytest

from camera_ray_caster.blender.view3d.hit_points import points_by_now, swept
from camera_ray_caster.core.clouds.cloud import scan
from camera_ray_caster.core.clouds.colors import LABEL, RANGE, RING, colors_of


@pytest.fixture
def scanned(blender, camera_scene):
    """A scanner with 16 beams, 3 above the ground, at 2 sweeps a second."""
    blender.ops.mesh.primitive_plane_add(size=200, location=(0, 0, -3))
    blender.context.object.pass_index = 5
    camera_scene.camera.location, camera_scene.camera.rotation_euler = (0, 0, 0), (np.pi / 2, 0, 0)
    settings = camera_scene.camera.data.camera_ray_caster
    settings.model, settings.scanner_device, settings.scanner_rate = "SCANNER", "VLP_16", 2.0
    camera_scene.render.resolution_x, camera_scene.render.resolution_y = 90, 16
    camera_scene.render.resolution_percentage = 100
    blender.context.view_layer.update()
    return camera_scene


def test_points_to_mesh(blender, scanned):
    assert blender.ops.camera_ray_caster.points_to_mesh() == {"FINISHED"}
    made = blender.context.object
    count = len(made.data.vertices)
    assert count > 100
    places = np.empty(3 * count, np.float32)
    made.data.vertices.foreach_get("co", places)
    assert np.abs(places.reshape(-1, 3)[:, 2] + 3).max() < 1e-6
    values = np.empty(count, np.int32)
    made.data.attributes["category"].data.foreach_get("value", values)
    assert set(values.tolist()) == {5}
    made.data.attributes["ring"].data.foreach_get("value", values)
    assert 0 <= values.min() < values.max() < 8  # the lower half
    ranges = np.empty(count, np.float32)
    made.data.attributes["range"].data.foreach_get("value", ranges)
    np.testing.assert_allclose(ranges, np.linalg.norm(places.reshape(-1, 3), axis=1), atol=0.02)  # origins beside 0


def test_points_are_saved(blender, scanned, tmp_path):
    saved = blender.ops.camera_ray_caster.save_points(filepath=str(tmp_path / "scan"), format="kitti", noise=0.01)
    assert saved == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scan.bin", "scan.label"]


def test_points_have_the_steps_of_their_device(blender, scanned):
    assert blender.ops.camera_ray_caster.points_to_mesh(as_device=True) == {"FINISHED"}
    data = blender.context.object.data
    ranges = np.empty(len(data.vertices), np.float32)
    data.attributes["range"].data.foreach_get("value", ranges)
    assert np.abs(ranges / 0.002 - np.rint(ranges / 0.002)).max() < 1e-7 * ranges.max() / 0.002
    scanned.camera.data.camera_ray_caster.scanner_device = "TERRESTRIAL"
    with pytest.raises(RuntimeError, match="is not known"):
        blender.ops.camera_ray_caster.points_to_mesh(as_device=True)


def test_the_timeline_shows_how_far_a_sweep_is(blender, scanned):
    from camera_ray_caster.blender.read.scene_reader import read_scene

    read = read_scene(scanned)
    cloud = scan(read)
    scanned.render.fps, scanned.frame_start = 24, 1
    for frame, share in ((1, 1 / 12), (6, 6 / 12), (12, 1.0), (13, 1 / 12)):
        scanned.frame_set(frame)
        some = points_by_now(cloud, read.camera, swept(scanned, read.camera))
        assert some.mean() == pytest.approx(share, abs=0.03)
        assert cloud.column[some].max(initial=0) <= 90 * share + 1
    assert points_by_now(cloud, read.camera, None).all()


@pytest.mark.parametrize("by", [RING, RANGE, LABEL])
def test_points_have_the_colors_of_what_they_are_shown_by(blender, scanned, by):
    from camera_ray_caster.blender.read.scene_reader import read_scene

    scanned.camera.data.camera_ray_caster.scanner_device = "OS1_64"  # which counts its rings from the highest beam
    cloud = scan(read_scene(scanned))
    colors = colors_of(cloud, by)
    assert colors.shape == (len(cloud), 4)
    values = {RING: cloud.row, RANGE: cloud.range, LABEL: cloud.category}[by]
    assert len(np.unique(colors, axis=0)) == len(np.unique(values)) or by == RANGE
    if by != LABEL:
        np.testing.assert_allclose(colors[values.argmin()], (0, 0, 1, 1), atol=1e-6)
        np.testing.assert_allclose(colors[values.argmax()], (1, 0, 0, 1), atol=1e-6)
