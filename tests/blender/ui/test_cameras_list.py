"""The list of the scene's cameras: what it says of each, and what its buttons do."""

import pytest

from camera_ray_caster.blender.ui import in_process
from camera_ray_caster.blender.ui.cameras_list import SidebarCameras

from .test_panels import drawn


@pytest.fixture
def cameras(blender, camera_scene):
    """Three cameras of different models, the first of which is active."""
    camera_scene.camera.name = "Dome"
    camera_scene.camera.data.camera_ray_caster.model = "OMNIMAX"
    for name, kind in (("All around", "PANO"), ("Plain", "PERSP")):
        data = blender.data.cameras.new(name)
        data.type = kind
        data.panorama_type = "EQUIRECTANGULAR"
        camera_scene.collection.objects.link(blender.data.objects.new(name, data))
    return camera_scene


def test_each_camera_is_listed_with_its_model(blender, cameras, monkeypatch):
    assert SidebarCameras.poll(blender.context)
    texts = drawn(blender, SidebarCameras)
    for text in ("All around: Equirectangular", "Dome: Omnimax", "Plain: Perspective"):
        assert text in texts
    blender.data.objects.remove(blender.data.objects["Plain"])
    blender.data.objects.remove(blender.data.objects["All around"])
    monkeypatch.setattr(in_process, "_ended", [])
    assert not SidebarCameras.poll(blender.context), "one camera needs no list"
    for line, shown in (("Wrote /some folder/a_json/camera.json", "Wrote camera.json"), (r"Wrote C:\all\a", "Wrote a")):
        monkeypatch.setattr(in_process, "_ended", [line])
        assert shown in drawn(blender, SidebarCameras)
    monkeypatch.setattr(in_process, "_ended", ["Stopped"])
    assert SidebarCameras.poll(blender.context), "but the result of its run"
    monkeypatch.setattr(in_process, "_ended", [])
    monkeypatch.setattr(in_process, "_running", [object()])
    assert SidebarCameras.poll(blender.context), "but a button that stops its run"


def test_a_camera_is_made_active_and_seen_through(blender, cameras):
    use = blender.ops.camera_ray_caster.use_camera
    assert use(name="Plain") == {"FINISHED"}
    assert cameras.camera.name == "Plain"
    area = next(area for area in blender.context.window.screen.areas if area.type == "VIEW_3D")
    space = area.spaces.active
    space.shading.type, space.region_3d.view_perspective = "SOLID", "PERSP"
    with blender.context.temp_override(area=area):
        for name in ("Dome", "All around"):  # the second one while the view looks through the first
            assert use(name=name, see_through=True) == {"FINISHED"}
            assert cameras.camera.name == name
            assert (space.region_3d.view_perspective, space.shading.type) == ("CAMERA", "RENDERED")
        blender.ops.camera_ray_caster.see_through()
    with pytest.raises(RuntimeError, match="no camera 'Nobody'"):
        use(name="Nobody")
