"""Agisoft Metashape's XML: the calibration of one camera, or the sensors and cameras of a project.

f is in pixels, cx and cy are measured from the middle of the picture; b1 and b2 are affinity and skew. With p1 and p2
swapped its distortion is OpenCV's; a fisheye's is the same of the angle, which is the model THIN_PRISM_FISHEYE.
Files before version 1.2 have fx, fy and skew in place of f, b1 and b2; their cx and cy are measured from the corner,
and their p1 and p2 are OpenCV's.
A sensor of a label that others have is named LABEL 1, LABEL 2, ...
A camera's transform leads from it, y down and z ahead, to its chunk; that of its component, or of the chunk, with a
scale, to the world. The world of a georeferenced chunk is that of the Earth's center: here it is a frame of east,
north and up about the middle of the cameras, on the WGS 84 ellipsoid. A camera with a master stands beside it as its
sensor tells: the rotation leads from its frame to that of the master, where the location is, in units of the chunk.
Cameras without a transform, of their own or of a master, are left out: they were not aligned.
References: Agisoft Metashape manual, appendix Camera models; Agisoft Lens
manual 0.4, camera model; Agisoft Metashape Python API, Camera.master,
Sensor.rotation, Sensor.location, Chunk.transform and CoordinateSystem.localframe.
"""

from collections import Counter

import numpy as np

from ..text_forms.xml_subset import Element
from .parts.document import Document
from .parts.earth import AXIS, axes_at
from .parts.fields import Fields
from .parts.lens import Lens, matrix, one_of_several
from .parts.placed import Placed, of_rotation, pose_of
from .parts.program import ProgramFiles

MODELS = {"frame": "OPENCV_PINHOLE", "fisheye": "THIN_PRISM_FISHEYE", "equidistant_fisheye": "THIN_PRISM_FISHEYE"}
TERMS = {"k1": "k1", "k2": "k2", "k3": "k3", "k4": "k4", "p1": "p2", "p2": "p1"}
"""Our settings for Metashape's coefficients."""

SPHERE = "spherical"
"""The type of a sensor whose pictures are panoramas: it needs no calibration."""
GEOGRAPHIC = "GEOGCS", "PROJCS", "COMPD_CS", "GEOCCS"
"""Begins of the coordinate systems of the Earth, in OGC's words."""


def looks(document: Document) -> bool:
    return document.xml.name == "calibration" or bool(_named_sensors(document.xml))


def read(document: Document) -> list[Lens]:
    root = document.xml
    if root.name == "calibration":
        return [_lens(document, "", root)]
    return [one_of_several(name, _of_sensor, document, sensor, name) for name, sensor in _named_sensors(root)]


def _named_sensors(root: Element) -> list[tuple[str, Element]]:
    """Return the sensors that have a calibration, or are spheres, with names of their own."""
    sensors = [sensor for sensor in root.all("sensor") if sensor.child("calibration") is not None or _is_sphere(sensor)]
    labels = [sensor.attributes.get("label") or sensor.attributes.get("id", "") for sensor in sensors]
    total, count = Counter(labels), Counter[str]()
    named = []
    for label, sensor in zip(labels, sensors, strict=True):
        count[label] += 1
        named.append((label if total[label] == 1 else f"{label} {count[label]}", sensor))
    return named


def _is_sphere(element: Element) -> bool:
    return SPHERE in (element.attributes.get("type"), element.texts().get("projection"))


def _of_sensor(document: Document, sensor: Element, name: str) -> Lens:
    if _is_sphere(sensor):
        return _lens(document, name, sensor)
    calibrations = [child for child in sensor.children if child.name == "calibration"]
    adjusted = [calibration for calibration in calibrations if calibration.attributes.get("class") == "adjusted"]
    return _lens(document, name, (adjusted or calibrations)[0])


