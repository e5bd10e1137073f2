"""Set Frame: the frame of a camera's own pictures, by its button, with a preset, and with a calibration file."""

import pytest

from camera_ray_caster.blender.ui import presets

from .test_presets import OURS

SIZES = {
    "KITTI_odometry_00": (1241, 376), "KITTI-360_fisheye_left": (1400, 1400), "TUM_RGB-D_freiburg1": (640, 480),
    "TUM_VI_cam0_512": (512, 512), "EuRoC_MAV_cam0": (752, 480), "Project_Aria_RGB": (2880, 2880),
    "Project_Aria_SLAM_left": (640, 480), "GoPro_HERO10_Wide_4_colon_3": (5312, 3984),
    "GoPro_HERO11_Wide_8_colon_7": (5312, 4648), "Fisheye-Nikkor_6mm_f_slash_2.8": (1080, 1080),
}  # fmt: skip
"""Sizes of the pictures of presets, where they are not 16:9."""


@pytest.fixture
def render(camera_scene):
    render = camera_scene.render
    render.resolution_x, render.resolution_y = 1920, 1080
    return render


def size(render):
    return render.resolution_x, render.resolution_y


def use(blender, name, **options):
    (path,) = (path for path in OURS if path.stem == name)
    return blender.ops.camera_ray_caster.preset_execute(filepath=str(path), **options)


def test_the_button_sets_the_frame_of_the_camera_once(blender, camera_scene, render):
    data = camera_scene.camera.data
    data.type, data.panorama_type = "PANO", "EQUIRECTANGULAR"
    assert blender.ops.camera_ray_caster.set_frame() == {"FINISHED"}
    assert size(render) == (1920, 960)
    assert blender.ops.camera_ray_caster.set_frame() == {"CANCELLED"}


@pytest.mark.parametrize("path", OURS, ids=lambda path: path.stem)
def test_a_preset_sets_its_frame_or_is_refused_in_one_line(blender, camera_scene, render, path):
    settings = camera_scene.camera.data.camera_ray_caster
    before = {name: str(settings.get(name)) for name in settings.bl_rna.properties.keys()}  # noqa: SIM118 (a collection of RNA)
    if path.stem not in SIZES:
        assert use(blender, path.stem, set_frame=False) == {"FINISHED"}
        assert size(render) == (1920, 1080)
        return
    with pytest.raises(RuntimeError, match="The picture is stretched: the frame has 1920 × 1080 pixels") as refusal:
        use(blender, path.stem, set_frame=False)
    assert "{} × {}".format(*SIZES[path.stem]) in str(refusal.value)
    assert size(render) == (1920, 1080)
    assert settings.model == "BLENDER"
    after = {name: str(settings.get(name)) for name in before}
    assert {name: value for name, value in after.items() if value != before[name] and before[name] != "None"} == {}
    assert use(blender, path.stem) == {"FINISHED"}
    assert size(render) == SIZES[path.stem]


def test_the_tick_box_of_the_menu_counts_where_the_operator_is_not_told(blender, camera_scene, render):
    manager = blender.context.window_manager
    setattr(manager, presets.TICK, False)
    with pytest.raises(RuntimeError, match="enable Set Frame"):
        use(blender, "KITTI_odometry_00")
    setattr(manager, presets.TICK, True)
    assert use(blender, "KITTI_odometry_00") == {"FINISHED"}


def test_a_calibration_file_sets_its_frame_or_is_refused(blender, camera_scene, render, tmp_path):
    path, group = tmp_path / "cameras.txt", camera_scene.camera.data.camera_ray_caster
    path.write_text("1 PINHOLE 1241 376 700 700 620 188\n")
    load = blender.ops.camera_ray_caster.load_calibration
    with pytest.raises(RuntimeError, match="1920 × 1080 pixels, and its calibrated pictures have 1241 × 376"):
        load(filepath=str(path), set_frame=False)
    assert (group.model, group.calibration_file, size(render)) == ("BLENDER", "", (1920, 1080))
    assert load(filepath=str(path)) == {"FINISHED"}
    assert (group.model, size(render)) == ("OPENCV_PINHOLE", (1241, 376))


def test_a_camera_in_file_is_not_remembered(blender, camera_scene, render, tmp_path):
    path, group = tmp_path / "cameras.txt", camera_scene.camera.data.camera_ray_caster
    path.write_text("1 PINHOLE 192 108 70 70 96 54\n7 PINHOLE 192 108 80 80 96 54\n")
    load = blender.ops.camera_ray_caster.load_calibration
    load(filepath=str(path), camera="7")
    path.write_text("1 PINHOLE 192 108 70 70 96 54\n")
    assert load(filepath=str(path)) == {"FINISHED"}
    assert group.calibration_camera == ""
