"""A camera behind glass: any model whose rays leave one eye, and a port that refracts them.

Assumptions: geometric optics, faces that are planes or spheres; the lens alone gives the rays in the medium inside.
Rays begin on the outer face, and so do distances: what is between the lens and that face is not cast. Depth is the
distance along the ray. There is no ray where the light is totally reflected.
Formula: with d the unit direction inside, N the normal of a plate, c = d . N and n_m relative to the index inside, the
part of n d along a face is the same on both sides (Snell's law): r = d - c N + sqrt(n_m^2 - 1 + c^2) N; at a dome, so
at one face after the other.
See ``parts.port`` for the inverse and references.
"""

from dataclasses import dataclass, replace
from functools import cache
from operator import attrgetter
from typing import Any, ClassVar

import numpy as np

from ..conventions import gamma
from ..maths.vector import unit
from ..records import BlenderCamera, InputError, Raster
from .model import Model, Step
from .parts.aperture import Aperture, focus_of
from .parts.port import PORTS, DomePort, FlatPort, balls_inside, rays_inside
from .parts.port_settings import PORT, SETTINGS
from .parts.pose import pose_from
from .parts.silhouette import everywhere
from .parts.traced_aperture import TracedAperture, lines

EYE = 0.0, 0.0, 0.0
BLUR_SAMPLES = 9
"""Pixels across and up, and points of the aperture, at which the blur is measured."""
CONVERGED, SHARP = 1.05, 1e-6
"""Where twice as many pixels across and up find a blur that is larger by this factor and angle, as they do close to
total reflection and to a plate's own direction, it counts as endless. The measured blur has a margin of 1.25.
"""
OF_FLAT = (
    Step("Unit vector inside", "d = r / sqrt(r . r)"),
    Step("Cosine of the angle inside to the plate's normal N", "c = d . N"),
    Step("In the glass and in the medium, times the relative index", "g = sqrt(ng² - 1 + c²), m = sqrt(nm² - 1 + c²)"),
    Step("Origin on the outer face, D the distance and T the thickness", "o = d D/c + (d - N c) T/g + N T"),
    Step("Direction behind the port", "r = (d - N c + N m) / nm"),
)
OF_DOME = (
    Step("Unit vector inside", "d = r / sqrt(r . r)"),
    Step("Square of its line's distance from the dome's center, from which the eye is at E", "s = (E × d) . (E × d)"),
    Step("At the inner face, inside and in glass", "a = sqrt(A² - s), b = sqrt(ng² A² - s)"),
    Step("At the outer face, in glass and in the medium", "f = sqrt(ng² B² - s), h = sqrt(nm² B² - s)"),
    Step("On the inner face, and in the glass", "P = E + d (a - E . d), k = d + P (b - a)/A²"),
    Step("On the outer face", "Q = P + k (f - b)/ng²"),
    Step("Origin and direction behind the port", "o = Q - E, r = (k + Q (h - f)/B²) / nm"),
)


