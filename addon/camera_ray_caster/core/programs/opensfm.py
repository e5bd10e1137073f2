"""OpenSfM's and ODM's camera_models.json and cameras.json: cameras by name, whose lengths are parts of the longer side
of the picture; and reconstruction.json: these cameras, and shots with poses.

A shot's rotation is an axis times an angle, from the world to the camera, x right, y down, z ahead. The center of the
first pixel is (0, 0), and the middle of the picture is the center unless c_x and c_y move it.
Reference: OpenSfM documentation, Geometric Models; Reconstruction file format.
"""

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, one_of_several
from .parts.placed import Placed, inverted, of_rotation
from .parts.program import ProgramFiles

RADIAL, EQUIDISTANT = ("k1", "k2"), ("k1", "k2", "k3", "k4")
FISHEYE = (*EQUIDISTANT, "p1", "p2")
PRISM = {"s0": "s1", "s2": "s3"}
"""Our settings for coefficients of a fisheye624."""
BEYOND = "k5", "k6", "s1", "s3"
"""Coefficients of a fisheye62 and 624 that no model has."""
MODELS = {
    "perspective": ("OPENCV_PINHOLE", RADIAL),
    "brown": ("OPENCV_PINHOLE", ("k1", "k2", "p1", "p2", "k3")),
    "simple_radial": ("OPENCV_PINHOLE", ("k1",)),
    "radial": ("OPENCV_PINHOLE", RADIAL),
    "fisheye": ("OPENCV_FISHEYE", RADIAL),
    "fisheye_opencv": ("OPENCV_FISHEYE", EQUIDISTANT),
    "fisheye62": ("THIN_PRISM_FISHEYE", FISHEYE),
    "fisheye624": ("THIN_PRISM_FISHEYE", FISHEYE),
    "spherical": ("EQUIRECTANGULAR", ()),
    "equirectangular": ("EQUIRECTANGULAR", ()),
}
"""Our model for a projection_type, and its coefficients."""


def looks(document: Document) -> bool:
    if _reconstructions(document):
        return True
    parts = document.entries.named()
    return len(parts) == len(document.entries) and all(camera.has("projection_type") for camera in parts.values())


def read(document: Document) -> list[Lens]:
    cameras: dict[str, Fields] = {}
    for reconstruction in _reconstructions(document) or [Fields(document, {"cameras": document.entries.values})]:
        cameras |= reconstruction.part("cameras").named()
    return [one_of_several(name, _lens, camera, name) for name, camera in cameras.items()]


def _reconstructions(document: Document) -> list[Fields]:
    """Return the parts of a reconstruction.json; [] of any other file."""
    entries = document.entries
    parts = [entries] if entries.has("cameras", "shots") else list(entries.named().values())
    return parts if all(reconstruction.has("cameras", "shots") for reconstruction in parts) else []


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: those of the shots of the largest reconstruction, since each has a frame of its own."""
    largest = max(_reconstructions(document), key=_shots, default=None)
    placed = []
    for name, shot in largest.part("shots").named().items() if largest else ():
        document.check()
        turn, translation = shot.numbers("rotation", 3), shot.numbers("translation", 3)
        to_camera = of_rotation(document, turn, translation, shot.said("rotation"))
        placed.append(Placed(shot.text("camera"), name, None, inverted(to_camera)))
    return placed


def _shots(reconstruction: Fields) -> int:
    return len(reconstruction.part("shots"))


def note(document: Document) -> str:
    """See ProgramFiles: on reconstructions that are left out."""
    counts = sorted(filter(None, map(_shots, _reconstructions(document))), reverse=True)
    if len(counts) < 2:
        return ""
    return (
        f"of {len(counts)} reconstructions, each in a frame of its own, the largest is read; {sum(counts[1:])} of "
        f"{sum(counts)} shots are left out"
    )


def _lens(camera: Fields, name: str) -> Lens:
    kind = camera.word("projection_type", MODELS, "perspective")
    model, terms = MODELS[kind]
    width, height = camera.number("width"), camera.number("height")
    size = camera.document.size(width, height)
    if model == "EQUIRECTANGULAR":
        return Lens(name, model, size)
    focal, unit = camera.number("focal", 0.0), max(width, height)
    settings = {f"f{axis}": camera.number(f"focal_{axis}", focal or None) * unit for axis in "xy"}
    for axis, side in (("x", width), ("y", height)):
        settings[f"c{axis}"] = (side - 1) / 2 + camera.number(f"c_{axis}", 0.0) * unit
    settings |= {term: camera.number(term, 0.0) for term in terms}
    if terms is FISHEYE:
        unread = [term for term in BEYOND if camera.number(term, 0.0)]
        if unread:
            raise camera.document.refusal(f"its {', '.join(unread)} of a {kind} is not 0, which no model here has")
        settings |= {setting: camera.number(term, 0.0) for term, setting in PRISM.items()}
    return Lens(name, model, size | settings)


PROGRAM = ProgramFiles(
    "OpenSfM", "camera_models.json, reconstruction.json, of ODM, too", looks,
    marks="projection_type focal focal_x width height k1",
    reads="perspective, brown, radial, fisheye, fisheye_opencv, fisheye62, fisheye624, spherical",
    lost="k5, k6, s1 and s3 of a fisheye62 or 624, and other projections, are refused", models=MODELS,
    read=read, poses=poses, note=note, unit=METERS,
)  # fmt: skip
