"""The points of a cast: of a scanner or of any other camera, with the errors of a device by choice.

The sensor's axes are x ahead, y to the left, z up; a scanner that moves has them where each beam fired,
as a real one's raw points. In the world points lie where they were hit.
The strength of a return is proportional to the cosine of the angle of incidence over the square of the range. Returns
weaker than that of a surface perpendicular to the beam at a chosen range are lost at random. Ranges have Gaussian
noise. Noise and losses depend only on the seed, the frame and the number of the pixel. ``true_range`` is the range
without noise.
Reference: W. Wagner et al., Gaussian decomposition and calibration of a full-waveform airborne scanner (2006), the
radar equation.
"""

import os
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .. import arguments
from ..any_rays.door import RayImages, RayPattern
from ..camera.camera import Camera
from ..cameras.scanner import Scanner
from ..casting.hits import NOTHING
from ..motion.moments import check_rows
from ..records import InputError, Shapes
from ..scene import Scene
from .cloud_beams import CameraBeams, CloudBeams, RayBeams
from .patterns import SCANNED, pattern_in

MOST_CATEGORY = np.iinfo(np.int32).max

SENSOR, WORLD = "sensor", "world"
AXES = SENSOR, WORLD
"""Frames of points in files."""

LARGEST = 1e12
"""Largest noise, in Blender units."""

LEAST_STEP = 1 / LARGEST
"""Least step of ranges; smaller steps have no effect."""

OF_DEVICE = "DEVICE"
"""The quantum of the scanner's device."""


@dataclass(frozen=True, eq=False)
class PointCloud:
    """Points in the order in which they are measured: column by column, from the lowest row up; (n,) arrays."""

    name: str
    """Name of the camera."""
    pose: np.ndarray
    """(4, 4): from the sensor's axes to the world, at the frame of the cloud."""
    size: tuple[int, int]
    """Columns and rows of the picture."""
    sensor: np.ndarray
    """(n, 3) in the sensor's axes, with noise; ``world`` in the world."""
    world: np.ndarray
    normal: np.ndarray
    """(n, 3), world: the unit normals of surfaces, towards the sensor; in ``sensor_normal`` in its axes."""
    sensor_normal: np.ndarray
    range: np.ndarray
    """Distance from the origin of the beam, with noise."""
    true_range: np.ndarray
    row: np.ndarray
    """int32: the row of the picture, from the bottom, and in ``column`` its column."""
    column: np.ndarray
    ring: np.ndarray
    """uint16: the number of the beam, as the device's own files count; of other cameras, the row."""
    time: np.ndarray
    """Seconds after the frame of the cloud; 0 where all is seen at once."""
    instance: np.ndarray
    """int32: the row of the shape in ``Shapes``, counted from 1."""
    category: np.ndarray
    """int32: by name of the object, or its pass index."""
    incidence: np.ndarray
    """Cosine of the angle between beam and normal."""
    reflectance: np.ndarray
    """incidence × albedo, the mean of its three channels; not the intensity that a device measures."""
    meters: float = 1.0
    """Length of a Blender unit, in which the lengths are, in meters."""

    def __len__(self) -> int:
        return len(self.range)

    def __repr__(self) -> str:
        return f"<PointCloud {self.name!r}: {len(self)} points>"


