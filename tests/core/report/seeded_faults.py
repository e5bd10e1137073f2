"""Cameras with one thing wrong each, made of a right one: what verification has to find."""

from dataclasses import replace

import numpy as np

from camera_ray_caster.core.camera.build import camera_from


class Bent:
    """A camera whose pixel coordinates are wrong: it gives the rays of ``bend(x, y)``; ``back`` undoes that."""

    def __init__(self, camera, bend, back):
        self.camera, self.bend, self.back = camera, bend, back
        self.raster = camera.raster

    def __getattr__(self, name):
        return getattr(self.camera, name)

    def rays_at(self, x, y):
        return self.camera.rays_at(*self.bend(np.asarray(x), np.asarray(y)))

    def project(self, points):
        return np.stack(self.back(*np.moveaxis(self.camera.project(points), -1, 0)), axis=-1)


class EdgesForCenters:
    """A raster that takes the left edge of a pixel for its center."""

    def __init__(self, raster):
        self.raster = raster

    def __getattr__(self, name):
        return getattr(self.raster, name)

    def columns(self):
        return self.raster.columns() - 0.5


def half_a_pixel_in_x(raw):
    return Bent(camera_from(raw), lambda x, y: (x + 0.5, y), lambda x, y: (x - 0.5, y))


def half_a_pixel_in_y(raw):
    return Bent(camera_from(raw), lambda x, y: (x, y - 0.5), lambda x, y: (x, y + 0.5))


def edges_for_centers(raw):
    camera = camera_from(raw)
    return replace(camera, raster=EdgesForCenters(camera.raster))


def y_down(raw):
    camera = camera_from(raw)
    return Bent(camera, lambda x, y: (x, camera.raster.height - y), lambda x, y: (x, camera.raster.height - y))


def sensor_height_in_portrait(raw):
    return camera_from(replace(raw, sensor_width=raw.sensor_height))


def shift_by_the_height(raw):
    raster = camera_from(raw).raster
    wrong = raster.height / max(raster.width, raster.height * raster.pixel_aspect)
    return camera_from(replace(raw, shift_x=raw.shift_x * wrong, shift_y=raw.shift_y * wrong))


def frame_without_percentage(raw):
    """The frame's sides in the proportion before they are truncated."""
    full, cut = camera_from(replace(raw, resolution_percentage=100, use_border=False)), camera_from(raw)
    x_scale, y_scale = full.raster.width / cut.raster.width, full.raster.height / cut.raster.height
    bent = Bent(full, lambda x, y: (x * x_scale, y * y_scale), lambda x, y: (x / x_scale, y / y_scale))
    bent.raster = cut.raster
    return bent


def percentage_rounded(raw):
    sides = (round(side * raw.resolution_percentage / 100) for side in (raw.resolution_x, raw.resolution_y))
    width, height = sides
    return camera_from(replace(raw, resolution_x=width, resolution_y=height, resolution_percentage=100))


def pixel_aspect_ignored(raw):
    return camera_from(replace(raw, pixel_aspect_x=1.0, pixel_aspect_y=1.0))


def shear_normalized_away(raw):
    matrix = np.array(raw.matrix_world)
    matrix[:3, :3] = np.linalg.qr(matrix[:3, :3])[0] * np.sign(np.diag(np.linalg.qr(matrix[:3, :3])[1]))
    return camera_from(replace(raw, matrix_world=matrix))


FAULTS = (
    half_a_pixel_in_x,
    half_a_pixel_in_y,
    edges_for_centers,
    y_down,
    sensor_height_in_portrait,
    shift_by_the_height,
    frame_without_percentage,
    percentage_rounded,
    pixel_aspect_ignored,
    shear_normalized_away,
)

CASES = [
    (kind, fault)
    for kind in ("PERSP", "ORTHO")
    for fault in FAULTS
    if kind == "PERSP" or fault is not sensor_height_in_portrait  # parallel rays know no sensor
]
"""Each fault with the types of camera that can have it."""

BETWEEN_THE_CORNERS = (edges_for_centers, percentage_rounded)
"""Faults that leave the rays through the full frame's corners as they are, or move them little."""

HARD = {
    "resolution_x": 683,
    "resolution_y": 1001,
    "resolution_percentage": 67,
    "shift_x": 0.3,
    "shift_y": -0.2,
    "pixel_aspect_x": 1.0,
    "pixel_aspect_y": 1.25,
    "sensor_width": 36.0,
    "sensor_height": 24.0,
}
"""Settings (none of them a default) under which each fault shows: portrait, AUTO fit, a fraction lost by truncation."""
