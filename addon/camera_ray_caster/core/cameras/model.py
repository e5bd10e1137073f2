"""The contract of a camera model: what a file in this folder has to define, and the defaults of all else.

A model is a lens and its film: pixels in, rays in the camera's frame out. Pose, render window and time belong to
``core.camera``.

A new model is one file, with a frozen dataclass that inherits ``Model``, and one word in MODELS. It has to give
``key``, ``label``, ``description``, ``group``, ``number``, ``FORMULA`` and ``rays``. All else has a default, which may
be overridden by a closed form. One contract test runs over MODELS (tests/core/cameras/test_model.py), and a test adds a
model of 25 lines (tests/blender/add_a_camera).

``rays`` is arithmetic on two numbers or arrays. It branches on their values only by numpy's ``where``, and leaves out
work only where ``may_hold`` says that no value needs it, so that the formula can be recorded
(``core.maths.recording``) and evaluated with any number of digits.

``from_blender`` also runs on varied numbers, which carry the derivatives by the settings
(``core.maths.recording.varied``): what rays depend on is made by Python's operators, numpy's functions of numbers, and
``sin``, ``cos``, ``tan`` and ``array`` of ``core.maths.recording``, since those of the module math and arrays of
float64 drop derivatives. A term is left out where a number is false, not where it equals 0.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np

from ..conventions import gamma
from ..maths.panels import Disc
from ..maths.recording import Record, record
from ..maths.speed import lazy
from ..records import BlenderCamera, Pose, Raster
from .parts.aperture import Aperture, thin_lens
from .parts.calibration import FROM_FILE
from .parts.film import Window
from .parts.inverse import pixels_of
from .parts.old_names import OldNames
from .parts.outline import outline_of
from .parts.seen_parts import SeenParts, parts_of
from .parts.settings import Setting
from .parts.steps import Firing, Step

NOWHERE, IN_RAYS, IN_CASTS = 0, 1, 2
"""Values of ``Model.polynomials``: nowhere, in ``Camera.rays``, or in casts, too."""
GROUPS = ("Blender's Own", "Calibrated", "Real Lens", "Fisheye", "Dome", "Panorama", "Multiperspective", "Historical")
"""Values of ``Model.group``, in the order of menus and of the table of models."""


@dataclass(frozen=True)
class Model(OldNames, ABC):
    """A camera model over a picture of a size; the module's docstring lists what a new model has to define."""

    size: tuple[int, int]
    """Width and height of the full picture in pixels."""

    key: ClassVar[str]
    """Name in files, records and reports: Blender's camera or panorama type, or a name that Blender does not have."""
    label: ClassVar[str]
    """Name in menus."""
    description: ClassVar[str]
    """Description for menus, in one line."""
    group: ClassVar[str]
    """One of GROUPS."""
    number: ClassVar[int | None] = None
    """Number that a .blend stores for this item of the menu: never changed, never reused. None for Blender's types."""
    planar: ClassVar[bool] = False
    """Whether the ray parameter t is depth: directions have z = -1. Otherwise they have unit length; t is distance."""
    central: ClassVar[bool] = True
    """Whether all chief rays leave the eye, the origin of the camera's frame."""
    focused_at: ClassVar[float | None] = None
    """Depth at which a central model may replace this one, whose eye moves a little; None if none may."""
    straight: ClassVar[bool] = False
    """Whether straight lines have straight images, so that the image of a triangle before the camera is a triangle."""
    parallel: ClassVar[bool] = False
    """Whether all chief rays have the same direction, which is then given as three numbers."""
    smooth: ClassVar[bool] = True
    """Whether rays are smooth functions of the pixel wherever they exist. If so, the numerical inverse is exact."""
    guarded: ClassVar[bool] = True
    """Whether ``Camera.project`` checks each pixel by its ray (see ``camera.guard``), in 0.9 to 1.3 times the time.
    False where rays take longer than their inverse (1.4 to 6 times): a few pixels of each new camera are checked.
    """
    bounds_are_wide: ClassVar[bool] = False
    """Whether bounds are much wider than what a ball covers in the picture, as those by parts of a table are."""
    differentiable: ClassVar[bool] = True
    """Whether pixels are parts of one picture. Otherwise there are no derivatives, no solid angles and no flow."""
    polynomials: ClassVar[int] = NOWHERE
    """Where polynomials give a whole picture (see ``maths.panels``). IN_RAYS: rays take 1.4 to 17 times as long without
    them, and fill most of the picture, or a disc beyond which ``endless`` continues them. Casts gain nothing (0.8 to
    1.2). IN_CASTS: also in ``rays``, for parts of it that take sines or iterate and are smooth beyond the disc.
    """
    SETTINGS: ClassVar[tuple[Setting, ...]] = ()
    """All settings that ``from_blender`` reads, in the order of the panel: properties, reports and tables follow."""
    BESIDE_FILE: ClassVar[tuple[Setting, ...]] = FROM_FILE
    """The settings that a calibration file leaves as they are; it replaces all others."""
    FORMULA: ClassVar[tuple[Step, ...]]
    """Steps of the formula from the pixel (x, y) to the ray: r is its direction, of any length, o its origin, rho a
    radius in the picture. Each step assigns names, worked out from settings, facts, ``formula_values`` and other steps.
    """

    @property
    def steps(self) -> tuple[Step, ...]:
        """FORMULA as it is for these settings: with as many terms of a polynomial as there are coefficients."""
        return self.FORMULA

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Self:
        """Return the model that a record describes. Raises InputError, in one line, for invalid settings.

        By default the fields after ``size`` are the values of SETTINGS, in their order.
        """
        return cls(raster.size, *(setting.read(raw) for setting in cls.SETTINGS))

    @classmethod
    def following(cls, settings: Mapping[str, Any]) -> dict[str, Any]:
        """Return the values of settings that, in Python, follow from those given if they are left out; default none."""
        return {}

    def formula_values(self, x: float, y: float) -> dict[str, Any]:
        """Return the values, at a pixel, of the names in FORMULA that its steps do not assign and that are neither
        settings nor facts: what is found by iteration, and points and lines. The default is none.
        """
        return {}

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

    @lazy
    def seen_parts(self) -> SeenParts:
        """Parts of the frame by the ranges of the formula."""
        return parts_of(lambda: self.recorded, self.size, self.central)

    @property
    def disc(self) -> Disc | None:
        """The disc in the picture outside of which there are no rays; None if there is no such disc."""
        return None

    @property
    def endless(self) -> Model:
        """The model whose rays go on beyond ``disc``, smoothly where the formula does; itself if ``disc`` is None."""
        return self

    @lazy
    def outline(self) -> np.ndarray:
        """Where the picture ends within the frame, as pixel coordinates (9, 2): see ``outline_of``."""
        return outline_of(self)

    def project(self, points) -> np.ndarray:
        """Return the pixel coordinates (..., 2) of points (..., 3) in the camera's frame; NaN where no ray meets them.

        The default is the numerical inverse of ``rays``. If several pixels see a point, it returns the pixel nearest to
        the middle of the frame. It is right to the rounding of ``rays`` if the model is smooth; otherwise it may miss a
        pixel.
        """
        return pixels_of(self.rays, self.size, points)

    def bounds(self, centers, radii) -> np.ndarray:
        """Return x0, x1, y0, y1, (n, 4): pixels outside of which no point of the balls, by centers (n, 3) in the
        camera's frame and radii (n,), is seen; -inf and inf if it may be seen everywhere, NaN if nowhere.
        The default follows from the formula; from one that iterates, everywhere.
        """
        return self.seen_parts.bounds(centers, radii)

    def aperture(self, raw: BlenderCamera, pose: Pose) -> Aperture | None:
        """Return the aperture, which lets in rays besides the chief rays; None if there are only chief rays.

        The default is the thin lens of Blender's depth of field if all rays share an eye or a direction, else None.
        """
        return thin_lens(raw, pose, self.parallel) if self.central or self.parallel else None

    def through(self, aperture: Aperture, chief: tuple[Any, Any], x, y, point: tuple[Any, Any]) -> tuple[Any, Any]:
        """Return origin and direction of a pixel's ray through a point of the aperture, in the form of ``rays``.

        chief: the pixel's chief ray. By default the two rays meet on the aperture's surface of focus.
        """
        return aperture.through(*chief, self.planar, *point)

    def light(self, aperture: Aperture, x, y, point: tuple[Any, Any]):
        """Return the light of a pixel's ray through a point of the aperture, relative to the middle of the picture, a
        number or three of red, green and blue; if it is not None, the default, rays without a direction are dark.
        """
        return None

    def remark(self, raw: BlenderCamera) -> str:
        """Return what is cast otherwise than a record asks, in one sentence for reports and panels; "" if nothing."""
        return ""

    @classmethod
    def eye(cls, raw: BlenderCamera, view: str) -> BlenderCamera | None:
        """Return the record of an eye, "left" or "right", of a model that has eyes of its own. None, the default: the
        camera itself is moved, as in Blender. Raises InputError if there is no such eye.
        """
        return None

    @classmethod
    def off_axis(cls, raw: BlenderCamera, slope: float) -> BlenderCamera:
        """Return the record of an eye with Off-Axis convergence, whose picture is moved so that the point at which the
        eyes converge, at X / depth = slope in the eye's frame, is where the camera itself sees it.

        The default is the record as it is: the eyes are parallel, as those of Blender's panoramas.
        """
        return raw

    @property
    def limits(self) -> tuple[float, float]:
        """Least and largest t that the device measures, within the clip range. The default is any."""
        return 0.0, np.inf

    @property
    def device_size(self) -> tuple[int, int] | None:
        """Columns and rows of a device such as a scanner; None, the default, for models of any size."""
        return None

    @property
    def firing(self) -> Firing | None:
        """When pixels fire; None, the default, for cameras without such times."""
        return None

    @property
    def shape(self) -> float | None:
        """Width over height, on square pixels, of a picture that the model does not stretch; None, the default, if it
        has none. With a calibration, the size of the calibrated picture counts instead: see ``camera.asked_size``.
        """
        return None

    def posed(self, pose: Pose) -> Model:
        """Return the model of a camera with this pose: itself, unless its rays depend on the world's up direction."""
        return self

    def settled(self) -> Self:
        """Return the model with the fields that follow from others computed again, such as where its rays end.

        It is asked of a model whose fields have been interpolated. The default is the model itself.
        """
        return self

    @property
    def K(self) -> np.ndarray | None:
        """The camera matrix, (3, 3) float64 in OpenCV's convention: y down, the origin in the center of the top left
        pixel; None for models without one. Where a lens distorts, K applies to the distorted coordinates.
        """
        return None

    def facts(self) -> dict[str, object]:
        """Return further facts for reports: numbers and lists of numbers by name, in the order shown."""
        return {}

    @property
    def formula_reach(self) -> float:
        """Largest distance from the eye of other points that the formula uses, such as those of slits."""
        return 0.0

    def pixel_rounding(self, x, y) -> tuple[Any, Any]:
        """Return the rounding before the model's own formula, as shifts of the pixel in x and in y, in pixels.

        The default is gamma(8) of ``size``.
        """
        return gamma(8) * self.size[0], gamma(8) * self.size[1]

    @property
    def ray_rounding(self) -> float:
        """Rounding error of the last operations on a ray, relative to the ray's length. The default is gamma(16):
        numpy's sine and cosine account for up to 8 of the 16, polynomials and roots for more.
        """
        return gamma(16)

    def formula_rounding(self, x, y) -> tuple[Any, Any]:
        """Return further rounding errors of rays, those of a formula in which numbers cancel: of the origin as a length
        in the camera's frame, and of the direction over its length. The default is that there are none.
        """
        return 0.0, 0.0


@dataclass(frozen=True)
class WindowModel(Model):
    """A model that begins with an affine map from the pixel to an image plane."""

    window: Window

    @property
    def shape(self) -> float | None:
        """See Model: the shape of the part of the plane that is seen."""
        width, height = self.size
        return abs(width * self.window.pitch_x / (height * self.window.pitch_y))

    def pixel_rounding(self, x, y) -> tuple[Any, Any]:
        """See Model; the error is that of the window's few operations."""
        return self.window.rounding(x, y, self.size)
