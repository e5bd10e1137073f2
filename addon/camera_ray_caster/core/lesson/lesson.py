"""Explanation of a pixel in steps, with numbers: raster, view coordinates, model formula, ray, shapes, hit, color."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arguments import word
from ..camera.camera import Camera
from ..cameras.behind_port import lens_of
from ..cameras.model import WindowModel
from ..cameras.parts.calibrated import Calibrated
from ..cameras.parts.calibration import PRINCIPAL_POINT, Calibration
from ..cameras.parts.film import Film
from ..cameras.real_lens import RealLens
from ..cast import MOST_SAMPLES, cast
from ..casting.hit_values import HitValues
from ..casting.pixels import hits_at, stored, window_of
from ..casting.plan import make_plan
from ..casting.request import MATERIAL, SHADINGS, Request
from ..records import InputError, Shapes
from .diagram import PROBED, Probe, probe_of
from .formula import NOISE, digits, shown, worked_out
from .lens_diagram import refraction_lines
from .light import color_lines
from .meetings import Meeting, meetings, nearest

NORMALIZED = "[-1, 1]²"
"""Text in the words of a formula step whose x and y are view coordinates instead of pixels."""


PAGE = 6
"""Maximum number of lines of a page of a lecture: as many as a projector shows large in half a view."""

GLASS = "Through the glass"
"""Title of the step of a real lens's surfaces."""


@dataclass(frozen=True)
class Lesson:
    """Steps of one pixel from the raster to its color."""

    seen: Probe
    steps: tuple[tuple[str, tuple[str, ...]], ...]
    """Pairs (title, lines), in order."""
    met: tuple[Meeting, ...] = ()
    """Shapes that the ray's line intersects; the visible shape is first."""
    point: np.ndarray | None = None
    """World position of the visible point, (3,); None if nothing is hit."""
    normal: np.ndarray | None = None
    color: np.ndarray | None = None
    """The pixel's linear RGBA in the picture, (4,); None if it is the mean of too many rays."""
    label: str = ""
    formula: tuple[str, ...] = ()
    """The model's name and its formula in symbols."""

    @property
    def screens(self) -> list[tuple[str, tuple[str, ...]]]:
        """The pages of a lecture: the model's formula in symbols, then the steps, in which it has its numbers. A step
        of more than ``PAGE`` lines has several pages; a line and the indented lines below it stay together.
        """
        pages = [(title, page) for title, lines in self.steps for page in _pages(lines)]
        return [(self.label, self.formula), *pages]

    def lines(self) -> list[str]:
        """Return all steps as lines of text."""
        return [line for title, texts in self.steps for line in (title, *(f"  {text}" for text in texts), "")][:-1]

    def as_data(self) -> dict[str, Any]:
        """Return all that is known about the pixel in the types of JSON, without NaN and infinity: None in their place.

        pixel (column, row), view in [-1, 1]², origin, direction, distance, name, shape_index, point, normal, color, and
        steps as pairs of title and lines.
        """
        seen = self.seen
        known = {
            "pixel": seen.pixel, "view": seen.view, "origin": seen.origin, "direction": seen.direction,
            "distance": seen.distance, "name": seen.name or None, "shape_index": seen.shape_index,
            "point": self.point, "normal": self.normal, "color": self.color, "steps": self.steps,
        }  # fmt: skip
        return {name: _plain(value) for name, value in known.items()}

    def __repr__(self) -> str:
        return f"<Lesson: pixel {self.seen.pixel}, {self.seen.name or 'no hit'}, {len(self.steps)} steps: print it>"

    def __str__(self) -> str:
        return "\n".join(self.lines())


def _pages(lines: tuple[str, ...]) -> list[tuple[str, ...]]:
    """Cut lines before lines without indent into as few pages of up to ``PAGE`` lines as possible, the shortest of them
    as long as possible. A line with more lines below it has a page of its own.
    """
    starts = [k for k, line in enumerate(lines) if not line.startswith(" ")] + [len(lines)]
    best: dict[int, list[tuple[str, ...]]] = {len(lines): []}
    """The pages from each of these lines to the end."""
    for k in reversed(range(len(starts) - 1)):
        first = starts[k]
        ends = [starts[k + 1], *(end for end in starts[k + 2 :] if end - first <= PAGE)]
        cuts = ([lines[first:end], *best[end]] for end in reversed(ends))
        best[first] = min(cuts, key=lambda pages: (len(pages), -min(map(len, pages))))
    return best[0]


def _plain(value: Any) -> Any:
    """Return a value in the types of JSON, None for what is not finite."""
    if isinstance(value, np.ndarray | tuple | list):
        parts = [_plain(item) for item in value]
        return None if parts and all(item is None for item in parts) else parts
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not np.isfinite(value) else value


