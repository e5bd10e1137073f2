"""Verification: a camera's rays compared with Blender's own answers."""

from dataclasses import replace
from functools import partial
from typing import Any

from ...core.arguments import keywords
from ...core.camera.camera import Camera
from ...core.camera.facts import camera_facts
from ...core.camera.stereo import eye_record
from ...core.cameras.parts.port_settings import PORT
from ...core.motion.means import same
from ...core.records import Finding
from ...core.report.report import Report
from ...core.report.verification import verify
from ..read.evaluated import camera_at, scene_at
from ..read.frames import frame_of, go_to
from ..read.motion import motion_of
from ..read.scene_reader import evaluated_camera
from . import blender_witness
from .blender_witness import Witness
from .cycles_witness import cycles_finding

MOVING_GRID = 2
"""Number of pixels per side at which a moving camera is verified: each projection is searched over all of its times."""


@keywords
def verify_camera(scene, camera_object=None, *, frame=None, view="") -> list[Finding]:
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
        read = partial(scene_at, eye=eye, has_colors=False)
        motion = motion_of(camera, depsgraph, active, partial(go_to, scene), read)
    if motion is not None:
        camera = replace(camera, motion=motion)
        findings[-1:] = verify(camera, grid=MOVING_GRID)
    return camera, findings


MOST_KEPT = 64
"""Number of cameras whose findings are kept."""
_kept: dict[tuple[str, str], tuple[Any, list[Finding]]] = {}
"""The findings on cameras and views, the latest last, with the settings that they depend on."""


def findings_of_picture(camera: Camera, camera_object, depsgraph, view="") -> list[Finding]:
    """Return what ``verify_evaluated`` does; of a still camera that has not changed since its last picture, the
    findings of that picture. In a data set of small pictures a verification takes longer than a cast.
    """
    if camera.pixel_time is not None:
        return verify_evaluated(camera, camera_object, depsgraph, view)
    answers, settings = _answers(camera, camera_object, depsgraph, view), {**camera.record.settings, "frame": None}
    of = (replace(camera.record, settings={}), tuple(settings.items()),
          answers and replace(answers, camera=None, depsgraph=None))  # fmt: skip
    last_of, findings = _kept.pop((camera.name, view), (None, []))
    if not same(of, last_of):
        findings = verify(camera, answers)
    _kept[camera.name, view] = of, findings
    if len(_kept) > MOST_KEPT:
        del _kept[next(iter(_kept))]
    return findings


def verify_evaluated(camera: Camera, camera_object, depsgraph, view="") -> list[Finding]:
    """Return the findings on a camera that was read from this object, at the depsgraph's frame."""
    return verify(replace(camera, pixel_time=None), _answers(camera, camera_object, depsgraph, view))


def _answers(camera: Camera, camera_object, depsgraph, view: str) -> Witness | None:
    """Return Blender's answers for a camera: only for its own models, and for an eye only if the eye is a camera object
    of its own.
    """
    apart = not view or depsgraph.scene_eval.render.views_format == "MULTIVIEW"
    by_blender = camera.model.key == camera_object.data.type and apart and PORT.name not in camera.record.settings
    return blender_witness.ask(camera_object, depsgraph) if by_blender else None
