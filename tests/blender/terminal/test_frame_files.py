"""What a file may not do to the files that a render writes."""

from types import SimpleNamespace

import pytest

from camera_ray_caster.core.records import InputError


@pytest.mark.parametrize("suffix", ["/../../../x", "/x", "\\x"])
def test_a_view_whose_suffix_leads_to_another_folder_is_refused(blender, tmp_path, suffix):
    from camera_ray_caster.blender.terminal.frame_files import render

    scene = blender.context.scene
    blender.ops.object.camera_add()
    scene.camera = blender.context.object
    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.render.use_multiview = True
    scene.render.views["left"].file_suffix = suffix
    with pytest.raises(InputError, match=r"file suffix .* of view 'left' leads to another folder"):
        render(scene, tmp_path / "deep" / "out", "picture")
    assert list(tmp_path.iterdir()) == []


def test_the_meters_of_a_data_set_are_those_of_its_reports(camera_scene):
    from camera_ray_caster.blender.engine.job import Job
    from camera_ray_caster.blender.read.scene_reader import evaluated_camera, read_camera
    from camera_ray_caster.blender.terminal.dataset import common_of

    camera_scene.unit_settings.system, camera_scene.unit_settings.scale_length = "NONE", 0.01
    (layer,) = camera_scene.view_layers
    pictures = SimpleNamespace(
        scene=camera_scene, passes={layer.name: ["depth"]}, keypoints=None, camera_at=lambda job: read_camera(job)
    )
    with evaluated_camera(camera_scene) as (camera, depsgraph):
        job = Job.read(depsgraph, camera, ["depth"])
    assert common_of(pictures, camera_scene)["common"]["host"] == job.host