def pixel_at(camera: Camera, x: float, y: float) -> tuple[int, int]:
    """Return column and row of the pixel of the full frame that holds a point of [-1, 1]², the view coordinates.

    A point between two pixels belongs to the upper or right one, the frame's upper and right edge to the last pixels.
    Raises InputError for a point outside.
    """
    if not (-1 <= x <= 1 and -1 <= y <= 1):
        raise InputError(f"point {x:g},{y:g} is outside the frame: give -1,-1 (bottom left) to 1,1 (top right)")
    width, height = camera.raster.size
    return min(int((x + 1) / 2 * width), width - 1), min(int((y + 1) / 2 * height), height - 1)


def lesson(
    camera: Camera,
    shapes: Shapes,
    column: int,
    row: int,
    *,
    shading: str = MATERIAL,
    samples: int = 1,
    max_samples: int = MOST_SAMPLES,
    progress: Callable[[float], bool] | None = None,
) -> Lesson:
    """Return the steps of a pixel at the camera's own frame. Pixels of the full frame are counted from the bottom left.

    The steps follow the chief ray. The color is that of ``cast`` with the same shading and samples; the mean
    of more than ``max_samples`` samples is left out. ``progress`` and Cancelled are as in ``cast``. Raises InputError
    for a pixel outside of the frame.
    """
    raster = camera.raster
    if not (0 <= column < raster.width and 0 <= row < raster.height):
        raise InputError(
            f"pixel {column},{row} is outside the frame: give 0,0 (bottom left) to "
            f"{raster.width - 1},{raster.height - 1}"
        )
    indices = np.array([column]), np.array([row])
    look: dict[str, Any] = {"shading": word(shading, "shading", SHADINGS)}
    names, still = ("position", "normal", "combined", "depth"), window_of(camera, *indices)
    passes = *PROBED, *names
    hits = hits_at(make_plan(still, shapes, Request(passes, **look)), *indices)
    values = stored(hits, passes)
    seen = probe_of(camera, shapes, column, row, values)
    point, normal, color, depth = (values[name][0, 0] for name in names)
    steps, met = [*_raster(camera, seen), ("Model", tuple(_formula(camera, seen)))], []
    if isinstance(camera.model, RealLens):
        steps.append((GLASS, tuple(refraction_lines(camera.model, column + 0.5, row + 0.5))))
    if np.isnan(seen.direction).any():
        steps.append(("Ray", ("none: the model has no ray for this pixel",)))
    else:
        met = meetings(camera, shapes, seen.origin, seen.direction)
        steps += [("Ray in the world", _world(camera, seen)), ("Shapes on the line of the ray", tuple(_shapes(met)))]
        steps.append(("Seen", _seen(seen, point, normal, depth)))
    lines, mean = list(color_lines(HitValues(hits), color)), color
    if samples > 1:
        mean = None
        if samples <= max_samples:
            images = cast(
                still, shapes, passes="combined", dtype=np.float64, samples=samples, progress=progress, **look
            )
            mean = images["combined"][0, 0]
        lines.append(_mean(camera, samples, mean))
    steps.append(("Color", tuple(lines)))
    if seen.shape_index < 0:
        point = normal = None
    formula = tuple(step.symbols for step in camera.model.steps)
    return Lesson(seen, tuple(steps), tuple(met), point, normal, mean, camera.model.label, formula)


def _seen(seen: Probe, point: np.ndarray, normal: np.ndarray, depth: float) -> tuple[str, ...]:
    if seen.shape_index < 0:
        return ("nothing",)
    return (
        f"{seen.name!r}, shape_index {seen.shape_index}",
        f"point o + t r = {shown(point)}, distance {digits(seen.distance, count=9)}, depth {digits(depth, count=9)}",
        f"unit normal, turned towards the ray {shown(normal)}",
    )


def _mean(camera: Camera, samples: int, mean: np.ndarray | None) -> str:
    over = "the pixel" if camera.aperture is None else "the pixel and the aperture"
    mean_text = "too many to cast here" if mean is None else shown(mean)
    return f"the steps follow the chief ray; the picture has the mean of {samples} rays over {over}: {mean_text}"


def _raster(camera: Camera, seen: Probe):
    (column, row), raster = seen.pixel, camera.raster
    width, height = raster.width, raster.height
    x, y = column + 0.5, row + 0.5
    where = f"({column}, {row}) of {width} × {height}, from the bottom left"
    yield "Pixel", (where, f"its center: x = {x:g}, y = {y:g}")
    sides = zip("xy", "WH", (x, y), (width, height), seen.view, strict=True)
    lines = (f"2 {name}/{side} - 1 = 2 · {pixel:g}/{count} - 1 = {digits(coordinate)}"
             for name, side, pixel, count, coordinate in sides)  # fmt: skip
    yield f"View coordinates {NORMALIZED}", tuple(lines)


