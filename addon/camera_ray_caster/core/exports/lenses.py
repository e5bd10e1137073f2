"""A camera's lens as a calibration: the same record that is read from calibration files.

Each format has a table of its models, with the settings of our models that each of them can store (``core.programs``).
A lens is written as the first model in the table that can store all of its nonzero settings.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from math import pi
from typing import Any, ClassVar

from ..camera.camera import Camera
from ..cameras.equirectangular import Equirectangular
from ..cameras.fisheye_equidistant import FisheyeEquidistant
from ..cameras.fisheye_stereographic import FisheyeStereographic
from ..cameras.model import WindowModel
from ..cameras.opencv_pinhole import OpencvPinhole
from ..cameras.parts.calibrated import Calibrated
from ..cameras.parts.calibration import CALIBRATION
from ..cameras.perspective import Perspective
from ..programs.parts.lens import ANGLES, FRAME_SIZE, Lens, matrix_of
from .format import OWN_TIMES, Format, Shot

MATRIX = "fx", "fy", "cx", "cy"

Table = Mapping[str, tuple[str, Sequence[str]]]
"""Models of a format by name: the key of our model, and the settings that are stored in addition to the matrix."""


def calibrations(camera: Camera) -> list[Lens]:
    """Return the calibrations that give a camera's rays, in pixels of its picture, closest to its model first.

    Each has the key of its model, the size, fx, fy, cx, cy, skew (as in settings: from the center of the top left
    pixel) and the model's other settings. An equirectangular panorama has the angles of its edges. Blender's fisheyes
    end at a rim; a calibration has rays beyond it.
    """
    x0, _, _, y1 = camera.raster.picture
    corner = {"cx": x0, "cy": camera.raster.height - y1}
    size = dict(zip(FRAME_SIZE, map(float, camera.raster.picture_size), strict=True))
    lenses = [
        lens._replace(settings=size | {name: value - corner.get(name, 0) for name, value in lens.settings.items()})
        for lens in _of_frame(camera)
    ]
    return [_sphere(lens) if lens.model == Equirectangular.key else lens for lens in lenses]


def _of_frame(camera: Camera) -> list[Lens]:
    """Return the calibrations in pixels of the full frame."""
    model: Any = camera.model
    kind = type(model)  # not isinstance: subclasses turn their rays further
    if kind is Perspective:
        return [_lens(model, "OPENCV_PINHOLE")]
    if kind is Equirectangular:
        return [_lens(model, model.key)]
    if kind is FisheyeEquidistant and model.half_fov <= pi:
        return [_lens(model, "OPENCV_FISHEYE", 1 / model.half_fov)]
    if kind is FisheyeStereographic:
        return _unified(model, {"unified_xi": 1.0})
    if isinstance(model, Calibrated | OpencvPinhole) and model.K is not None:
        own = {one.name: camera.settings[one.name] for one in model.SETTINGS if one not in CALIBRATION}
        return _unified(model, own) if model.key == "UCM" else [_lens(model, model.key, 1.0, own)]
    return []


def _unified(model: WindowModel, settings: Mapping[str, float]) -> list[Lens]:
    """Return the unified camera with these settings, and the equivalent enhanced unified camera, if there is one."""
    lenses, xi = [_lens(model, "UCM", 1.0, settings)], settings["unified_xi"]
    if xi >= 0 and not any(value for name, value in settings.items() if name != "unified_xi"):
        alpha = xi / (1 + xi)
        lenses.append(_lens(model, "EUCM", 1 / (1 + xi), {"unified_alpha": alpha, "unified_beta": 1.0}))
    return lenses


def _lens(model: WindowModel, key: str, focal: float = 1.0, settings: Mapping[str, float] | None = None) -> Lens:
    """Return a lens whose focal lengths are ``focal`` units of the model's image plane."""
    (fx, skew, cx), (_, fy, cy), _ = model.window.matrix(model.frame[1]).tolist()
    matrix = {"fx": fx * focal, "fy": fy * focal, "cx": cx, "cy": cy, "skew": skew * focal}
    return Lens("", key, matrix | dict(settings or {}))


def _sphere(lens: Lens) -> Lens:
    """Return a panorama by the angles of its edges, of one by pixels per radian and the place of the view direction."""
    fx, fy, cx, cy = matrix_of(lens.settings, 0.5)
    width, height = lens.size
    edges = -cx / fx, (width - cx) / fx, (cy - height) / fy, cy / fy
    size = {name: lens.settings[name] for name in FRAME_SIZE}
    return lens._replace(settings=size | dict(zip(ANGLES, edges, strict=True)))


def find_lens(table: Table, camera: Camera) -> tuple[str, Lens] | None:
    """Return the first model of a format that can store a camera's lens, and the lens; None if no model can."""
    return next(
        (
            (kind, lens)
            for lens in calibrations(camera)
            for kind, (key, terms) in table.items()
            if key == lens.model and not _beyond(lens, terms)
        ),
        None,
    )


def lens_of(table: Table, camera: Camera) -> tuple[str, Lens]:
    """Return the result of ``find_lens`` for a camera that the format does not refuse."""
    found = find_lens(table, camera)
    assert found is not None
    return found


def values(lens: Lens, names: Iterable[str]) -> list[float]:
    """Return the values of settings of a lens; 0 for settings that the lens does not have."""
    return [float(lens.settings.get(name, 0.0)) for name in names]


def by_lens(shots: Sequence[Shot], told: Callable[[Shot], str]) -> Iterator[tuple[str, str, list[Shot]]]:
    """Yield for each lens the name of its file without ending, the lens as text (``told(shot)``), and its shots.

    The name is the camera's, or if the lens changes from frame to frame the name of each shot.
    """
    for name in dict.fromkeys(shot.name for shot in shots):
        own = [(shot, told(shot)) for shot in shots if shot.name == name]
        if len({text for _, text in own}) == 1:
            yield name, own[0][1], [shot for shot, _ in own]
        else:
            yield from ((shot.stem, text, [shot]) for shot, text in own)


class LensFormat(Format):
    """A format of calibrated lenses, most with poses."""

    table: ClassVar[Table]
    rigid = True

    def refusal(self, shot):
        """See Format."""
        if shot.camera.pixel_time is not None:
            return OWN_TIMES
        if find_lens(self.table, shot.camera) is not None:
            return None
        known = {key for key, _ in self.table.values()}
        for lens in calibrations(shot.camera):
            if lens.model in known:
                names = min((_beyond(lens, terms) for key, terms in self.table.values() if key == lens.model), key=len)
                return f"whose {', '.join(names)} {'is' if len(names) == 1 else 'are'} not 0"
        return ""


def _beyond(lens: Lens, terms: Collection[str]) -> list[str]:
    """Return the settings of a lens that are not 0 and that neither the matrix nor ``terms`` contain."""
    return [name for name, value in lens.settings.items() if value and name not in (*MATRIX, *FRAME_SIZE, *terms)]
