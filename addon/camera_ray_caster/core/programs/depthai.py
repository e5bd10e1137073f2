"""DepthAI's calibration of Luxonis' devices, JSON: cameraData is a list of sockets with their cameras.

Coefficients are OpenCV's 14, and of cameraType 1 those of its fisheye. extrinsics leads from the camera, x right, y
down, z ahead, to that of toCameraSocket, in centimeters; the camera that leads to none is the frame of all. Sockets
are named as DepthAI does: CAM_A is 0. The center of the first pixel is (0, 0).
Reference: DepthAI documentation, Calibration; Extrinsics.
"""

import numpy as np

from ..units import CENTIMETERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens
from .parts.placed import Placed, of_rotation
from .parts.plain import of_matrix
from .parts.program import ProgramFiles, of_cameras

TYPES = {"0": "plumb_bob", "1": "fisheye"}
FIRST = ord("A")


def looks(document: Document) -> bool:
    return bool(_cameras(document))


def _cameras(document: Document) -> dict[int, Fields]:
    """Return the cameras that are calibrated by the number of their socket."""
    cameras = {}
    for entry in document.entries.each("cameraData"):
        if entry.count_of("cameraData") != 2:
            raise entry.refusal("cameraData", "a list of pairs, a socket and its camera")
        number, camera = (Fields(document, {"socket": item}) for item in entry.values["cameraData"])
        socket = number.whole("socket")
        labeled = camera.part("socket").labeled(f"CAM_{chr(FIRST + socket % 26)}")
        if labeled.count_of("intrinsicMatrix") and any(labeled.matrix("intrinsicMatrix", 9)[:8]):
            cameras[socket] = labeled
    return cameras


def _lens(camera: Fields) -> Lens:
    document = camera.document
    kind = TYPES[document.one_of(f"{camera.number('cameraType', 0.0):g}", camera.said("cameraType"), TYPES)]
    size = camera.sides("width", "height")
    count = 4 if kind == "fisheye" else 14
    coefficients = camera.numbers("distortionCoeff", default=[0.0])
    if any(coefficients[count:]):
        raise document.refusal(f"{camera.said('distortionCoeff')} has more than {count} numbers")
    cut = camera.merged(Fields(document, {"distortionCoeff": coefficients[:count]}))
    return of_matrix(cut, "intrinsicMatrix", "distortionCoeff", size, kind)


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: in the frame of the camera to which the others lead."""
    cameras = _cameras(document)
    first = [camera for camera in cameras.values() if _next(camera) < 0]
    if len(first) > 1:
        raise document.refusal(f"extrinsics of {first[1].label} lead to no camera, and so do those of {first[0].label}")
    placed = []
    for camera in cameras.values():
        pose, at, steps = np.eye(4), camera, 0
        while (to := _next(at)) >= 0:
            pose, steps = _pose(at.part("extrinsics")) @ pose, steps + 1
            if to not in cameras or steps > len(cameras):
                raise document.refusal(f"extrinsics of {at.label} lead to socket {to:g}, which leads nowhere")
            at = cameras[int(to)]
        placed.append(Placed(camera.label, "", None, pose))
    return placed


def _next(camera: Fields) -> float:
    """Return the socket to which a camera's extrinsics lead; below 0 if they lead to none."""
    return camera.part("extrinsics").number("toCameraSocket", -1.0)


def _pose(extrinsics: Fields) -> np.ndarray:
    turn, translation = extrinsics.matrix("rotationMatrix", 9), extrinsics.part("translation")
    position = [translation.number(axis) for axis in "xyz"]
    return of_rotation(extrinsics.document, turn, position, extrinsics.said("rotationMatrix"))


PROGRAM = ProgramFiles(
    "DepthAI", "calibration of a device as .json", looks,
    marks="cameraData cameraType distortionCoeff extrinsics intrinsicMatrix specTranslation toCameraSocket boardName",
    reads="perspective, fisheye", lost="other types are refused", unit=CENTIMETERS, poses=poses,
    **of_cameras(lambda document: _cameras(document).values(), _lens),
)  # fmt: skip
