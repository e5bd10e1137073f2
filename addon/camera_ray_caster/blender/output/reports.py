"""The reports of the latest render and verification of each scene, and the text datablock that shows a report."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from textwrap import shorten
from typing import Any, Self

import bpy
from bpy.app.handlers import persistent

from ...core.camera.facts import camera_facts
from ...core.records import InputError
from ...core.report.report import Report, as_lines
from ..read.evaluated import camera_at
from ..read.materials import MAGENTA, VIEWPORT_COLOR

TEXT = "Camera Ray Caster Report"
NAMES_WIDTH = 60
"""Maximum number of characters for the names of left-out objects in a line."""


@dataclass(frozen=True)
class Source:
    """What a report is of."""

    scene: int
    """``session_uid`` of the scene."""
    camera: Mapping[str, Any]
    """Facts of the scene's own camera, which is neither eye of a stereo scene; {} if it cannot be cast."""

    @classmethod
    def read(cls, scene, depsgraph) -> Self:
        """Read the source at the depsgraph's frame."""
        try:
            camera = camera_facts(camera_at(scene.camera, depsgraph)[1])
        except InputError:
            camera = {}
        return cls(scene.session_uid, camera)


_latest: dict[int, Report] = {}
_verified: dict[int, Report] = {}
"""Reports by the scene's ``session_uid``, the latest last."""


def keep(report: Report, source: Source) -> None:
    """Remember the report of the latest render of a scene. It may be called on a render's thread."""
    _keep(_latest, report, source.scene)
    _keep(_verified, replace(report, camera=source.camera), source.scene)


def keep_verified(report: Report, scene) -> None:
    """Remember the report of the latest verification of a scene's camera."""
    _keep(_verified, report, scene.session_uid)


def latest(scene=None) -> Report | None:
    """Return the report of the latest render of a scene, by default of any, or None before the first."""
    return _last(_latest, scene)


def verified(scene=None) -> Report | None:
    """Return the report with the latest findings on a scene, by default on any, or None before the first. Its
    ``camera`` has the facts of the scene's own camera, even if the findings are on the eyes.
    """
    return _last(_verified, scene)


def _keep(reports: dict[int, Report], report: Report, scene: int) -> None:
    reports.pop(scene, None)
    reports[scene] = report


def _last(reports: dict[int, Report], scene) -> Report | None:
    return next(reversed(reports.values()), None) if scene is None else reports.get(scene.session_uid)


def relative_error(report: Report, statistic: str) -> str:
    """Return the "median" or "worst" error bound of the distances as text, relative to the distance."""
    bound = getattr(report.accuracy, statistic)("relative_distance")
    return "nothing hit" if bound is None else f"≤ {bound:.0e}"


def by_reason(report: Report) -> dict[str, list[str]]:
    """Return the names of the left-out objects, by reason."""
    names: dict[str, list[str]] = {}
    for name, reason in report.left_out:
        names.setdefault(reason, []).append(name)
    return names


def is_simplified(reason: str) -> bool:
    """Return whether a reason is that of a material or world which is cast, with a simpler color."""
    return reason.endswith((VIEWPORT_COLOR, MAGENTA))


def left_out_count(left_out) -> str:
    """Return the number of left-out objects in words, and whether colors are simplified; "" if neither."""
    count = len({name for name, reason in left_out if not is_simplified(reason)})
    remarks = [f"{count} {'object' if count == 1 else 'objects'} left out"] * (count > 0)
    remarks += ["colors simplified"] * any(is_simplified(reason) for _, reason in left_out)
    return ", ".join(remarks).capitalize()


def left_out_line(left_out) -> str:
    """Return ``left_out_count`` with the names, shortened to fit a line."""
    names = shorten(", ".join(dict.fromkeys(name for name, _ in left_out)), NAMES_WIDTH, placeholder=" ...")
    return f"{left_out_count(left_out)}: {names}" if names else ""


def users_of(view_layer, reason: str, names: list[str]) -> list:
    """Return the objects in a view layer that were left out for a reason, or that use a material which was."""
    objects = view_layer.objects
    if not is_simplified(reason) and any(name in objects for name in names):
        return [objects[name] for name in names if name in objects]
    materials = {bpy.data.materials.get(name) for name in names} - {None}
    return [item for item in objects if materials & {slot.material for slot in item.material_slots}]


def write_text(report: Report):
    """Write a report into the text datablock TEXT and return it. Only the main thread may add datablocks."""
    text = bpy.data.texts.get(TEXT) or bpy.data.texts.new(TEXT)
    text.from_string("\n".join(as_lines(report)) + "\n")
    return text


@persistent
def forget(*_):
    """Forget the reports: another file is loaded, and they do not apply to it."""
    _latest.clear()
    _verified.clear()


def register(undo) -> None:
    undo.callback(forget)
    undo.add_handlers(forget, "load_pre")