def _lens(document: Document, name: str, calibration: Element) -> Lens:
    entries, resolution = Fields(document, calibration.texts()), calibration.child("resolution")
    sides = entries if resolution is None else Fields(document, dict(resolution.attributes))
    if _is_sphere(calibration):
        return Lens(name, "EQUIRECTANGULAR", sides.sides("width", "height"))
    kind = calibration.attributes.get("type") or entries.text("projection") or "frame"
    model = MODELS[document.one_of(kind, "projection", MODELS)]
    width, height = sides.number("width"), sides.number("height")
    size, terms = document.size(width, height), TERMS
    if entries.has("fx") and not entries.has("f"):
        center = entries.number("cx", width / 2), entries.number("cy", height / 2)
        settings = matrix(entries.number("fx"), entries.number("fy"), *center, 0.5)
        settings |= size | {"skew": entries.number("skew", 0.0)}
        terms = TERMS | {"p1": "p1", "p2": "p2"}
    else:
        focal = entries.number("f")
        center = width / 2 + entries.number("cx", 0.0), height / 2 + entries.number("cy", 0.0)
        settings = matrix(focal + entries.number("b1", 0.0), focal, *center, 0.5)
        settings |= size | {"skew": entries.number("b2", 0.0)}
    settings |= {setting: entries.number(theirs, 0.0) for theirs, setting in terms.items()}
    unread = [term for term in ("p3", "p4", *(("k4",) if kind == "frame" else ())) if entries.number(term, 0.0)]
    if unread:
        raise document.refusal(f"its {', '.join(unread)} of a {kind} camera is not 0, which no model here has")
    if kind == "frame":
        del settings["k4"]
    return Lens(name, model, settings)


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: those of the aligned cameras in the order of the file."""
    root = document.xml
    if root.name == "calibration" or not any(chunk.child("cameras") for chunk in root.all("chunk")):
        return []
    names = {id(sensor): name for name, sensor in _named_sensors(root)}
    placed: list[Placed] = []
    georeferenced = False
    for chunk in root.all("chunk"):
        sensors = {sensor.attributes.get("id"): sensor for sensor in chunk.all("sensor")}
        parts, holder = chunk.all("component"), chunk.child("cameras")
        components = {component.attributes.get("id"): component.child("transform") for component in parts}
        cameras = holder.all("camera") if holder is not None else []
        by_id = {camera.attributes.get("id", ""): camera for camera in cameras}
        for camera in cameras:
            document.check()
            label, number = camera.attributes.get("label", ""), camera.attributes.get("sensor_id")
            sensor = sensors.get(number)
            master = camera if camera.child("transform") is not None else _master(document, camera, by_id)
            transform = master.child("transform")
            if transform is None:
                continue
            pose = pose_of(document, transform.text.split(), f"transform of {master.attributes.get('label', '')}")
            if master is not camera and sensor is not None:
                pose = pose @ _rigid(document, sensor, "location", f"sensor {number}")
            to_world = components.get(master.attributes.get("component_id")) or chunk.child("transform")
            if to_world is not None:
                pose = _moved(document, to_world, pose)
            name = names.get(id(sensor), "") if sensor is not None else f"of sensor {number}"
            placed.append(Placed(name, label, None, pose))
        reference = chunk.child("reference")
        georeferenced |= reference is not None and reference.text.startswith(GEOGRAPHIC)
    if not placed:
        raise document.refusal("none of its cameras has a transform: align them in Metashape first")
    middle = np.mean([view.pose[:3, 3] for view in placed], axis=0)
    if not georeferenced or np.linalg.norm(middle) < AXIS / 2:  # a chunk without a scale is not in the world
        return placed
    axes = axes_at(middle)
    for view in placed:
        view.pose[:3, 3] -= middle
        view.pose[:3] = axes @ view.pose[:3]
    return placed


def _master(document: Document, camera: Element, cameras: dict[str, Element]) -> Element:
    """Return the master of a camera, which may be itself. Raises InputError for one that is not in the chunk."""
    number = camera.attributes.get("master_id")
    if number is None:
        return camera
    if number not in cameras:
        label = camera.attributes.get("label", "")
        raise document.refusal(f"master_id of {label} is {number}: no camera of its chunk has this id")
    return cameras[number]


def _rigid(document: Document, element: Element, entry: str, name: str) -> np.ndarray:
    """Return the pose (4, 4) of an element's rotation and its ``entry``; without them, the identity."""
    texts = {name: text.split() for name, text in element.texts().items()}
    turn = document.numbers(texts.get("rotation", np.eye(3).ravel().tolist()), f"rotation of {name}", 9)
    translation = document.numbers(texts.get(entry, [0.0] * 3), f"{entry} of {name}", 3)
    return of_rotation(document, turn, translation, f"rotation of {name}")


def _moved(document: Document, transform: Element, pose: np.ndarray) -> np.ndarray:
    """Return a pose of a chunk in its world: turned, and its place scaled and moved."""
    moved, size = _rigid(document, transform, "translation", "a chunk"), transform.child("scale")
    scale = document.numbers(size.text.split() if size is not None else 1.0, "scale of a chunk", 1)[0]
    if scale <= 0:
        raise document.refusal(f"scale of a chunk is {scale:g}: it must be above 0")
    moved[:3, 3] = scale * moved[:3, :3] @ pose[:3, 3] + moved[:3, 3]
    moved[:3, :3] = moved[:3, :3] @ pose[:3, :3]
    return moved


PROGRAM = ProgramFiles(
    "Metashape", "calibrations, and cameras of projects, as .xml", looks,
    marks="document chunk sensors sensor resolution adjusted", reads="frame, fisheye, spherical; slave cameras",
    lost="cameras that are not aligned; k4 of a frame camera, p3 and p4 are refused", read=read, poses=poses,
)  # fmt: skip
