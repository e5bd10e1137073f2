"""The poses of the cameras in Agisoft Metashape's XML files of projects.

A camera's transform leads from it, y down and z ahead, to its chunk; that of its component, or of the chunk, with a
scale, to the world. The world of a georeferenced chunk is that of the Earth's center: here it is a frame of east,
north and up about the middle of the cameras, on the WGS 84 ellipsoid. Cameras without a transform are left out: they
were not aligned, or are moved by a master.
References: Agisoft Metashape Python API, Chunk.transform and CoordinateSystem.localframe; B. Bowring, Transformation
from spatial to geographical coordinates (1976).
"""

from __future__ import annotations

from math import atan2, cos, hypot, sin

import numpy as np

from ..parts.xml_subset import Element
from .document import Document
from .metashape import all_of, named_sensors, root_of
from .placed import Placed, checked, pose_of

AXIS, FLATTENING = 6378137.0, 1 / 298.257223563
"""The larger half axis of the Earth, in meters, and the part of it by which the smaller one is shorter: WGS 84."""

GEOGRAPHIC = "GEOGCS", "PROJCS", "COMPD_CS", "GEOCCS"
"""Begins of the coordinate systems of the Earth, in OGC's words."""


def poses(document: Document) -> list[Placed] | None:
    """Return the poses of the aligned cameras in the order of the file; None of any other file. Raises InputError."""
    root = root_of(document)
    chunks = all_of(root, "chunk") if root is not None else []
    if root is None or not any(_child(one, "cameras") for one in chunks):
        return None
    names = {id(sensor): name for name, sensor in named_sensors(root)}
    placed: list[Placed] = []
    georeferenced = False
    for chunk in chunks:
        sensors = {one.attributes.get("id"): names.get(id(one), "") for one in all_of(chunk, "sensor")}
        own = {one.attributes.get("id"): _child(one, "transform") for one in all_of(chunk, "component")}
        cameras = _child(chunk, "cameras")
        for camera in all_of(cameras, "camera") if cameras is not None else ():
            document.check()
            transform, label = _child(camera, "transform"), camera.attributes.get("label", "")
            if transform is None:
                continue
            pose = pose_of(document, transform.text.split(), f"transform of {label}")
            to_world = own.get(camera.attributes.get("component_id")) or _child(chunk, "transform")
            if to_world is not None:
                pose = _moved(document, to_world, pose)
            sensor = camera.attributes.get("sensor_id")
            placed.append(Placed(sensors.get(sensor, f"of sensor {sensor}"), label, None, pose))
        reference = _child(chunk, "reference")
        georeferenced |= reference is not None and reference.text.startswith(GEOGRAPHIC)
    if not placed:
        raise document.refusal("none of its cameras has a transform: align them in Metashape first")
    middle = np.mean([one.pose[:3, 3] for one in placed], axis=0)
    if not georeferenced or np.linalg.norm(middle) < AXIS / 2:  # a chunk without a scale is not in the world
        return placed
    axes = _axes(middle)
    for one in placed:
        one.pose[:3, 3] -= middle
        one.pose[:3] = axes @ one.pose[:3]
    return placed


def _child(element: Element, name: str) -> Element | None:
    return next((one for one in element.children if one.name == name), None)


def _moved(document: Document, transform: Element, pose: np.ndarray) -> np.ndarray:
    """Return a pose of a chunk in its world: turned, and its place scaled and moved."""
    given = {one.name: one.text.split() for one in transform.children}
    turn = np.reshape(document.numbers(given.get("rotation", np.eye(3).ravel().tolist()), "rotation", 9), (3, 3))
    scale = document.numbers(given.get("scale", 1.0), "scale", 1)[0]
    if scale <= 0:
        raise document.refusal(f"scale of a chunk is {scale:g}: it must be above 0")
    moved = np.eye(4)
    moved[:3, :3] = turn @ pose[:3, :3]
    moved[:3, 3] = scale * turn @ pose[:3, 3] + document.numbers(given.get("translation", [0.0] * 3), "translation", 3)
    return checked(document, moved, "rotation of a chunk")


def _axes(middle: np.ndarray) -> np.ndarray:
    """Return east, north and up, (3, 3), at a point in the frame of the Earth's center."""
    x, y, z = middle
    across, short = hypot(x, y), AXIS * (1 - FLATTENING)
    squared = FLATTENING * (2 - FLATTENING)
    scaled = np.array((z * AXIS, across * short)) / hypot(z * AXIS, across * short)
    latitude = atan2(z + squared / (1 - squared) * short * scaled[0] ** 3, across - squared * AXIS * scaled[1] ** 3)
    longitude = atan2(y, x)
    east = (-sin(longitude), cos(longitude), 0.0)
    up = (cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude))
    return np.array((east, np.cross(up, east), up))