def _formula(camera: Camera, seen: Probe):
    """Yield the steps of the model's formula, with and without numbers, and the ray in the camera's frame."""
    model = camera.model
    x, y = seen.pixel[0] + 0.5, seen.pixel[1] + 0.5
    yield model.label
    with np.errstate(all="ignore"):  # the pixel may have no ray
        values, moved = model.formula_values(x, y), {}
    values = {name: number for name, number in values.items() if np.isfinite(number).all()}
    if values:
        yield f"with {', '.join(f'{name} = {shown(number)}' for name, number in values.items())}"
    lens = lens_of(model)
    if isinstance(lens, WindowModel):
        plane = lens.window.plane_from_pixels(x, y)
        pitch = lens.window.pitch_x, lens.window.pitch_y
        moved = {name: 2 * X / (q * side) for name, X, q, side in zip("xy", plane, pitch, model.size, strict=True)}
    formulas = [(step.symbols, moved if NORMALIZED in step.words else {}) for step in model.steps]
    noise = dict.fromkeys(values, NOISE)
    for step, lines in zip(model.steps, worked_out(formulas, _known(camera, x, y) | values, noise), strict=True):
        yield f"{step.words}: {step.symbols}"
        yield from (f"  {line}" for line in lines)
    with np.errstate(all="ignore"):  # NaN means: no ray
        origin, direction = (np.array([float(component) for component in v]) for v in camera.camera_rays(x, y))
    if np.isnan(direction).any():
        return
    if isinstance(lens, WindowModel):
        yield f"on the image plane: ({digits(plane[0])}, {digits(plane[1])})"
    yield f"in the camera's frame (x right, y up, -z ahead): origin {shown(origin)}"
    length = float(np.linalg.norm(direction))
    angle = np.degrees(np.arctan2(np.hypot(*direction[:2]), -direction[2]))
    yield f"direction {shown(direction)}, of length {digits(length)}; {digits(angle)}° from the axis"


def _known(camera: Camera, x: float, y: float) -> dict[str, Any]:
    """Return the values of the names in a model's formula. Settings are also known without their prefixes."""
    model, raster = lens_of(camera.model), camera.raster
    facts: dict[str, Any] = dict(model.facts())
    numbers = {name: number for name, number in (camera.settings | facts).items() if type(number) in (int, float)}
    known: dict[str, Any] = dict(zip("uvw", np.diag([1.0, 1.0, -1.0]), strict=True))
    known |= {"e": np.zeros(3), "eye": np.zeros(3)}
    for name, number in reversed(numbers.items()):
        parts = name.split("_")
        known |= {"_".join(parts[start:]): number for start in range(1, len(parts))}
    known |= numbers
    known |= {"pi": np.pi, "W": raster.width, "H": raster.height, "x": x, "y": y, "p": raster.pixel_aspect}
    if "field_of_view" in facts:
        known["fov"] = np.radians(facts["field_of_view"][0])
    if model.K is not None:
        (known["fx"], known["skew"], known["cx"]), (_, known["fy"], known["cy"]), _ = model.K
    if isinstance(model, Calibrated):
        calibration = Calibration.from_blender(camera.record, raster, settings=PRINCIPAL_POINT)
        known |= dict(zip(("x_0", "y_0", "s_x", "s_y"), calibration.center + calibration.scale, strict=True))
    film = Film.from_blender(camera.record, raster)
    return known | {"sensor": film.size, "V": film.fitted_pixels}


def _world(camera: Camera, seen: Probe) -> tuple[str, ...]:
    u, v, z = camera.pose.basis.T
    return (
        f"eye = {shown(camera.pose.eye)}",
        f"u = {shown(u)}",
        f"v = {shown(v)}",
        f"w = {shown(-z)}",
        f"o = {shown(seen.origin)}",
        f"r = {shown(seen.direction)}, of length 1",
    )


def _shapes(met: list[Meeting]):
    """Yield lines on each shape that the ray's line intersects, with the visible point marked."""
    first = nearest(met)
    if not met:
        yield "none"
    for meeting in met:
        yield f"{meeting.name!r}, shape {meeting.shape}"
        yield from (f"  {line}" for line in meeting.equation)
        for crossing in meeting.places:
            face = f"{crossing.face}; " if crossing.face else ""
            is_seen = first is not None and crossing is first[1]
            why = crossing.objection or ("seen: the nearest that counts" if is_seen else "hidden behind the nearest")
            yield f"  t = {digits(crossing.t, count=9)}: {face}{why}"
