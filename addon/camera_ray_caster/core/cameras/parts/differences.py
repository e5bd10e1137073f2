"""The derivatives of what a setting determines by an iteration or a search: from differences."""

from collections.abc import Callable

from ...maths.recording import Varied

STEP = 2.0**-10
"""Change of a number over its size: differences of the fourth order err by about STEP^4."""

WEIGHTS = (-2, 1 / 12), (-1, -2 / 3), (1, 2 / 3), (2, -1 / 12)
"""Steps and weights of the central difference of the fourth order."""


def varied_by(function: Callable[..., tuple[float, ...]], *numbers: float) -> tuple[float, ...]:
    """Return ``function(*numbers)``, a tuple of floats; if some of the numbers are varied, its values are, too."""
    values = function(*map(float, numbers))
    slopes: list[dict[int, float]] = [{} for _ in values]
    count = 0
    for index, number in enumerate(numbers):
        if not isinstance(number, Varied):
            continue
        count = len(number.slopes)
        step = STEP * (abs(float(number)) or 1.0)
        total = [0.0] * len(values)
        for steps, weight in WEIGHTS:
            moved = [float(other) + (steps * step if k == index else 0.0) for k, other in enumerate(numbers)]
            for k, value in enumerate(function(*moved)):
                total[k] += weight * value / step
        for derivatives, by_number in zip(slopes, total, strict=True):
            for parameter, slope in enumerate(number.slopes):
                if slope is not None:
                    derivatives[parameter] = derivatives.get(parameter, 0.0) + by_number * slope
    if not count:
        return values
    return tuple(
        Varied(value, tuple(derivatives.get(parameter) for parameter in range(count)))
        for value, derivatives in zip(values, slopes, strict=True)
    )
