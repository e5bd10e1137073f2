"""The panels' notes on a camera: missing objects, a stretched frame, an engine that does not support its model."""

from functools import partial

from ...core.cameras.parts.settings import Setting
from ..properties.owners import owner_of
from ..view3d.shown import drawn_alike
from .facts_panels import camera_of
from .follow_timeline import timeline_note
from .frame import frame_note
from .model_drawing import draw_add
from .model_settings import lacks, missing
from .notes import Note
from .other_engine import engine_note
from .see_through import is_seen_through


def notes(context) -> list[Note]:
    """Return the notes on the scene's camera; if it cannot be cast, the reason comes first."""
    scene, camera = context.scene, context.scene.camera
    cast_camera, reason = camera_of(context, camera)
    lacking = missing(context, camera) if reason else []
    frame = frame_note(context, camera)
    every = [Note(lacks(setting), partial(_draw_missing, camera.data, scene, setting)) for setting in lacking]
    if reason and not lacking:
        every.append(Note(reason, frame and frame.mend))  # for a calibrated camera the reason is its frame
        frame = None
    others = engine_note(scene, camera), timeline_note(scene, camera), sample_note(scene, cast_camera)
    every += filter(None, (frame, *others))
    if cast_camera is not None and (remark := cast_camera.model.remark(cast_camera.record)):
        every.append(Note(remark))
    if context.space_data is not None and is_seen_through(context) and not drawn_alike(camera):
        text = "Clicks select in the picture. Gizmos stay in perspective"
        every.append(Note(text, icon="INFO"))
    return every


def sample_note(scene, camera) -> Note | None:
    """Return a note with the number of samples if a camera with an aperture is rendered with one ray per pixel."""
    settings = scene.camera_ray_caster
    if camera is None or camera.aperture is None or settings.samples != 1:
        return None
    text = "No blur with 1 sample: every ray passes through the center of the aperture"
    return Note(text, lambda row: row.prop(settings, "samples"), "INFO")


def _draw_missing(camera, scene, setting: Setting, row) -> None:
    """Draw the button that adds an object, and a list from which it is chosen."""
    draw_add(row, setting)
    row.prop(owner_of(setting, camera, scene), setting.name, text="")
