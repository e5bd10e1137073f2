"""The f-theta camera of NVIDIA's simulators and recordings: a polynomial between the angle and the radius.

Assumption: the azimuth is kept, except for a linear map of the picture, for a sensor not perpendicular to the axis.
Formula: (u, v), v down, is the pixel's offset from the center; (u, v) = ((c, d), (e, 1)) (u', v'), and r is the length
of (u', v'). Either r is a polynomial of the angle theta (angle to pixel distance, "forward"), or theta is a polynomial
of r (pixel distance to angle, "backward"), of any degree, without a constant. Files have both polynomials and declare
one as the model. Here the other is replaced by the exact inverse, by Newton's method to full precision.
The picture ends where the polynomial stops growing, at ``ftheta_max_angle``, or at 180 degrees: files may have larger
angles, which NVIDIA's own library limits to 180 degrees as well.
Singular: the radius where it stops growing, and the point straight behind the eye.
References: NVIDIA DriveWorks SDK documentation, Camera Models (FTheta); NVIDIA Omniverse documentation, F-Theta camera.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf, pi

import numpy as np

from ..maths.inversion import Inverse
from ..maths.polynomials import horner
from ..maths.recording import is_recorded, least_root
from ..maths.recording.scalars import least, plain
from ..maths.speed import lazy
from ..records import BlenderCamera, Raster
from .model import IN_CASTS, Step
from .parts.calibrated import Calibrated, in_words
from .parts.calibration import PRINCIPAL_POINT, Calibration
from .parts.left_out import NEEDED
from .parts.radial import RAY, factors_of, radii_of
from .parts.settings import ABOVE_ZERO, Choice, Coefficients, Item, Number

ANGLE_TO_RADIUS = "ANGLE_TO_RADIUS"
REFERENCE = Choice(
    "ftheta_reference", "Reference", "Polynomial that defines the model; the other polynomial is "
                                     "computed from it", ANGLE_TO_RADIUS,
    (
        Item(ANGLE_TO_RADIUS, "Angle to Radius", "Forward: the radius is a polynomial of the angle", 0),
        Item("RADIUS_TO_ANGLE", "Radius to Angle", "Backward: the angle is a polynomial of the radius", 1),
    ),
)  # fmt: skip
POLYNOMIALS = {
    ANGLE_TO_RADIUS: Coefficients(
        "ftheta_angle_to_radius", "Angle to Radius",
        "Radius in pixels or mm: 0, then the coefficients of theta, theta^2, ...", "0 1000", grows=(1, 0),
        left_out=NEEDED, used_with=((REFERENCE.name, ANGLE_TO_RADIUS),),
    ),
    "RADIUS_TO_ANGLE": Coefficients(
        "ftheta_radius_to_angle", "Radius to Angle", "Angle in radians: 0, then the coefficients of r, r^2, ...",
        "0 0.001", grows=(0, -1), left_out=NEEDED, used_with=((REFERENCE.name, "RADIUS_TO_ANGLE"),),
    ),
}  # fmt: skip
MAX_ANGLE = Number(
    "ftheta_max_angle", "Maximum Angle", "Largest angle from the axis; the picture ends there, or at 180 degrees", pi,
    ABOVE_ZERO, unit="angle", digits=4, soft_high=pi,
)  # fmt: skip
C, D, E = (
    Number(
        f"ftheta_{name}", name.upper(), "Entry of the affine matrix ((c, d), (e, 1)), x right, y down", default,
        digits=6, step=0.1,
    )
    for name, default in (("c", 1.0), ("d", 0.0), ("e", 0.0))
)  # fmt: skip


@dataclass(frozen=True)
class FTheta(Calibrated):
    """An f-theta lens. Its plane is in pixels of the calibrated picture, or in millimeters."""

    polynomial: tuple[float, ...]
    """Coefficients, from the linear term up."""
    forward: bool
    """Whether the polynomial gives the radius of an angle."""
    max_angle: float
    """Largest angle of the picture, radians."""

    key = "FTHETA"
    label = "F-Theta"
    description = "A calibrated fisheye of NVIDIA: a polynomial of any degree between angle and radius"
    number = 24
    polynomials = IN_CASTS
    guarded = False
    SETTINGS = (*PRINCIPAL_POINT, REFERENCE, *POLYNOMIALS.values(), C, D, E, MAX_ANGLE)
    FORMULA = (
        Step(
            "From the center x_0, y_0, v down, in units of the calibration, of s_x and s_y pixels of the frame",
            "u = (x - x_0) / s_x, v = (y_0 - y) / s_y",
        ),
        Step(
            "On a sensor perpendicular to the axis of the lens, y up",
            "a = (u - d v) / (c - d e), b = (e u - c v) / (c - d e), rho = sqrt(a² + b²)",
        ),
        Step("Angle, forward, by Newton's method", "rho = k1 theta + k2 theta² + ..."),
        Step("Angle, backward", "theta = k1 rho + k2 rho² + ..."),
        RAY,
    )

    @property
    def steps(self) -> tuple[Step, ...]:
        """See Model: with the polynomial of these settings."""
        *before, forward, backward, ray = self.FORMULA
        variable, result = ("theta", "rho") if self.forward else ("rho", "theta")
        words = (forward if self.forward else backward).words
        return (*before, Step(words, f"{result} = {in_words('k', 1, self.polynomial, variable)}"), ray)

    def formula_values(self, x, y):
        """See Model: the coefficients, and the angle that is found by iteration."""
        values = {f"k{i}": k for i, k in enumerate(self.polynomial, 1)}
        if not self.forward:
            return values
        rho = np.sqrt(self._r_squared(x, y))
        theta = plain(self._inverse(rho))
        return values | ({"theta": theta} if is_recorded(theta) or rho <= self.own_rim else {})

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> FTheta:
        """See Model. A polynomial that does not start at 0 and grow there is refused."""
        reference, (c, d, e) = REFERENCE.read(raw), (setting.read(raw) for setting in (C, D, E))
        if not c - d * e > 0:
            raise C.refusal(raw, f"{c:.6g}", f"above ftheta_d times ftheta_e, {d * e:.6g}")
        setting = POLYNOMIALS[reference]
        constant, *coefficients = setting.read(raw)
        if constant != 0 or not coefficients or not coefficients[0] > 0:
            raise setting.refusal(raw, repr(setting.given(raw)), "0, a number above 0, and more")
        window = Calibration.from_blender(raw, raster, settings=PRINCIPAL_POINT).window(((c, d), (e, 1.0)))
        forward = reference == ANGLE_TO_RADIUS
        return cls(raster.size, window, inf, tuple(coefficients), forward, least(MAX_ANGLE.read(raw), pi)).settled()

    @lazy
    def limit(self) -> float:
        """The largest angle (forward) or radius (backward) at which the polynomial is valid."""
        end = self.max_angle if self.forward else least_root((-self.max_angle, *self.polynomial))
        return least(end, least_root([i * k for i, k in enumerate(self.polynomial, 1)]))

    @property
    def own_rim(self) -> float:
        return self.value(self.limit) if self.forward else self.limit

    @property
    def K(self) -> None:
        """None, since the polynomial replaces the focal lengths; see Model."""
        return None

    def value(self, x):
        """Return the values of the polynomial."""
        return x * horner(x, self.polynomial)

    def _slope(self, x):
        return horner(x, [i * k for i, k in enumerate(self.polynomial, 1)])

    @cached_property
    def _inverse(self):
        return Inverse(self.value, self._slope, 0.0, self.limit)

    def factors(self, r_squared):
        r = radii_of(r_squared)
        theta = self._inverse(r) if self.forward else self.value(r)
        return factors_of(theta, r)

    def radius(self, theta):
        return self.value(theta) if self.forward else self._inverse(theta)

    @property
    def widest(self) -> float:
        return self.limit if self.forward else min(self.value(self.limit), pi)
