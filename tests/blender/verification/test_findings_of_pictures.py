"""The findings that a picture's report has: of a camera that has not changed they are those of the picture before."""

import pytest

from camera_ray_caster.blender.output import reports
from camera_ray_caster.blender.verification import check


@pytest.fixture
def verifications(monkeypatch):
    """The cameras that were verified, one entry each time."""
    verified = []

    def verify(camera, answers=None, **options):
        verified.append(camera)
        return real(camera, answers, **options)

    real = check.verify
    monkeypatch.setattr(check, "verify", verify)
    monkeypatch.setattr(check, "_kept", {})
    return verified


def findings_at(scene, frame):
    import bpy

    scene.render.engine = "CAMERA_RAY_CASTER"
    scene.frame_set(frame)
    bpy.ops.render.render(scene=scene.name)
    return reports.latest(scene).findings


def test_a_still_camera_is_verified_once_and_again_after_any_change(camera_scene, verifications):
    first = findings_at(camera_scene, 1)
    assert findings_at(camera_scene, 2) == first
    assert len(verifications) == 1
    data, scene = camera_scene.camera.data, camera_scene
    for change in (
        lambda: setattr(data, "lens", 35.0),
        lambda: setattr(data, "shift_x", 0.1),
        lambda: setattr(scene.camera, "location", (0, 0, 1e-6)),
        lambda: setattr(scene.render, "resolution_x", 9),
        lambda: setattr(data, "type", "ORTHO"),
    ):
        count = len(verifications)
        change()
        again = findings_at(scene, 3)
        assert len(verifications) == count + 1
        assert again == tuple(check.verify_camera(scene))


def test_cameras_that_take_turns_are_each_verified_once(camera_scene, verifications):
    import bpy

    first = camera_scene.camera
    bpy.ops.object.camera_add(location=(1, 2, 3))
    other = bpy.context.object
    for camera in (first, other, first, other):
        camera_scene.camera = camera
        findings_at(camera_scene, 1)
    assert len(verifications) == 2
