"""The rays of a camera that stands still, written once: frames with these rays leave them out of their own files."""

from __future__ import annotations

import hashlib
from dataclasses import replace

import numpy as np

from ...core.camera.camera import Camera
from ..output.stamps import finished
from .jobs import Job, RayMap

PASSES = "ray_origin", "ray_direction"


def digest_of(camera: Camera) -> str:
    """Return the SHA-256 of a camera's rays, with their times: equal of cameras whose rays are."""
    rays, found = camera.rays(), hashlib.sha256()
    for array in (rays.origins, rays.directions, rays.time):
        if array is not None:
            found.update(np.ascontiguousarray(array))
    return found.hexdigest()


def made_map(pictures, first: Job, stamp: dict) -> RayMap | None:
    """Return the map of the rays of a camera, which the job ``first`` of ``pictures`` is one of; make it there where
    it is missing. None where there is no use for one: no ray pass is asked for, or no other pass, or several eyes are.
    """
    asked = [set(keys) for keys in pictures.passes.values()]
    if pictures.scene.render.use_multiview or not all(own & set(PASSES) and own - set(PASSES) for own in asked):
        return None
    name = first.name.rpartition("_")[0] + "_rays"
    file = f"{name}.{pictures.options.format.lower()}"
    of = {**stamp, "camera": first.camera, "frame": None}
    found = finished(pictures.options.output / f"{name}.json", of)
    if found is not None:
        return RayMap(file, found["made"]["of"]["rays"])
    digest = digest_of(pictures.camera_at(first))
    pictures.tick(PASSES.__contains__)
    pictures.render(replace(first, name=name, report=name), {**of, "rays": digest}, shown=False)
    return RayMap(file, digest)