def scan(
    camera: Camera | Scene | None = None,
    shapes: Shapes | None = None,
    *,
    rays=None,
    times=None,
    rings=None,
    pose=None,
    name: str = "rays",
    fps: float = 24.0,
    noise: float = 0.0,
    dropout: float = 0.0,
    quantum: float | str = 0.0,
    seed: int = 0,
    categories: Mapping[str, int] | None = None,
) -> PointCloud:
    """Return the points that rays hit, with range, ring, time, labels, normal and incidence.

    camera: as in ``cast``; each pixel's chief ray is a beam.
    rays: in place of a camera, any pattern: origins and directions as in ``cast_rays``, with ``shapes=`` beside them,
        or the result of ``cast_rays``, or the path of a file of PROGRAMS, which has times and perhaps rings. Points
        have the order of the rays; rays of one axis are one row.
    times, rings: of ``rays``: frames, as in ``cast_rays``, and whole numbers; they broadcast with the rays. The cloud's
        frame is the earliest. Without rings each row has its own.
    pose: of the sensor that has ``rays``, as of a camera, (4, 4). Without it the sensor has the world's axes, and lies
        where the rays begin, or at the world's origin if they begin in several places. Rays of a file are the sensor's.
    name, fps: of a cloud of ``rays``: its name, and the frames per second, by which times become seconds.
    noise: standard deviation of the ranges, in Blender units.
    dropout: range up to which a surface perpendicular to the beam always returns it. In general a return is lost with
        the probability 1 - cos(incidence) (dropout / range)², if this is above 0; with 0 none is lost.
    quantum: step to which ranges are rounded, in Blender units; 0: they are not rounded. "DEVICE" is the step of the
        scanner's device; an Ouster's ranges, and so its steps, count from a point behind the origins of its beams.
    seed: seed of noise and losses, a whole number, 0 or more.
    categories: numbers by names of objects; other objects have their pass index.

    Raises InputError for numbers that are negative or not finite, for categories that are not whole numbers, for a
    device whose quantum is not known, for shapes that appear or disappear between the times of pixels, and for what
    ``cast`` refuses.
    """
    noise = arguments.number(noise, "noise", LARGEST, 0.0)
    dropout = arguments.number(dropout, "dropout", LARGEST, 0.0)
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or seed < 0:
        raise InputError(f"seed is {arguments.shown(seed)}: it must be a whole number, 0 or more")
    categories = {} if categories is None else categories
    if not (isinstance(categories, Mapping) and all(map(_is_category, categories.values()))):
        raise InputError(
            f"categories is {arguments.shown(categories)}: it must map names of objects to whole numbers from 0 to "
            f"{MOST_CATEGORY}"
        )
    beams: CloudBeams
    if rays is None:
        scene = Scene.given(camera, shapes, "scan")  # type: ignore[arg-type]  # it refuses None
        shapes, (step, behind) = scene.shapes, _steps(scene.camera, quantum)
        check_rows(shapes)
        beams = CameraBeams.of(scene.camera, shapes)
    else:
        (step, behind), rate = _steps(None, quantum), arguments.number(fps, "fps", LARGEST, LEAST_STEP)
        rays = pattern_in(os.fspath(rays), pose, rate) if isinstance(rays, str | os.PathLike) else rays
        pattern, shapes = _given(rays, times, rings, camera, shapes)
        check_rows(shapes)
        beams = RayBeams.of(pattern, shapes, arguments.name(name), pose, rate)
    images, frame = beams.images, beams.frame
    hit = (images["shape_index"] != NOTHING) & np.isfinite(images["distance"])
    ahead, true = np.where(hit[..., None], beams.directions, 0.0), np.where(hit, images["distance"], 0.0)
    incidence = np.clip(-(ahead * images["normal"]).sum(axis=-1), 0.0, 1.0)
    rng = np.random.default_rng((int(seed), round(frame * 1000) % (1 << 32)))
    away, chance = rng.normal(0.0, 1.0, hit.shape), rng.uniform(size=hit.shape)
    if dropout:
        hit &= chance * true**2 < incidence * dropout**2
    measured = true + noise * away
    if step:
        measured = step * np.rint((measured + behind) / step) - behind
    hit &= measured > 0
    at = beams.places(hit)
    origin, beam = beams.rays(at)
    normal = images["normal"][at]
    return PointCloud(
        name=beams.name,
        pose=beams.pose,
        size=hit.shape[::-1],
        sensor=origin + measured[at][:, None] * beam,
        world=images["position"][at] + (measured - true)[at][:, None] * beams.directions[at],
        normal=normal,
        sensor_normal=beams.turned(at, normal),
        range=measured[at],
        true_range=true[at],
        row=at[0].astype(np.int32),
        column=at[1].astype(np.int32),
        ring=beams.rings(at),
        time=beams.seconds(at),
        instance=(images["shape_index"][at] + 1).astype(np.int32),
        category=_categories(shapes, images["shape_index"][at], images["object_index"][at], categories),
        incidence=incidence[at],
        reflectance=incidence[at] * images["albedo"][at].mean(axis=-1),
        meters=beams.meters,
    )


scan.__doc__ = (scan.__doc__ or "").replace("PROGRAMS", SCANNED)


def _given(rays, times, rings, camera, shapes) -> tuple[RayPattern, Shapes]:
    """Return the rays of a cloud, and the shapes at which they are cast."""
    if isinstance(rays, RayImages):
        if rays.rays is None:
            raise InputError("all hits of rays are no cloud: cast the rays without all_hits")
        pattern, shapes = rays.rays, rays.shapes if shapes is None else shapes
    elif isinstance(rays, RayPattern):
        pattern = rays
    else:
        try:
            origins, directions = (rays.origins, rays.directions) if hasattr(rays, "origins") else rays
        except (TypeError, ValueError) as error:
            raise InputError("rays must be origins and directions, or the result of cast_rays") from error
        pattern = RayPattern(origins, directions)
    shapes = camera if shapes is None else shapes
    if not isinstance(shapes, Shapes) or not (camera is None or camera is shapes):
        raise InputError("scan takes a camera or rays: give rays= and shapes=")
    times, rings = (old if new is None else new for old, new in ((pattern.times, times), (pattern.rings, rings)))
    return pattern._replace(times=times, rings=rings), shapes


def _steps(camera: Camera | None, quantum) -> tuple[float, float]:
    """Return the step of ranges, and how far behind the origins of beams these begin."""
    if not (isinstance(quantum, str) and quantum.upper() == OF_DEVICE):
        step = arguments.number(quantum, "quantum", LARGEST, 0.0)
        return (step if step >= LEAST_STEP else 0.0), 0.0
    if camera is None:
        raise InputError("the quantum of rays is not known: give a length")
    device = camera.model.device if isinstance(camera.model, Scanner) else None
    if device is None or not device.quantum:
        kind = camera.model.label if device is None else device.label
        raise InputError(
            f"the quantum of camera {camera.name!r}, a {kind}, is not known: give a length, or choose a scanner_device "
            "of Velodyne or Ouster"
        )
    return device.quantum, device.behind


def _is_category(value) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool) and 0 <= int(value) <= MOST_CATEGORY


def _categories(shapes: Shapes, shape, index, categories: Mapping[str, int]) -> np.ndarray:
    by_name = np.array([categories.get(name, NOTHING) for name in shapes.names] or [NOTHING])
    category = by_name[shapes.name_index[shape]]
    return np.where(category == NOTHING, index, category).astype(np.int32)
