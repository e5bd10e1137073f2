"""OpenSfM's and ODM's camera_models.json and cameras.json: cameras by name, whose lengths are parts of the longer side
of the picture; and reconstruction.json: these cameras, and shots with poses.

A shot's rotation is an axis times an angle, from the world to the camera, x right, y down, z ahead. The center of the
first pixel is (0, 0), and the middle of the picture is the center unless c_x and c_y move it. The terms across the
radius of a fisheye62 and 624 are of the angle, as those of a Thin Prism Fisheye, whose polynomial ends at k4; those of
a Fisheye624 are of the distorted radius, which is the same where there is only one of both.
Reference: OpenSfM documentation, Geometric Models; Reconstruction file format.
"""

from ..units import METERS
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, one_of_several
from .parts.placed import Placed, inverted, of_rotation
from .parts.program import ProgramFiles

RADIAL, EQUIDISTANT = ("k1", "k2"), ("k1", "k2", "k3", "k4")
THIN_PRISM = {"p1": "p1", "p2": "p2", "s0": "s1", "s2": "s3"}
"""Our settings for the coefficients of a fisheye62 and 624 after k4."""
BEYOND = {"k5": "k5", "k6": "k6", "s1": "s2", "s3": "s4"}
"""Our settings for their coefficients that only a Fisheye624 has."""
MODELS = {
    "perspective": ("OPENCV_PINHOLE", RADIAL),
    "brown": ("OPENCV_PINHOLE", ("k1", "k2", "p1", "p2", "k3")),
    "simple_radial": ("OPENCV_PINHOLE", ("k1",)),
    "radial": ("OPENCV_PINHOLE", RADIAL),
    "fisheye": ("OPENCV_FISHEYE", RADIAL),
    "fisheye_opencv": ("OPENCV_FISHEYE", EQUIDISTANT),
    "fisheye62": ("THIN_PRISM_FISHEYE", EQUIDISTANT),
    "fisheye624": ("THIN_PRISM_FISHEYE", EQUIDISTANT),
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
    if model == "THIN_PRISM_FISHEYE":
        settings |= {setting: camera.number(term, 0.0) for term, setting in THIN_PRISM.items()}
        if beyond := [term for term in BEYOND if camera.number(term, 0.0)]:
            model = "FISHEYE624"
            settings |= {setting: camera.number(term, 0.0) for term, setting in BEYOND.items()}
            if all(any(value for name, value in settings.items() if name[0] in kinds) for kinds in ("k", "ps")):
                raise camera.document.refusal(
                    f"its {', '.join(beyond)} of a {kind} is not 0, and it has both radial and other terms: no model "
                    "here has all of these"
                )
    return Lens(name, model, size | settings)


PROGRAM = ProgramFiles(
    "OpenSfM", "camera_models.json, reconstruction.json, of ODM, too", looks,
    marks="projection_type focal focal_x width height k1",
    reads="perspective, brown, radial, fisheye, fisheye_opencv, fisheye62, fisheye624, spherical",
    lost="k5, k6, s1 and s3 of a fisheye62 or 624 with both radial and other terms, and other projections, are refused",
    models=MODELS, read=read, poses=poses, note=note, unit=METERS,
)  # fmt: skip
