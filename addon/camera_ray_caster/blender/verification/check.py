"""Verification: a camera's rays compared with Blender's own answers."""

from dataclasses import replace
from functools import partial

from ...core.camera.camera import Camera
from ...core.camera.facts import camera_facts
from ...core.camera.stereo import eye_record
from ...core.records import Finding
from ...core.report.report import Report
from ...core.report.verification import verify
from ...core.timeline import Timeline
from ..read.evaluated import camera_at
from ..read.frames import frame_of, go_to
from ..read.motion import motion_of
from ..read.scene import evaluated_camera
from . import witness
from .cycles_witness import cycles_finding

MOVING_GRID = 2
"""Number of pixels per side at which a moving camera is verified: each projection is searched over all of its times."""


def verify_camera(scene, camera_object=None, frame=None, view="") -> list[Finding]:
    """Return the findings on the camera that ``read_camera`` returns for these arguments; raises the same errors."""
    return _read_and_verified(scene, camera_object, frame, view)[1]


def verified(scene, with_cycles: bool = False) -> Report:
    """Return the report on the scene's camera, its facts and findings; ``with_cycles`` adds ``cycles_finding``.

    Raises the errors of ``read_camera`` and ``cycles_finding``.
    """
    camera, findings = _read_and_verified(scene)
    if with_cycles:
        findings.append(cycles_finding(camera))
    return Report(camera=camera_facts(camera), frame=frame_of(scene), findings=tuple(findings))


def _read_and_verified(scene, camera_object=None, frame=None, view="") -> tuple[Camera, list[Finding]]:
    """Return a camera and the findings on it. For a camera with motion, the round trip covers all of its times."""
    eye = partial(eye_record, view=view)
    with evaluated_camera(scene, camera_object, frame, view) as (active, depsgraph):
        _, camera = camera_at(active, depsgraph, eye)
        findings = verify_evaluated(camera, active, depsgraph, view)
        motion = motion_of(camera, depsgraph, active, partial(go_to, scene), eye)
    if motion is not None:
        camera = replace(camera, timeline=Timeline(motion))
        findings[-1:] = verify(camera, grid=MOVING_GRID)
    return camera, findings


def verify_evaluated(camera: Camera, camera_object, depsgraph, view="") -> list[Finding]:
    """Return the findings on a camera that was read from this object, at the depsgraph's frame.

    Blender answers only for its own models, and for an eye only if the eye is a camera object of its own.
    """
    apart = not view or depsgraph.scene_eval.render.views_format == "MULTIVIEW"
    by_blender = camera.model.key == camera_object.data.type and apart
    return verify(replace(camera, pixel_time=None), witness.ask(camera_object, depsgraph) if by_blender else None)
