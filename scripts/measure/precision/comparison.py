"""The extreme cases in every tracer: errors compared with the exact picture, and their table."""

import sys

import numpy as np
from tests.core.errors.decisions import decision
from tests.core.truth import truth

from camera_ray_caster.core.shapes.in_camera import in_camera

from .tracers import TRACERS, Given

LIMITS = (1e-3, 1e-6, 1e-12)
PIXELS = 25


def rays_of(case):
    """Return the exact rays and distances of a case's pixels, without pixels that rounding in float64 could decide."""
    camera, shapes = case.camera, case.shapes
    height, width = camera.raster.shape
    placed = in_camera(shapes, camera.pose)
    flat = np.unique(np.linspace(0, height * width - 1, PIXELS).round().astype(int))
    pixels, rays, starts, distances = [], [], [], []
    for j, i in zip(*np.unravel_index(flat, (height, width)), strict=True):
        x, y = camera.raster.columns()[0, i], camera.raster.rows()[j, 0]
        ray = truth.ray(case.raw, x, y)
        sure = (decision(camera, placed, k, np.array([[x]]), np.array([[y]])) for k in range(len(shapes)))
        if ray is None or any(abs(value[0, 0]) <= bound[0, 0] for value, bound in sure):
            continue
        hit = truth.nearest(shapes, ray, camera.clip_start, camera.clip_end)
        pixels.append((j, i))
        rays.append(([float(v) for v in ray.origin], [float(v / ray.length) for v in ray.direction]))
        starts.append(float(camera.clip_start * ray.length))
        distances.append(np.inf if hit is None else float(hit.distance))
    origins, directions = (np.array([ray[vector] for ray in rays]).reshape(-1, 3) for vector in (0, 1))
    return Given(pixels, origins, directions, np.array(starts)), np.array(distances)


def error_of(distances, exact) -> float:
    """Return the worst relative error of the distances, or inf if any hit or miss is wrong."""
    if (np.isinf(distances) != np.isinf(exact)).any():
        return np.inf
    hit = np.isfinite(exact)
    return float((np.abs(distances - exact)[hit] / exact[hit]).max(initial=0.0))


def judged(tracer, case, rays, exact):
    """Return the error of a tracer on a case, or None if the case cannot be set up."""
    with np.errstate(all="ignore"):
        try:
            distances = tracer(case, rays)
        except (RuntimeError, ValueError, OverflowError) as refusal:
            print(f"  refused: {str(refusal).splitlines()[0]}", file=sys.stderr)
            return None
        return None if distances is None else error_of(distances, exact)


def compared(cases):
    """Return the names of the cases with decided pixels, and each tracer's errors on these cases.

    For a tracer that is not installed, a message with the missing package replaces the errors.
    """
    cases_with_rays = [(case, *rays_of(case)) for case in cases]
    cases_with_rays = [(case, rays, exact) for case, rays, exact in cases_with_rays if rays.pixels]
    errors = {}
    for name, tracer in TRACERS.items():
        try:
            errors[name] = [judged(tracer, *case_rays) for case_rays in cases_with_rays]
        except ModuleNotFoundError as missing:
            errors[name] = f"not installed: {missing.name.split('.')[0]}"
    return [case.name for case, *_ in cases_with_rays], errors


def table(names, errors_of) -> str:
    """Return a Markdown table of the number of cases that each tracer gets right, by error limit."""
    to = (f"and distances to {limit:g}" for limit in LIMITS)
    heads = (f"of {len(names)} extreme cases", "can be set up", "every hit and miss right", *to, "their median error")
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    for tracer, errors in errors_of.items():
        if isinstance(errors, str):
            lines.append(f"| {tracer} | {errors} |" + " – |" * (len(heads) - 2))
            continue
        tried = [error for error in errors if error is not None]
        right = [error for error in tried if np.isfinite(error)]
        within = " | ".join(str(sum(error <= limit for error in right)) for limit in LIMITS)
        middle = f"{np.median(right):.0e}" if right else "–"
        lines.append(f"| {tracer} | {len(tried)} | {len(right)} | {within} | {middle} |")
    return "\n".join(lines)


def details(names, errors_of) -> str:
    """Return a Markdown table of each tracer's worst error on each case; inf if any hit or miss is wrong."""
    lines = ["| case | " + " | ".join(errors_of) + " |", "|---" * (len(errors_of) + 1) + "|"]
    for k, name in enumerate(names):
        cells = (errors if isinstance(errors, str) else _cell(errors[k]) for errors in errors_of.values())
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _cell(error) -> str:
    return "not possible" if error is None else f"{error:.0e}"
