"""The report of a run: errors with their bounds, seconds of each step, omissions. One record, three output forms."""

import json
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, replace
from textwrap import shorten, wrap
from typing import Any, Self

import numpy as np

from ..camera.camera import Camera
from ..camera.facts import CONVENTIONS, camera_facts
from ..camera.pixel_time import ImageTime
from ..casting.images import Images
from ..casting.pass_needs import has_colors
from ..casting.tiles import TIMED_STEPS
from ..conventions import EPS32
from ..exports.camera_json import recorded
from ..exports.json_values import differing, plain
from ..records import Finding, Shapes
from ..version import VERSION
from .accuracy import QUANTITIES, Accuracy
from .indices import indices_of
from .omitted import omitted
from .pass_notes import camera_notes, sentences

WIDTH = 100
"""Maximum width of the table in columns."""
MOST_NUMBERS = 3 * 25_000
"""Numbers of the largest table of rays in the record of a report: as text, of which each picture has one, some 4 MB."""
VALUE_COLUMN = 23
"""Column in which the values of a camera's facts begin."""
SIZES = [f"{size}_{unit}" for unit in ("pixels", "radians") for size in ("worst", "median", "bound")]
CAST_STEPS = ("plan", *TIMED_STEPS)
"""Steps that count for rays per second: from camera and shapes to finished arrays."""


@dataclass(frozen=True)
class Report:
    """Record of the work for one frame, all of its view layers and eyes together."""

    camera: Mapping[str, Any]
    """See ``camera_facts``."""
    frame: float
    layers: tuple[str, ...] = ()
    passes: tuple[str, ...] = ()
    combined: Mapping[str, Any] = field(default_factory=dict)
    """Source of the combined pass: the engine, its samples per pixel, and the device if the engine is not ours."""
    shapes: int = 0
    pixels: int = 0
    rays: int = 0
    """Chief rays of pixels, and their samples."""
    seconds: Mapping[str, float] = field(default_factory=dict)
    """Duration of each step, in the order of execution."""
    findings: tuple[Finding, ...] = ()
    not_done: tuple[str, ...] = ()
    """Work that the cast did not need to do, with reasons."""
    left_out: tuple[tuple[str, str], ...] = ()
    """Objects that were not cast, each with the reason."""
    notes: tuple[tuple[str, str], ...] = ()
    """Objects and materials that passes show otherwise than a reader may expect: see ``Shapes``."""
    exact: tuple[tuple[str, float], ...] = ()
    """Objects whose mesh is a sphere or plane and was cast as such: see ``Shapes``."""
    motion: tuple[str, ...] = ()
    """For pixels with their own times: the number of evaluations of the scene, and the accuracy between them."""
    accuracy: Accuracy = field(default_factory=Accuracy)
    """Error bounds of the hits."""
    file_outputs: tuple[str, ...] = ()
    """Paths of the files that the compositor's File Output nodes wrote."""
    warnings: tuple[str, ...] = ()
    """Requests of the file that were not carried out; a terminal shows them separately."""
    host: Mapping[str, Any] = field(default_factory=dict)
    """``blender``: Blender's version; ``meters``: length of a Blender unit in meters."""
    record: Mapping[str, Any] | None = None
    """Record of the camera for ``camera_from_json``: see ``recorded``; None if its pixel times are an image, or if its
    table of rays has more than MOST_NUMBERS.
    """
    views: Mapping[str, Any] = field(default_factory=dict)
    """The suffix of files, the facts of the camera and the entries of ``record`` of each view of a stereo scene, by the
    view's name; {} otherwise.
    """
    indices: Mapping[str, Any] = field(default_factory=dict)
    """Meanings of the numbers in the index passes, by view layer: see ``indices_of``."""
    made: Mapping[str, Any] = field(default_factory=dict)
    """``of``: the frame's sources; ``files``: files next to the report, in bytes; ``rows``: the first of NPZ arrays."""

    @property
    def rays_per_second(self) -> float | None:
        """Number of rays divided by the seconds of CAST_STEPS; None without rays."""
        spent = sum(self.seconds.get(step, 0.0) for step in CAST_STEPS)
        return self.rays / spent if self.rays and spent > 0 else None

    @property
    def passed(self) -> bool:
        """Whether all comparisons with references have passed."""
        return all(finding.passed for finding in self.findings)

    @property
    def verdict(self) -> str:
        """Whether all comparisons with references have passed, in words."""
        failed = "A reference check failed: the rays differ by more than its error bound"
        return "All reference checks passed" if self.passed else failed

    def with_seconds(self, **seconds: float) -> Self:
        """Return the report with these steps added; the seconds of a step that it already has are summed."""
        return replace(self, seconds=_sum(self.seconds, seconds))

    def __add__(self, other: Self) -> Self:
        """Return the report of both: another view layer or eye of the same frame. The camera is that of ``self``; eyes
        see the same shapes.
        """
        united = "layers", "passes", "findings", "not_done", "left_out", "notes", "exact", "motion", "warnings"
        unions: dict[str, Any] = {name: _union(getattr(self, name), getattr(other, name)) for name in united}
        return replace(
            self,
            **unions,
            shapes=max(self.shapes, other.shapes) if self.layers == other.layers else self.shapes + other.shapes,
            pixels=self.pixels + other.pixels,
            rays=self.rays + other.rays,
            seconds=_sum(self.seconds, other.seconds),
            accuracy=self.accuracy + other.accuracy,
            views={**self.views, **other.views},
            indices={**self.indices, **other.indices},
        )


