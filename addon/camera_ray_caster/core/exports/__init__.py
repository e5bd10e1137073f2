"""Exports: cameras by frame as files of other programs.

Files that are written from plain records are those of ``core.programs``; formats that need whole cameras are here.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from ..arguments import chosen as the_word
from ..camera.camera import Camera
from ..programs import PROGRAMS
from ..programs.parts.program import CameraRecord
from ..records import InputError, Pose
from ..units import factor, unit_name
from . import rigid
from .camera_json import CameraJson
from .fitted import FIT, can_fit, in_comments, with_fits, with_heads
from .format import Content, Each, Format, Shot
from .npz import Npz
from .of_program import ProgramFormat
from .stmap import Stmap

_OF_PROGRAMS = [ProgramFormat(program) for program in PROGRAMS if program.export is not None and program.export.files]
EXPORT_FORMATS: tuple[Format, ...] = (
    *sorted(_OF_PROGRAMS, key=lambda each: not each.table), Stmap(), Npz(), CameraJson(),
)
"""All formats, in the order of menus: those of lenses first, those that need whole cameras last."""


def find_format(key: str) -> Format:
    """Return the format of a key. Raises InputError that lists the formats for an unknown key."""
    formats = {each.key: each for each in EXPORT_FORMATS}
    return formats[the_word(key, "format", formats)]


def export_files(
    key: str, shots: Sequence[Shot], fit: Any = None
) -> tuple[Iterator[tuple[str, Content]], list[str]]:
    """Return the files of an export, as an iterator over name and content, and lines of remarks for the user.

    fit: of a lens that the format cannot represent, the nearest one that it can is written, fitted to
    this part of the picture: see ``within`` of ``crc.fit``. None: such a lens is refused.
    The iterator makes each content when it is reached. Raises InputError, in one line, for an unknown format, and for a
    camera that the format cannot represent; the message then lists the formats that can.
    """
    chosen, able, heads, remarks = _prepared(key, shots, fit)
    return with_heads(chosen.files(able), heads), remarks


def records(key: str, shots: Sequence[Shot]) -> list[CameraRecord]:
    """Return the plain records that a program's files are written from. Raises InputError as ``export_files`` does."""
    chosen, able, _, _ = _prepared(key, shots, None)
    assert isinstance(chosen, ProgramFormat)
    return chosen.records(able)


def remarks(key: str, shots: Sequence[Shot]) -> str:
    """Return the comments in the head of an export's files. Raises InputError as ``export_files`` does."""
    return in_comments(_prepared(key, shots, None)[2])


def _prepared(key: str, shots: Sequence[Shot], fit: Any):
    """Return the format, the shots as it represents them, remarks for heads of files, and remarks for the user."""
    chosen, fits = find_format(key), list[str]()
    if fit is not None:
        shots, fits = with_fits(chosen, shots, fit, _refusal)
    for shot in shots:
        reason = _refusal(chosen, shot)
        if reason is not None:
            able = ", ".join(each.key for each in EXPORT_FORMATS if _refusal(each, shot) is None)
            lens = f"{shot.camera.model.label} of camera {shot.camera.name!r}"
            of_lens = fit is None and can_fit(chosen, shot.camera) and rigid.refusal(shot.camera) is None
            near = f", or {FIT} (--fit)" if of_lens else ""
            if len({shot.name for shot in shots}) > 1:
                near += ", or export the other cameras (--cameras)"
            raise InputError(
                f"{chosen.label} cannot represent the {lens}{reason and ', '}{reason}: choose one of {able}{near}"
            )
    remarks = [*dict.fromkeys(line for shot in shots for line in chosen.omissions(shot)), *fits]
    if not chosen.rigid:
        return chosen, shots, fits, remarks
    if not 0 < shots[0].meters < math.inf:
        raise InputError(f"the scene's Unit Scale is {shots[0].meters:g}: set it to a number above 0")
    if chosen.unit is None and shots[0].meters != 1:
        fits.append(f"lengths are in {unit_name(None)} of {shots[0].meters:.6g} m")
        remarks.append(fits[-1])
    shots = Each(shots, chosen.at_ends)
    farthest = max(rigid.with_rotation(shot.camera)[1] for shot in shots)
    if farthest:
        moved = f"poses are the nearest rotations to Blender's matrices, which moves pixels by up to {farthest:.1e}"
        remarks = [moved, *remarks]
    return chosen, Each(shots, partial(_rotated, chosen)), fits, remarks


def _rotated(chosen: Format, shot: Shot) -> Shot:
    """Return a camera whose axes are a rotation, and whose place is in the format's unit."""

    def rotated(camera: Camera) -> Camera:
        camera = rigid.near(camera)
        return replace(camera, pose=Pose(camera.pose.eye * factor(chosen.unit, shot.meters), camera.pose.basis))

    return replace(shot, camera=rotated(shot.camera), last=shot.last and rotated(shot.last))


def _refusal(chosen: Format, shot: Shot) -> str | None:
    reason = chosen.refusal(shot)
    return rigid.refusal(shot.camera) if reason is None and chosen.rigid else reason
