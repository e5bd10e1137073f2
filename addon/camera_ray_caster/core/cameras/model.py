"""The contract of a camera model: what a file in this folder has to say, and what follows from that by default.

A model is a lens and its film alone: pixels in, rays in the camera's frame out. Where the camera stands, which part of
the picture is rendered and at what time is the business of ``core.camera``.

A new model is one file, with a frozen dataclass that inherits ``Model``, and one word in MODELS. It has to give
``key``, ``label``, ``description``, ``group``, ``number``, ``FORMULA`` and ``rays``. All else has a default:
``from_blender`` reads SETTINGS into the model's fields, ``project`` is a numerical inverse of ``rays``, ``bounds`` are
everywhere. A closed form is an improvement, not a duty. One contract test runs over MODELS
(tests/core/cameras/test_model.py), and a test adds a model of 25 lines (tests/blender/add_a_camera).

``rays`` is arithmetic on two numbers or arrays. It does not branch on their values, other than by numpy's ``where``,
so that the formula can be recorded (``core.maths.recording``) and evaluated with any number of digits.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from ..conventions import gamma
from ..maths.panels import Disc
from ..maths.recording import Record, record
from ..maths.speed import lazy
from ..records import BlenderCamera, Pose, Raster
from .parts.aperture import Aperture, thin_lens
from .parts.film import Window
from .parts.inverse import pixels_of
from .parts.settings import Setting
from .parts.silhouette import everywhere

GROUPS = ("Blender's Own", "Calibrated", "Fisheye", "Dome", "Panorama", "Multiperspective", "Historical")
"""What ``Model.group`` may be, in the order of menus and of the table of models."""


class Step(NamedTuple):
    """One step of a formula from the pixel to the ray."""

    words: str
    symbols: str


@dataclass(frozen=True)
class Model(ABC):
    """A camera model over a frame; see the module's page for what a new one has to give."""

    frame: tuple[int, int]
    """Width and height of the full frame in pixels."""

    key: ClassVar[str]
    """Its name in files, records and reports: Blender's camera or panorama type, or one that Blender does not have."""
    label: ClassVar[str]
    """Its name in menus."""
    description: ClassVar[str]
    """One line for menus."""
    group: ClassVar[str]
    """One of GROUPS."""
    number: ClassVar[int | None] = None
    """What a .blend stores for this item of the menu: never changed, never used again. None for Blender's own types."""
    planar: ClassVar[bool] = False
    """Whether t counts depth: directions have z = -1. Otherwise they have unit length, and t counts the distance."""
    central: ClassVar[bool] = True
    """Whether all chief rays leave the eye, the origin of the camera's frame."""
    straight: ClassVar[bool] = False
    """Whether straight lines have straight images: a triangle before the camera lies between its corners' images."""
    parallel: ClassVar[bool] = False
    """Whether all chief rays have the same direction, then given as three numbers."""
    smooth: ClassVar[bool] = True
    """Whether rays are smooth functions of the pixel wherever there are any: the numerical inverse is exact then."""
    by_polynomials: ClassVar[bool] = False
    """Whether polynomials give what ``Camera.rays`` returns for a whole picture (see ``maths.panels``): for models
    whose rays take 1.2 to 3.5 times as long without, and fill most of the picture, or a disc, beyond which ``endless``
    may go on. A cast takes as long with them as without (0.8 to 1.2), since it has to have the components apart, in the
    camera's frame: it asks the formula.
    """
    SETTINGS: ClassVar[tuple[Setting, ...]] = ()
    """All settings that ``from_blender`` reads, in the order of the panel. Blender's properties, the panel, the copying
    into the record, the report and the table of models are made from them.
    """
    FORMULA: ClassVar[tuple[Step, ...]]
    """From the pixel (x, y) to the ray, step by step."""

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Self:
        """Return the model that a record describes. Raises InputError, in one line, for settings without meaning.

        By default the model's own fields are the values of SETTINGS, in their order.
        """
        return cls(raster.size, *(setting.read(raw) for setting in cls.SETTINGS))

    @abstractmethod
    def rays(self, x, y) -> tuple[Any, Any]:
        """Return origin and direction of the chief rays through pixel coordinates, in the camera's frame.

        x and y: numbers, or float64 arrays that broadcast. Origin and direction: three numbers or arrays each, which
        broadcast to the shape of x and y. The direction has z = -1 (``planar``) or unit length. A pixel without a ray
        has NaN in the direction's x.
        """

    @lazy
    def recorded(self) -> Record:
        """The record of ``rays``: from x and y to the components of the origin and of the direction."""
        return record(lambda x, y: [component for vector in self.rays(x, y) for component in vector], 2)

    @property
    def disc(self) -> Disc | None:
        """The part of the picture outside of which there are no rays; None where it has no such form."""
        return None

    @property
    def endless(self) -> Model:
        """The model whose rays go on beyond ``disc``, smoothly where the formula does; itself where it has none."""
        return self

    def project(self, points) -> np.ndarray:
        """Return the pixel coordinates (..., 2) of points (..., 3) in the camera's frame; NaN where no ray meets them.

        By default the numerical inverse of ``rays``: of several pixels that see a point, the one nearest to the middle
        of the frame. Right to the rounding of ``rays`` where the model is smooth; elsewhere a pixel may be missed.
        """
        return pixels_of(self.rays, self.frame, points)

    def bounds(self, centers, radii) -> np.ndarray:
        """Return x0, x1, y0, y1, (n, 4): pixels outside of which no point of the balls is seen.

        centers (n, 3) in the camera's frame, radii (n,). -inf and inf where a ball may be seen everywhere, NaN where it
        is seen nowhere. By default everywhere.
        """
        return everywhere(len(radii))

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture | None:
        """Return what lets in rays beside the chief rays; None where only these count.

        By default the thin lens of Blender's depth of field, where rays have an eye or a direction in common.
        """
        return thin_lens(raw, pose, self.parallel) if self.central or self.parallel else None

    def through(self, aperture: Aperture, chief: tuple[Any, Any], x, y, point: tuple[Any, Any]) -> tuple[Any, Any]:
        """Return origin and direction of the ray of a pixel through a point of the aperture, as ``rays`` does.

        chief: its chief ray. By default the two meet where the aperture is sharp.
        """
        return aperture.through(*chief, self.planar, *point)

    @classmethod
    def eye(cls, raw: BlenderCamera, view: str) -> BlenderCamera | None:
        """Return the record of an eye, "left" or "right", of a model that has eyes of its own.

        None, the default: the camera itself is moved, as Blender does. Raises InputError where there is no such eye.
        """
        return None

    def posed(self, pose: Pose) -> Model:
        """Return the model of a camera that stands there: itself, unless its rays depend on where the world's up is."""
        return self

    @property
    def K(self) -> np.ndarray | None:
        """The camera matrix, (3, 3) float64 in OpenCV's convention: y down, the origin in the center of the top left
        pixel; None for models without one. Where a lens distorts, K applies to the distorted coordinates.
        """
        return None

    def facts(self) -> dict[str, object]:
        """Return what else is to be said of the camera: numbers and lists of numbers by name, in the order shown."""
        return {}

    @property
    def formula_reach(self) -> float:
        """How far from the eye, in the camera's frame, the formula reaches for what else it has, as slits."""
        return 0.0

    def pixel_rounding(self, x, y) -> tuple[Any, Any]:
        """Return what rounding before the model's own formula amounts to: moves of the pixel in x and in y, in pixels.

        By default gamma(8) of the frame's width and height.
        """
        return gamma(8) * self.frame[0], gamma(8) * self.frame[1]

    @property
    def ray_rounding(self) -> float:
        """What rounding of the last operations does to a ray, relative to its length.

        By default gamma(16): numpy's sine and cosine take up to 8 of them, polynomials and roots more.
        """
        return gamma(16)


@dataclass(frozen=True)
class WindowModel(Model):
    """A model that begins with an affine map from the pixel to an image plane."""

    window: Window

    def pixel_rounding(self, x, y) -> tuple[Any, Any]:
        """See Model; only the few operations of the window count."""
        return self.window.rounding(x, y, self.frame)
