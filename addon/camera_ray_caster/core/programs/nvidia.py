"""NVIDIA's cameras, as JSON: the sensors of a DriveWorks rig, the camera models of NCore and NuRec, and Isaac Sim's.

A rig has rig.sensors, whose properties have Model ftheta, a polynomial with its polynomial-type (or bw-poly, which is
from pixel distance to angle), and linear-c, -d and -e. NCore has both polynomials, a reference_poly that names the one
that is the model, and linear_cde. NCore's parameters are the whole file, its camera_model_parameters, or entries of
NuRec's camera_calibrations. All polynomials begin with the constant. A windshield before the lens is refused.
The center of the first pixel is (0, 0).
The camera_params.json of Omniverse Replicator and Isaac Sim has a pinhole with square pixels, or a fisheye by a
polynomial that gives the angle, rad, of a radius in pixels of the nominal picture. There the center counts from the
picture's corner, so that half the width is the middle.
cameraViewTransform leads from the world to a camera like Blender's, as a matrix behind rows, in units of the scene.
References: NVIDIA DriveWorks SDK documentation, Rig Configuration; NVIDIA NCore documentation, Camera Models; NVIDIA
Omniverse Replicator documentation, Annotators: CameraParams.
"""

from math import radians

import numpy as np

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix, one_of_several
from .parts.placed import FROM_BLENDER, Placed, inverted, pose_of
from .parts.program import ProgramFiles

REFERENCES = {
    "angle-to-pixeldistance": "ANGLE_TO_RADIUS",
    "pixeldistance-to-angle": "RADIUS_TO_ANGLE",
    "ANGLE_TO_PIXELDIST": "ANGLE_TO_RADIUS",
    "PIXELDIST_TO_ANGLE": "RADIUS_TO_ANGLE",
    "1": "RADIUS_TO_ANGLE",
    "2": "ANGLE_TO_RADIUS",
}
"""Names of the polynomial that is the model, or NCore's number of it, and our key of it."""
NOMINAL = "cameraFisheyeNominalWidth", "cameraFisheyeNominalHeight"
VIEW = "cameraViewTransform"
FISHEYE, PINHOLE = "fisheyePolynomial", "pinhole"


def looks(document: Document) -> bool:
    entries = document.entries
    if entries.has("cameraModel", "renderProductResolution") or entries.has("camera_calibrations"):
        return True
    if entries.has("rig") and entries.part("rig").parts("sensors"):
        return True
    return any(camera.has("reference_poly") for camera in (entries, entries.part("camera_model_parameters")))


def read(document: Document) -> list[Lens]:
    entries = document.entries
    if entries.has("cameraModel", "renderProductResolution"):
        return [_of_isaac(entries)]
    if entries.has("rig"):
        sensors = entries.part("rig").parts("sensors")
        cameras = [(sensor, sensor.part("properties")) for sensor in sensors]
        cameras = [(sensor, properties) for sensor, properties in cameras if properties.text("Model") == "ftheta"]
        if not cameras:
            raise document.refusal("none of its sensors has properties with the Model 'ftheta'")
        named = [(sensor.text("name"), properties) for sensor, properties in cameras]
        return [one_of_several(name, _of_rig, properties.labeled(name)) for name, properties in named]
    if entries.has("camera_calibrations"):
        calibrations = entries.part("camera_calibrations").named().items()
        named = [(calibration.text("logical_sensor_name", key), calibration) for key, calibration in calibrations]
        return [one_of_several(name, _of_nurec, calibration.labeled(name)) for name, calibration in named]
    inside = entries.part("camera_model_parameters")
    return [of_parameters(entries if entries.has("reference_poly") else inside)]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: that of Isaac Sim's camera; none of other files."""
    entries = document.entries
    if not entries.has(VIEW):
        return []
    to_camera = pose_of(document, np.reshape(entries.numbers(VIEW, 16), (4, 4)).T.tolist(), VIEW)
    to_camera[:3, 3] *= entries.number("metersPerSceneUnit", 1.0)
    return [Placed("", "", None, inverted(to_camera) @ FROM_BLENDER)]