def report_cast(
    camera: Camera,
    shapes: Shapes,
    images: Images,
    seconds: Mapping[str, float],
    findings: Iterable[Finding],
    frame: float,
    layer: str,
    several: bool = False,
    *,
    accuracy: Accuracy,
    host: Mapping[str, Any] | None = None,
) -> Report:
    """Return the report of one cast of a view layer; if ``several``, ``not_done`` has the layer's name."""
    motion, pixels = camera.motion, camera.raster.shape[0] * camera.raster.shape[1]
    return Report(
        camera=camera_facts(camera),
        frame=frame,
        layers=(layer,),
        passes=images.plan.request.passes,
        shapes=len(shapes),
        pixels=pixels,
        rays=images.rays,
        seconds=seconds,
        findings=tuple(findings),
        not_done=tuple(f"{layer}: {line}" if several else line for line in omitted(images.plan)),
        left_out=(*shapes.left_out, *uncolored(shapes, images.plan.request.passes)),
        notes=(*camera_notes(camera), *shapes.notes, *accuracy.notes(pixels)),
        exact=_union(shapes.exact, ()),
        motion=tuple(motion.in_words()) if motion is not None else (),
        accuracy=accuracy,
        host=host or {},
        record=recorded(camera) if _has_record(camera) else None,
        indices={layer: indices_of(shapes)},
    )


def _has_record(camera: Camera) -> bool:
    tables = (value for value in camera.record.settings.values() if isinstance(value, np.ndarray))
    return not isinstance(camera.pixel_time, ImageTime) and all(table.size <= MOST_NUMBERS for table in tables)


def uncolored(shapes: Shapes, passes: Collection[str]) -> Iterator[tuple[str, str]]:
    """Yield what is left out of the colors of passes: materials and lights, each with the reason."""
    if has_colors(passes):
        yield from shapes.unread
    if "combined" in passes:
        yield from shapes.lights.left_out


def as_data(report: Report) -> dict:
    """Return the report as plain lists, dicts, strings and numbers; a number that is not finite becomes None."""
    data = {"version": VERSION, "conventions": CONVENTIONS, **vars(report)}
    data["accuracy"] = report.accuracy.as_data()
    data |= {name: getattr(report, name) for name in ("rays_per_second", "passed")}
    data["findings"] = [{**asdict(finding), "passed": finding.passed} for finding in report.findings]
    data["left_out"] = [{"name": name, "reason": reason} for name, reason in report.left_out]
    data["notes"] = [{"name": name, "note": note} for name, note in report.notes]
    data["noted"] = sentences(report.notes, report.exact)
    data["exact"] = [{"name": name, "apart": apart} for name, apart in report.exact]
    return plain(data, lambda number: None)


def as_json(report: Report, common: Mapping[str, Any] | None = None) -> str:
    """Return the report as strict JSON, bytes that are not UTF-8 escaped; compact, and without what ``common`` has."""
    data = differing(as_data(report), common or {})
    how: dict[str, Any] = {"indent": 2} if common is None else {"separators": (",", ":")}
    text = json.dumps(data, allow_nan=False, ensure_ascii=False, **how) + "\n"
    return text.encode(errors="backslashreplace").decode()


def as_lines(report: Report) -> list[str]:
    """Return the report as the lines of a table, at most WIDTH columns: for a terminal or a text datablock."""
    return [
        *_camera_lines(report),
        *_finding_lines(report),
        *_accuracy_lines(report),
        *_second_lines(report),
        *_exact_lines(report),
        *_listed("Warnings", report.warnings),
        *_listed("Noted", sentences(report.notes, report.exact)),
        *_listed("Motion", report.motion),
        *_listed("Written by File Output nodes", report.file_outputs),
        *_listed("Left out", [*report.not_done, *(f"{name!r}: {reason}" for name, reason in report.left_out)]),
    ]


