"""The poses of the cameras in Agisoft Metashape's XML files of projects.

A camera's transform leads from it, y down and z ahead, to its chunk; that of its component, or of the chunk, with a
scale, to the world. The world of a georeferenced chunk is that of the Earth's center: here it is a frame of east,
north and up about the middle of the cameras, on the WGS 84 ellipsoid. A camera with a master stands beside it as its
sensor tells: the rotation leads from its frame to that of the master, where the location is, in units of the chunk.
Cameras without a transform, of their own or of a master, are left out: they were not aligned.
References: Agisoft Metashape Python API, Camera.master, Sensor.rotation, Sensor.location, Chunk.transform and
CoordinateSystem.localframe; B. Bowring, Transformation from spatial to geographical coordinates (1976).
"""

from __future__ import annotations

from math import atan2, cos, hypot, sin

import numpy as np

from ..text_forms.xml_subset import Element
from .metashape import all_of, named_sensors, root_of
from .parts.document import Document
from .parts.placed import Placed, checked, pose_of

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
        sensors = {one.attributes.get("id"): one for one in all_of(chunk, "sensor")}
        own = {one.attributes.get("id"): _child(one, "transform") for one in all_of(chunk, "component")}
        holder = _child(chunk, "cameras")
        cameras = all_of(holder, "camera") if holder is not None else []
        by_id = {one.attributes.get("id", ""): one for one in cameras}
        for camera in cameras:
            document.check()
            label, number = camera.attributes.get("label", ""), camera.attributes.get("sensor_id")
            sensor = sensors.get(number)
            master = camera if _child(camera, "transform") is not None else _master(document, camera, by_id)
            transform = _child(master, "transform")
            if transform is None:
                continue
            pose = pose_of(document, transform.text.split(), f"transform of {master.attributes.get('label', '')}")
            if master is not camera and sensor is not None:
                pose = pose @ _rigid(document, sensor, "location", f"sensor {number}")
            to_world = own.get(master.attributes.get("component_id")) or _child(chunk, "transform")
            if to_world is not None:
                pose = _moved(document, to_world, pose)
            name = names.get(id(sensor), "") if sensor is not None else f"of sensor {number}"
            placed.append(Placed(name, label, None, pose))
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


def _master(document: Document, camera: Element, cameras: dict[str, Element]) -> Element:
    """Return the master of a camera, which may be itself. Raises InputError for one that is not in the chunk."""
    number = camera.attributes.get("master_id")
    if number is None:
        return camera
    if number not in cameras:
        label = camera.attributes.get("label", "")
        raise document.refusal(f"master_id of {label} is {number}: no camera of its chunk has this id")
    return cameras[number]


def _rigid(document: Document, element: Element, place: str, name: str) -> np.ndarray:
    """Return the pose (4, 4) of an element's rotation and its ``place``; without them, the identity."""
    given = {one.name: one.text.split() for one in element.children}
    pose = np.eye(4)
    turn = document.numbers(given.get("rotation", np.eye(3).ravel().tolist()), f"rotation of {name}", 9)
    pose[:3, :3] = np.reshape(turn, (3, 3))
    pose[:3, 3] = document.numbers(given.get(place, [0.0] * 3), f"{place} of {name}", 3)
    return checked(document, pose, f"rotation of {name}")


def _moved(document: Document, transform: Element, pose: np.ndarray) -> np.ndarray:
    """Return a pose of a chunk in its world: turned, and its place scaled and moved."""
    moved, size = _rigid(document, transform, "translation", "a chunk"), _child(transform, "scale")
    scale = document.numbers(size.text.split() if size is not None else 1.0, "scale of a chunk", 1)[0]
    if scale <= 0:
        raise document.refusal(f"scale of a chunk is {scale:g}: it must be above 0")
    moved[:3, 3] = scale * moved[:3, :3] @ pose[:3, 3] + moved[:3, 3]
    moved[:3, :3] = moved[:3, :3] @ pose[:3, :3]
    return moved


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