def _of_rig(properties: Fields) -> Lens:
    kind, entry = properties.text("polynomial-type"), "polynomial"
    if not properties.has("polynomial") and properties.has("bw-poly"):
        kind, entry = "pixeldistance-to-angle", "bw-poly"
    reference = _reference(properties, "polynomial-type", kind)
    center = [properties.number(name) for name in ("cx", "cy")]
    linear = [properties.number(f"linear-{term}", plain) for term, plain in zip("cde", (1, 0, 0), strict=True)]
    sides = [properties.number(name) for name in ("width", "height")]
    polynomial = properties.document.numbers(properties.text(entry).split(), properties.said(entry))
    return _lens(properties, reference, polynomial, center, linear, sides)


def _of_nurec(calibration: Fields) -> Lens:
    model = calibration.part("camera_model")
    if model.text("type") != "ftheta":
        problem = f"camera_model of {calibration.label} is of type {model.text('type')!r}"
        raise calibration.document.refusal(f"{problem}: it must be 'ftheta'")
    return of_parameters(model.part("parameters"))


def of_parameters(parameters: Fields) -> Lens:
    """Return the lens of NCore's parameters."""
    if parameters.has("external_distortion_parameters") and len(parameters.part("external_distortion_parameters")):
        raise parameters.document.refusal("it has external_distortion_parameters, of a windshield: they must be null")
    kind = parameters.text("reference_poly")
    reference = _reference(parameters, "reference_poly", kind)
    entry = "angle_to_pixeldist_poly" if reference == "ANGLE_TO_RADIUS" else "pixeldist_to_angle_poly"
    center, linear = parameters.numbers("principal_point", 2), parameters.numbers("linear_cde", 3, [1, 0, 0])
    sides = parameters.numbers("resolution", 2)
    lens = _lens(parameters, reference, parameters.numbers(entry), center, linear, sides)
    angle = parameters.first("max_angle", "max_angle_rad")
    widest = {"ftheta_max_angle": parameters.number(angle)} if parameters.has(angle) else {}
    return lens._replace(settings=lens.settings | widest)


def _reference(camera: Fields, field: str, kind: str) -> str:
    """Return our key of the polynomial that is the model. Raises InputError for an unknown name."""
    if kind not in REFERENCES:
        problem = f"{field} of {camera.label or 'the camera'} is {kind or None!r}"
        raise camera.document.refusal(f"{problem}: it must be one of {', '.join(REFERENCES)}")
    return REFERENCES[kind]


def _lens(camera: Fields, reference: str, polynomial: list[float], center, linear, sides) -> Lens:
    return Lens(camera.label, "FTHETA", camera.document.size(*sides) | {
        "cx": center[0], "cy": center[1],
        "ftheta_reference": reference, f"ftheta_{reference.lower()}": " ".join(map(repr, polynomial)),
        **{f"ftheta_{term}": number for term, number in zip("cde", linear, strict=True)},
    })  # fmt: skip


def _of_isaac(entries: Fields) -> Lens:
    document, kind = entries.document, entries.word("cameraModel", (PINHOLE, FISHEYE))
    width, height = entries.numbers("renderProductResolution", 2)
    if kind == PINHOLE:
        if any(entries.numbers("cameraApertureOffset", default=[0.0])):
            raise document.refusal("its cameraApertureOffset is not 0, which is not read")
        aperture = entries.numbers("cameraAperture", 2)
        focal = entries.number("cameraFocalLength") / aperture[0] * width if aperture[0] else 0.0
        middle = matrix(focal, focal, width / 2, height / 2, 0.5)
        return Lens("", "OPENCV_PINHOLE", document.size(width, height) | middle)
    cx, cy = entries.numbers("cameraFisheyeOpticalCentre", 2)
    numbers = entries.numbers("cameraFisheyePolynomial")
    return Lens("", "FTHETA", document.size(*(entries.number(side) for side in NOMINAL)) | {
        "cx": cx - 0.5, "cy": cy - 0.5, "ftheta_reference": "RADIUS_TO_ANGLE",
        "ftheta_radius_to_angle": " ".join(map(repr, numbers)),
        "ftheta_max_angle": radians(entries.number("cameraFisheyeMaxFOV") / 2),
    })  # fmt: skip


PROGRAM = ProgramFiles(
    "NVIDIA (f-theta, Isaac Sim)", "DriveWorks rigs, NCore, NuRec, camera_params.json", looks,
    marks="rig sensors properties ftheta polynomial reference_poly cameraModel",
    reads="f-theta, fisheyePolynomial, pinhole", lost="windshields are refused; poses but those of Isaac Sim",
    read=read, poses=poses, unit=METERS,
)  # fmt: skip