def _camera_lines(report: Report) -> list[str]:
    facts = dict(report.camera)
    title = f"Camera {facts.pop('name')!r}, {facts.pop('model')}, frame {report.frame:g}"
    formula = [f"{step['words']}: {step['symbols']}" for step in facts.pop("formula")]
    settings = ", ".join(f"{name} {_numbers(value)}" for name, value in facts.pop("settings").items())
    for name in ("key", "plane_from_pixels", "world_to_opencv"):  # derived from other facts in the table
        facts.pop(name, None)
    if settings and len(settings) <= WIDTH - VALUE_COLUMN:  # if they are few
        facts["settings"] = settings
    lines = [f"  {name.replace('_', ' '):{VALUE_COLUMN - 3}} {_numbers(value)}" for name, value in facts.items()]
    return [title, *lines, *_listed("Formula", formula)]


def _finding_lines(report: Report) -> list[str]:
    if not report.findings:
        return []
    columns = " ".join(f"{name:>9}" for name in ("worst px", "median", "bound", "worst rad", "median", "bound"))
    lines = ["", f"{'Reference check':25} {'points':>7} {columns}"]
    for finding in report.findings:
        name = shorten(finding.witness, 23, placeholder="…")
        if finding.not_compared:
            lines.append(f"  {name:23} not compared: {finding.not_compared}")
            continue
        cells = " ".join(f"{getattr(finding, size):9.1e}" for size in SIZES)
        lines.append(f"  {name:23} {finding.points:7} {cells} {'ok' if finding.passed else 'FAILED'}")
    return lines


def _accuracy_lines(report: Report) -> list[str]:
    sampled = report.accuracy
    if not sampled.pixels:
        return []
    if not sampled.hits:
        return ["", f"Hits: none at {sampled.pixels} pixels all over the picture, in float64"]
    lines = ["", f"{'Hits':19} {'median bound':>13} {'worst bound':>13}"]
    for name, unit in QUANTITIES.items():
        lines.append(f"  {name.replace('_', ' '):17} {sampled.median(name):13.1e} {sampled.worst(name):13.1e}  {unit}")
    lines.append(f"  {sampled.hits} hits at {sampled.pixels} pixels all over the picture, in float64")
    return [*lines, f"  before storage: storing as float32 adds a rounding of up to {EPS32:.0e} of the value"]


def _second_lines(report: Report) -> list[str]:
    if not report.seconds:
        return []
    lines = ["", f"{'Step':18} {'seconds':>9}"]
    lines += [f"  {step:16} {seconds:9.4f}" for step, seconds in report.seconds.items()]
    lines.append(f"  {'total':16} {sum(report.seconds.values()):9.4f}")
    if report.rays_per_second is not None:
        millions = report.rays_per_second / 1e6
        lines.append(f"  {report.rays} rays at {report.shapes} shapes: {millions:.3g} million rays per second")
    return lines


def _exact_lines(report: Report) -> list[str]:
    if not report.exact:
        return []
    name, apart = max(report.exact, key=lambda entry: entry[1])
    meshes = "1 mesh" if len(report.exact) == 1 else f"{len(report.exact)} meshes"
    text = f"{meshes} cast as spheres or planes, with a deviation of at most {apart:.2%} of the radius, in {name!r}"
    return _listed("Exact shapes", [text])


def _listed(title: str, texts) -> list[str]:
    lines = ["", title] if texts else []
    for text in texts:
        lines += wrap(text, WIDTH, initial_indent="  ", subsequent_indent="    ")
    return lines


def _numbers(value) -> str:
    """Return a fact as text: numbers aligned, a matrix on one line, row by row."""
    if isinstance(value, float):
        return f"{value:.7g}"
    if not isinstance(value, list):
        return str(value)
    if value and isinstance(value[0], list):
        return "  ".join("[" + " ".join(_numbers(entry) for entry in row) + "]" for row in value)
    return " ".join(f"{_numbers(entry):>12}" for entry in value)


def _sum(left: Mapping[str, float], right: Mapping[str, float]) -> dict[str, float]:
    return {step: left.get(step, 0.0) + right.get(step, 0.0) for step in _union(left, right)}


def _union(left: Iterable, right: Iterable) -> tuple:
    """Return the items of both, each once, in order."""
    return tuple(dict.fromkeys((*left, *right)))
