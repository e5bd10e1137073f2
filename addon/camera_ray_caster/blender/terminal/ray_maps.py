"""Ray maps: the rays of a camera that stands still are written once, and its frames leave them out of their files."""

import hashlib
from dataclasses import replace

import numpy as np

from ...core.camera.camera import Camera
from ..output.stamps import finished
from .jobs import PictureJob, RayMap

PASSES = "ray_origin", "ray_direction"


def digest_of(camera: Camera) -> str:
    """Return the SHA-256 of a camera's rays and their times; cameras with equal rays have equal digests."""
    rays, digest = camera.rays(), hashlib.sha256()
    for array in (rays.origins, rays.directions, rays.time):
        if array is not None:
            digest.update(np.ascontiguousarray(array))
    return digest.hexdigest()


def made_map(pictures, first: PictureJob, stamp: dict) -> RayMap | None:
    """Return the ray map of a camera, whose first job is ``first``; make the map from that job if it is missing.

    Return None if no map is useful: in a multi-view scene, or unless every view layer has ray passes and other passes.
    """
    asked = [set(keys) for keys in pictures.passes.values()]
    if pictures.scene.render.use_multiview or not all(keys & set(PASSES) and keys - set(PASSES) for keys in asked):
        return None
    name = first.name.rpartition("_")[0] + "_rays"
    file = f"{name}.{pictures.options.format.lower()}"
    of = {**stamp, "camera": first.camera, "frame": None}
    content = finished(pictures.options.output / f"{name}.json", of)
    if content is not None:
        return RayMap(file, content["made"]["of"]["rays"])
    digest = digest_of(pictures.camera_at(first))
    pictures.tick(PASSES.__contains__)
    pictures.render(replace(first, name=name, report=name), {**of, "rays": digest}, shown=False)
    return RayMap(file, digest)
