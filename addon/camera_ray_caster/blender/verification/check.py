"""A camera of a scene held against Blender's own answers."""

from dataclasses import replace

from ...core.camera.camera import Camera
from ...core.records import Finding
from ...core.report.facts import camera_facts
from ...core.report.report import Report
from ...core.report.verification import verify
from ..read.scene import observing, read_camera
from . import witness

MOVING_GRID = 2
"""Pixels a side at which a moving camera is asked: each answer is sought through all of its times."""


def verify_camera(scene, camera_object=None, frame=None, view="") -> list[Finding]:
    """Return the findings on the camera that ``read_camera`` returns for these arguments, or raise what that raises."""
    camera = read_camera(scene, camera_object, frame, view)
    with observing(scene, camera_object, frame, view) as (active, depsgraph):
        return verify_evaluated(camera, active, depsgraph, view)


def verified(scene) -> Report:
    """Return the report on the scene's camera: what it is, and the findings. Raises what ``read_camera`` raises."""
    facts = camera_facts(read_camera(scene))
    return Report(camera=facts, frame=scene.frame_current_final, findings=tuple(verify_camera(scene)))


def verify_evaluated(camera: Camera, camera_object, depsgraph, view="") -> list[Finding]:
    """Return the findings on a camera that was read of this object, as the depsgraph evaluated it.

    Blender answers for its own models alone, for an eye only where that is a camera object of its own, and for the
    depsgraph's frame: a camera with a motion is held against it there, and makes the round trip over all its times.
    """
    apart = not view or depsgraph.scene_eval.render.views_format == "MULTIVIEW"
    by_blender = camera.model.key == camera_object.data.type and apart
    still = replace(camera, pixel_time=None, motion=None)
    findings = verify(still, witness.ask(camera_object, depsgraph) if by_blender else None)
    return findings if camera.motion is None else [*findings[:-1], *verify(camera, grid=MOVING_GRID)]
