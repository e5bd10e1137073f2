"""A lens in focus: where the film stands, and the chief rays from there."""

from collections.abc import Sequence
from functools import lru_cache

from .chief import DEGREE, ChiefRays, chief_rays
from .optics import Optics
from .prescription import D_LINE, Prescription


@lru_cache(maxsize=16)
def optics_of(prescription: Prescription, state: float, wavelength: float) -> Optics:
    """Return the optics of a lens in a configuration at a wavelength in nm."""
    return Optics.of(prescription.in_state(state), wavelength)


def own_focal_length(prescription: Prescription) -> float:
    """Return the focal length of a lens in its first configuration, mm, at the d line."""
    return optics_of(prescription, 0.0, D_LINE).focal_length


def focused(
    prescription: Prescription, sharpest: bool, state: float, wavelength: float, distance: float, f_number: float
) -> tuple[float, ...]:
    """Return z of the film, the radius of the stop, z of the entrance and exit pupils, and the chief rays' numbers.

    distance: of the plane of focus before the entrance pupil, mm. A flat tuple, of which differences can be taken.
    """
    optics = optics_of(prescription, state, wavelength)
    radius = optics.stop_radius(f_number)
    film = optics.sharpest_film(distance, radius) if sharpest else optics.paraxial_film(distance)
    chief = chief_rays(optics, film)
    series = *chief.height, *chief.front, *chief.tangent, *chief.pupil
    return film, radius, optics.entrance_pupil[0], optics.exit_pupil[0], *series, chief.end, chief.rim


def chief_of(numbers: Sequence[float], plain: ChiefRays) -> ChiefRays:
    """Return chief rays with the numbers of ``focused``, which may be varied."""
    count = DEGREE + 1
    height, front, tangent, pupil = (tuple(numbers[k * count : (k + 1) * count]) for k in range(4))
    end, rim = numbers[4 * count :]
    return ChiefRays(height, front, tangent, pupil, end, rim, plain.errors, plain.widest, plain.crossing_error)
