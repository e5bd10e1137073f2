"""An export that is written by a program's file, on plain records of cameras."""

from dataclasses import replace

import numpy as np

from ..camera.camera import Camera
from ..camera.pixel_time import MODE, READOUT, ROLLING_SHUTTER
from ..camera.times import LinearTime
from ..programs.parts.lens import Lens, Models, beyond, word_of
from ..programs.parts.placed import FROM_BLENDER, Rolling
from ..programs.parts.program import CameraRecord, ProgramFiles
from .format import OWN_TIMES, Format, Shot
from .lens_calibrations import calibrations

NO_LENS = Lens("", "", {})
"""The lens of formats that have poses alone."""


class ProgramFormat(Format):
    """A format of calibrated lenses, most with poses, or of poses alone."""

    def __init__(self, program: ProgramFiles):
        export = program.export
        assert export is not None
        self.key, self.label, self.description = export.key, export.label, export.description  # type: ignore[misc]
        self.table, self.rigid, self.unit = export.models, export.rigid, program.unit  # type: ignore[misc]
        self.export = export
        self.formula = bool(export.models)  # type: ignore[misc]

    def refusal(self, shot):
        if shot.camera.pixel_time is not None and not self._rolls(shot.camera):
            return OWN_TIMES
        if not self.table:
            return None
        lens = find_lens(self.table, shot.camera)
        if lens is not None:
            return self.export.refusal(record_of(shot, lens))
        known = {key for key, _ in self.table.values()}
        for lens in calibrations(shot.camera):
            if lens.model in known:
                names = min((beyond(lens, terms) for key, terms in self.table.values() if key == lens.model), key=len)
                return f"whose {', '.join(names)} {'is' if len(names) == 1 else 'are'} not 0"
        return ""

    def _rolls(self, camera: Camera) -> bool:
        return self.export.rolling and MODE.read(camera.record) == ROLLING_SHUTTER

    def at_ends(self, shot):
        times = shot.camera.pixel_time
        if not isinstance(times, LinearTime) or not self._rolls(shot.camera):
            return shot
        first, last = (shot.camera.at(frame) for frame in (times.first, times.last))
        offsets = (times.first - shot.frame) / shot.rate, (times.last - shot.frame) / shot.rate
        return replace(shot, camera=first, last=last, offsets=offsets)

    def omissions(self, shot):
        return super().omissions(shot) if self.table else []

    def records(self, shots) -> list[CameraRecord]:
        """Return the records of cameras that the format does not refuse."""
        records: list[CameraRecord] = []
        known: dict[str, Lens] = {}
        for shot in shots:
            lens = find_lens(self.table, shot.camera) or NO_LENS
            if all(isinstance(value, float | int | str) for value in lens.settings.values()):
                lens = known.setdefault(repr(lens), lens)  # equal lenses are held once
            records.append(record_of(shot, lens))
        return records

    def files(self, shots):
        assert self.export.files is not None
        yield from self.export.files(self.records(shots))


def find_lens(models: Models, camera: Camera) -> Lens | None:
    """Return the calibration of a camera that a program can store, closest to its model first; None if none can be."""
    return next((lens for lens in calibrations(camera) if word_of(models, lens) is not None), None)


def record_of(shot: Shot, lens: Lens) -> CameraRecord:
    """Return a camera at a frame as a plain record."""
    rolling = None
    if shot.last is not None:
        rolling = Rolling(READOUT.read(shot.camera.record), shot.offsets, _pose(shot.last))
    times = shot.frame, shot.seconds, shot.meters
    return CameraRecord(shot.name, shot.stem, lens, _pose(shot.camera), *times, shot.fit, rolling)


def _pose(camera: Camera) -> np.ndarray:
    pose = camera.world_from_camera
    pose[:3] *= FROM_BLENDER.diagonal()
    return pose
