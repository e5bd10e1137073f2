"""The intrinsics and poses of Meshroom's and AliceVision's .sfm files, as JSON.

Lengths are in pixels (pxFocalLength), or the focal length and the sensor's width in millimeters. The principal point is
measured from the corner of the picture, and from version 1.2.1 on from its middle. The center of the first pixel is
(0, 0). Numbers may be text. A pose is the center, and by columns the rotation from the world to the camera, or of a rig
to the rig, whose cameras have poses in it. Views without a pose are left out: they were not reconstructed. A 3deradial4
is OpenCV's pinhole without its last two coefficients, u3 and v3, with which it is refused, and so is any undistortion.
The polynomial of a radialk3pt is over its value at radius 1.
References: AliceVision, sfmDataIO: the changes of its file format; its camera models, Pose3 and SfMData::getPose.
"""

import numpy as np

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, one_of_several
from .parts.placed import Placed, of_rotation
from .parts.program import ProgramFiles

RADIAL4, NORMALIZED = "3deradial4", "radialk3pt"
MODELS = {
    "pinhole": ("OPENCV_PINHOLE", ()),
    "none": ("OPENCV_PINHOLE", ()),
    "radial1": ("OPENCV_PINHOLE", ("k1",)),
    "radialk1": ("OPENCV_PINHOLE", ("k1",)),
    "radial3": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    "radialk3": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    NORMALIZED: ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    "brown": ("OPENCV_PINHOLE", ("k1", "k2", "k3", "p1", "p2")),
    "fisheye4": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "fisheye": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
    "equidistant": ("OPENCV_FISHEYE", ()),
    "equirectangular": ("EQUIRECTANGULAR", ()),
    "fisheye1": ("FOV", ("fov_omega",)),
    RADIAL4: ("OPENCV_PINHOLE", ("k1", "k2", "p2", "p1")),
}
"""Our model for a type, or for the distortionType of a pinhole, and its coefficients."""

CENTERED = [1.0, 2.0, 1.0]
"""The version of files from which on principal points are measured from the middle."""

PIXELS = [1.0, 2.0, 5.0]
"""The version from which on pixelRatio is the width of a pixel over its height, and not the inverse."""


def looks(document: Document) -> bool:
    entries = document.entries
    return entries.has("intrinsics") and all(camera.has("intrinsicId") for camera in entries.parts("intrinsics"))


def read(document: Document) -> list[Lens]:
    entries = document.entries
    version = entries.numbers("version", default=PIXELS)
    cameras = [camera.labeled(camera.text("intrinsicId")) for camera in entries.parts("intrinsics")]
    return [one_of_several(camera.label, _lens, camera, version) for camera in cameras]


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: those of the views, in the order of the file."""
    entries = document.entries
    transforms = {pose.text("poseId"): pose.part("pose").part("transform") for pose in entries.parts("poses")}
    rigs = {rig.text("rigId"): rig.parts("subPoses") for rig in entries.parts("rigs")}
    placed = []
    for view in entries.parts("views"):
        document.check()
        name = view.text("path") or view.text("viewId")
        transform = transforms.get(view.text("poseId"))
        if transform is None or not len(transform):
            continue
        pose, rig = _pose(transform.labeled(name)), view.text("rigId")
        if rig in rigs and view.text("isPoseIndependant", "true").lower() not in ("true", "1"):
            number = view.whole("subPoseId")
            if number >= len(rigs[rig]):
                raise document.refusal(f"subPoseId of {name} is {number}: its rig has {len(rigs[rig])} cameras")
            pose = pose @ _pose(rigs[rig][number].part("pose").labeled(f"camera {number} of a rig"))
        placed.append(Placed(view.text("intrinsicId"), name, None, pose))
    if not placed:
        raise document.refusal("it has no poses of its views: give the file of StructureFromMotion, not of CameraInit")
    return placed


def _pose(transform: Fields) -> np.ndarray:
    turn, center = transform.numbers("rotation", 9), transform.numbers("center", 3)
    # the transposed of a rotation by columns is it by rows: from the camera
    return of_rotation(transform.document, turn, center, transform.said("rotation"))


def _lens(camera: Fields, version: list[float]) -> Lens:
    kind = camera.text("type", "pinhole").lower()
    if kind in ("equidistant", "equirectangular") and camera.text("distortionType", "none").lower() != "none":
        raise camera.document.refusal(f"{camera.said('distortionType')} of an {kind} camera is not read")
    kind = camera.text("distortionType", kind).lower() if kind == "pinhole" else kind
    if kind not in MODELS and not any(camera.numbers("distortionParams", default=[0.0])):
        kind = "none"
    model, terms = MODELS[camera.document.one_of(kind, camera.said("type"), MODELS)]
    width, height = camera.number("width"), camera.number("height")
    if model == "EQUIRECTANGULAR":
        return Lens(camera.label, model, camera.document.size(width, height))
    ratio = camera.number("pixelRatio", 1.0)
    if ratio <= 0:
        raise camera.document.refusal(f"{camera.said('pixelRatio')} is {ratio:g}: it must be above 0")
    if camera.has("pxFocalLength"):
        focal = camera.numbers("pxFocalLength")
    else:
        focal = [camera.number("focalLength") / camera.number("sensorWidth") * width]
        focal.append(focal[0] * (ratio if version >= PIXELS else 1 / ratio))
    x, y = camera.numbers("principalPoint", 2)
    if version >= CENTERED:
        x, y = x + width / 2, y + height / 2
    undistorted = camera.text("undistortionType", "none").lower() != "none"
    if undistorted and any(camera.numbers("undistortionParams", default=())):
        raise camera.document.refusal(f"{camera.said('undistortionParams')} are not 0, which are not read")
    coefficients = camera.numbers("distortionParams", default=[0.0] * len(terms))
    entry = camera.said("distortionParams")
    if kind == RADIAL4 and len(coefficients) == len(terms) + 2:
        if any(coefficients[len(terms) :]):
            raise camera.document.refusal(f"the last two of {entry} are not 0: no model has them")
        coefficients = coefficients[: len(terms)]
    if len(coefficients) != len(terms) and any(coefficients):
        raise camera.document.refusal(f"{entry} has {len(coefficients)} numbers: {kind} has {len(terms)}")
    if kind == NORMALIZED and any(coefficients):
        whole = 1 + sum(coefficients)
        if whole <= 0:
            raise camera.document.refusal(f"{entry} and 1 add up to {whole:g}: not above 0")
        focal = [length / whole for length in focal]
    settings = {"fx": focal[0], "fy": focal[-1], "cx": x, "cy": y} | dict(zip(terms, coefficients, strict=False))
    return Lens(camera.label, model, camera.document.size(width, height) | settings)


PROGRAM = ProgramFiles(
    "Meshroom", ".sfm of AliceVision", looks,
    marks="intrinsicId pxFocalLength principalPoint distortionParams sensorWidth",
    reads="pinhole, radial1, radial3, radialk3pt, brown, fisheye4, fisheye1, equidistant, equirectangular, 3deradial4",
    lost="views without a pose; other distortions of 3DE and undistortions are refused", read=read, poses=poses,
)  # fmt: skip