@dataclass(frozen=True)
class BehindPort(Model):
    """A lens and a port; the classes that ``behind`` returns have the settings of both."""

    lens: Model
    port: FlatPort | DomePort
    focus: float
    """Depth of the plane of focus, Blender units."""

    kind: ClassVar[type[Model]]
    """The model of the lens."""
    port_class: ClassVar[type[FlatPort] | type[DomePort]]
    central = False

    @classmethod
    def from_blender(cls, raw: BlenderCamera, raster: Raster) -> Model:  # type: ignore[override]
        """Return the lens behind its port; the lens alone if all indices are equal. Raises InputError for a lens
        whose rays do not leave one eye.
        """
        lens, port = cls.kind.from_blender(raw, raster), cls.port_class.from_blender(raw)
        if not lens.central:
            raise InputError(f"the rays of camera {raw.name!r} have no eye in common: set {PORT.name} to NONE")
        if isinstance(port.glass, float) and port.glass == port.medium == 1:
            return lens
        return cls(raster.size, lens, port, float(focus_of(raw, pose_from(raw))))

    def __reduce__(self):
        """Return how to unpickle the model, whose class is no attribute of this module."""
        return _unpickled, (self.kind, self.port_class, self.size, self.lens, self.port, self.focus)

    @property
    def steps(self) -> tuple[Step, ...]:
        """See Model: those of the lens, then those of the port."""
        return *self.lens.steps, *(OF_FLAT if isinstance(self.port, FlatPort) else OF_DOME)

    def formula_values(self, x, y):
        port = self.port
        known: dict[str, Any] = {"ng": float(port.glass), "nm": float(port.medium)}
        if isinstance(port, FlatPort):
            known |= {"N": port.axis, "D": float(port.distance), "T": float(port.thickness)}
        else:
            known |= {"E": -np.array(port.center), "A": float(port.inner), "B": float(port.outer)}
        return self.lens.formula_values(x, y) | known

    def rays(self, x, y):
        return self.port.bent(EYE, self._unit(self.lens.rays(x, y)[1]))

    def _unit(self, direction):
        return unit(direction) if self.lens.planar else direction

    def project(self, points):
        """See Model: the direction inside by Newton's method, then the inverse of the lens."""
        points = np.asarray(points, np.float64)
        with np.errstate(all="ignore"):  # NaN means no pixel
            return self.lens.project(rays_inside(self.port, points.reshape(-1, 3))).reshape(*points.shape[:-1], 2)

    def bounds(self, centers, radii):
        """See Model: those of balls inside that hold what may be seen."""
        if np.isinf(radii).any():
            return everywhere(len(radii))
        with np.errstate(all="ignore"):  # a plate at the eye has points without a ray
            held, grown = balls_inside(self.port, centers, radii)
        unseen = np.isnan(grown)
        bounds = self.lens.bounds(held, np.where(unseen, 0.0, grown))
        bounds[unseen] = np.nan
        return bounds

    def aperture(self, raw, pose):
        """See Model: the lens's own, sharp at its focus distance inside."""
        thin = self.lens.aperture(raw, pose)
        if thin is None:
            return None
        fine = self._traced(thin, 2 * BLUR_SAMPLES - 1)
        coarse = fine[:, ::2, ::2]  # of the first BLUR_SAMPLES in each direction
        bounded = np.isfinite(fine).all() and fine[0].max() <= CONVERGED * coarse[0].max()
        bounded = bounded and fine[2].max() <= CONVERGED * coarse[2].max() + SHARP
        apart, sharp, spread = fine.reshape(3, -1) if bounded else np.array([[np.inf], [0.0], [0.0]])
        kept: dict[str, Any] = vars(thin)
        apart, sharp, spread = (tuple(each.tolist()) for each in (apart, sharp, spread))
        return TracedAperture(**kept, apart=apart, sharp=sharp, spread=spread, reach=self.port.reach)

    def _traced(self, thin: Aperture, count: int) -> np.ndarray:
        """Return the blur of chief rays of count x count pixels, (3, count, count), as ``lines`` does: 0 where the lens
        has no ray, NaN where the port reflects one totally.
        """
        x, y = (np.linspace(0.0, side, count) for side in self.size)
        x, y = (np.ravel(each)[:, None] for each in np.meshgrid(x, y))
        share = (np.arange(BLUR_SAMPLES) + 0.5) / BLUR_SAMPLES
        point = thin.points(*(np.ravel(each) for each in np.meshgrid(share, share)))
        with np.errstate(all="ignore"):
            chief = self.lens.rays(x, y)
            seen = np.broadcast_to(np.isfinite(chief[1][0]), (count * count, 1))
            origin, direction = self.lens.through(thin, chief, x, y, point)
            bent, center = (self.port.bent(o, self._unit(d)) for o, d in ((origin, direction), (EYE, chief[1])))
            passes = np.isfinite(bent[1][0]) & np.isfinite(center[1][0]) & seen
            spreads = np.array(lines(center, bent[0], bent[1], passes))
        spreads[:, (passes != seen).any(axis=1)] = np.nan
        return spreads.reshape(3, count, count)

    def through(self, aperture, chief, x, y, point):
        origin, direction = self.lens.through(aperture, self.lens.rays(x, y), x, y, point)
        return self.port.bent(origin, self._unit(direction))

    def remark(self, raw):
        """See Model: the lens's, or from which angle a plate reflects all light."""
        least = min(self.port.glass, self.port.medium)
        if isinstance(self.port, DomePort) or least >= 1:
            return self.lens.remark(raw)
        angle = f"{np.degrees(np.arcsin(float(least))):.4g}"
        return f"the port totally reflects what is more than {angle} degrees from its normal: no light comes from there"

    def posed(self, pose):
        return replace(self, lens=self.lens.posed(pose))

    def settled(self):
        return replace(self, lens=self.lens.settled())

    @property
    def focused_at(self) -> float:  # type: ignore[override]
        return self.focus

    @property
    def formula_reach(self) -> float:
        return self.lens.formula_reach + self.port.reach

    @property
    def ray_rounding(self) -> float:
        return gamma(8)

    def formula_rounding(self, x, y):
        """See Model: the rounding of the ray inside, as the port lets it grow."""
        moved, turned = self.port.growth(self._unit(self.lens.rays(x, y)[1]))
        rounding = self.lens.ray_rounding + gamma(12) + self.lens.formula_rounding(x, y)[1]
        return rounding * moved, rounding * turned


for _name in ("device_size", "facts", "guarded", "light", "pixel_rounding", "shape", "smooth"):
    setattr(BehindPort, _name, property(attrgetter(f"lens.{_name}")))


def _unpickled(kind: type[Model], port_class: type, *values: Any) -> Model:
    port = next(key for key, of_key in PORTS.items() if of_key is port_class)
    return behind(kind, port)(*values)


def lens_of(model: Model) -> Model:
    """Return the lens of a model behind a port; any other model as it is."""
    return model.lens if isinstance(model, BehindPort) else model


def takes_port(kind: type[Model]) -> bool:
    """Whether a port can be before a model: its rays leave one eye, and its pixels are parts of a picture."""
    return bool(kind.central) and kind.differentiable


@cache
def behind(kind: type[Model], port: str) -> type[Model]:
    """Return the model of a lens behind a port, an item of PORT. Raises InputError for a model without an eye."""
    if port not in PORTS:
        return kind
    if not takes_port(kind):
        raise InputError(f"{kind.label} has no {PORT.name}: choose a model whose rays leave one eye")
    item = next(item for item in PORT.items if item.key == port)
    settings = replace(PORT, items=(item,)), *SETTINGS[port]
    return type(
        f"{kind.__name__}Behind{PORTS[port].__name__}",
        (BehindPort,),
        {
            **{name: getattr(kind, name) for name in ("key", "group", "number", "FORMULA")},
            **{name: staticmethod(getattr(kind, name)) for name in ("following", "eye", "off_axis")},
            "label": f"{kind.label} behind a {item.label}",
            "description": kind.description,
            "kind": kind,
            "port_class": PORTS[port],
            "SETTINGS": (*kind.SETTINGS, *settings),
            "BESIDE_FILE": (*kind.BESIDE_FILE, *settings),
            "__doc__": BehindPort.__doc__,
            "__module__": __name__,
        },
    )
