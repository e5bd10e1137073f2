"""Methods whose precision depends on their effort: samples, evaluations in time, Newton steps, verified pixels."""

from dataclasses import replace
from functools import partial

import numpy as np
from tests.core.cameras.model_examples import camera as example
from tests.core.errors.extreme_cases import Case, shapes_of

from camera_ray_caster.core.cameras.parts.aperture import Aperture
from camera_ray_caster.core.cast import cast
from camera_ray_caster.core.maths.inversion import Inverse
from camera_ray_caster.core.motion.evaluations import measured, resolve
from camera_ray_caster.core.records import PLANE, SPHERE
from camera_ray_caster.core.report.verification import verify

from .points import Point, timed

SMALL = {"resolution_x": 48, "resolution_y": 48, "lens": 50.0, "clip_end": 1e3}
STILL = [(SPHERE, (0, 0, -5), 1.0), (SPHERE, (1.2, 0.6, -7), 1.0), (PLANE, (0, 0, -12), 6.0)]
SAMPLES = (1, 4, 16, 64, 256)
REFERENCE = 2048
TOLERANCES = (1.0, 0.03, 0.01, 1e-3)
FAULT = 0.5
"""Maximum error of the faulty camera's rays, in pixels."""


def sampled() -> list[Point]:
    """Measure thin lens and camera obscura by number of samples, compared with a picture of REFERENCE samples."""
    lens = replace(Case("", "", [], SMALL).camera, aperture=Aperture(0.05, 5.0))
    obscura = example("CAMERA_OBSCURA", {"resolution_x": 48, "resolution_y": 48, "obscura_hole": 0.05, "clip_end": 1e3})
    points = []
    for method, camera in (("thin lens", lens), ("camera obscura", obscura)):
        shapes, pixels = shapes_of(STILL), camera.raster.width * camera.raster.height
        picture = partial(_picture, camera, shapes)
        reference = picture(REFERENCE)
        results = timed([partial(picture, n) for n in SAMPLES], [pixels] * len(SAMPLES))
        for n, (image, seconds, spread) in zip(SAMPLES, results, strict=True):
            error = np.abs(image - reference).max(axis=-1)
            scene = str(n)
            points.append(
                Point("samples", scene, method, _mean_square(error), error.max(), "of white", seconds, spread)
            )
    return points


def _picture(camera, shapes, samples):
    return cast(camera, shapes, passes=("combined",), samples=samples)["combined"]


def _mean_square(error) -> float:
    """Return the root mean square error. The median would be 0, since half of the pixels show no edge."""
    return float(np.sqrt((error * error).mean()))


def evaluated() -> list[Point]:
    """Measure a slit scan with a swinging camera on a curve, evaluated as often as each tolerance requires."""
    still, shapes = Case("", "", [], SMALL).camera, shapes_of(STILL)

    def evaluate(frame):
        angle = 0.3 * np.sin(frame)
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        return replace(still, pose=replace(still.pose, basis=turn, eye=np.array([np.cos(frame / 2), 0, 0]))), shapes

    def resolved(tolerance):
        calls: list[float] = []
        return resolve(lambda frame: calls.append(frame) or evaluate(frame), 0.0, 20.0, tolerance, 4096), len(calls)

    frames = np.linspace(0, 20, 173)
    results = timed(
        [partial(resolved, tolerance) for tolerance in TOLERANCES],
        [still.raster.width * still.raster.height] * len(TOLERANCES),
    )
    points = []
    for tolerance, ((motion, calls), seconds, spread) in zip(TOLERANCES, results, strict=True):
        errors = [measured(motion, evaluate, [frame]).measured for frame in frames]
        scene = f"{tolerance:g} px: {calls}"
        points.append(Point("time", scene, "slit scan", np.median(errors), max(errors), "px", seconds, spread))
    return points


def stepped() -> list[Point]:
    """Measure Newton's method for theta = r + r^3 / 10: steps from r = theta, and the table with one step."""
    exact = np.linspace(1e-3, 1.2, 200_000)
    target = exact + exact**3 / 10

    def steps(count):
        r = target.copy()
        for _ in range(count):
            r -= (r + r * r * r / 10 - target) / (1 + 0.3 * r * r)
        return r

    table = Inverse(lambda r: r + r * r * r / 10, lambda r: 1 + 0.3 * r * r, 0.0, 1.3)
    counts = range(5)
    runs = [lambda n=n: steps(n) for n in counts] + [lambda: table(target)]
    names = [("Newton", f"{n}") for n in counts] + [("table and one step", "table")]
    points = []
    for (method, scene), (r, seconds, spread) in zip(names, timed(runs, [len(target)] * len(runs)), strict=True):
        error = np.abs(r - exact)
        points.append(Point("inverse", scene, method, np.median(error), error.max(), "rad", seconds, spread))
    return points


class Faulty:
    """A camera whose rays are up to FAULT pixels off around one position in the picture."""

    def __init__(self, camera):
        self.camera, self.raster, self.pose = camera, camera.raster, camera.pose
        self.project, self.pixel_rounding = camera.project, camera.pixel_rounding
        self.formula_reach = camera.formula_reach

    def rays_at(self, x, y):
        """Return the displaced rays."""
        width, height = self.raster.width, self.raster.height
        away = ((x - 0.62 * width) / (0.1 * width)) ** 2 + ((y - 0.36 * height) / (0.1 * height)) ** 2
        return self.camera.rays_at(x + FAULT * np.exp(-away), y)


def verified() -> list[Point]:
    """Measure the part of a fault of FAULT pixels that verification misses: corners, grids and every pixel."""
    side = 256
    camera = Faulty(Case("", "", [], SMALL | {"resolution_x": side, "resolution_y": side}).camera)
    grids = (2, 9, 33, 65, side)
    names = ["corners", *(f"{n} x {n}" for n in grids[1:-1]), "every pixel"]
    results = timed([lambda n=n: verify(camera, None, n) for n in grids], [side * side] * len(grids))
    points = []
    for scene, (findings, seconds, spread) in zip(names, results, strict=True):
        missed = FAULT - findings[-1].worst_pixels
        points.append(Point("verification", scene, "round trip", missed, missed, "px not seen", seconds, spread))
    return points


FAMILIES = {"samples": sampled, "time": evaluated, "inverse": stepped, "verification": verified}
"""Functions that measure each family of points, on its own scenes."""
