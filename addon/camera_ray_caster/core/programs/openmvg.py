"""openMVG's sfm_data.json: intrinsics, views and extrinsics.

A pose is the rotation by rows from the world to the camera, x right, y down, z ahead, and the camera's center. The
center of the first pixel is (0, 0). Views without a pose are left out: they were not reconstructed.
Reference: openMVG, sfm_data_io and its camera models.
"""

from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import Lens, matrix, one_of_several
from .parts.placed import Placed, of_camera
from .parts.program import ProgramFiles

TERMS = {
    "disto_k1": ("OPENCV_PINHOLE", ("k1",)),
    "disto_k3": ("OPENCV_PINHOLE", ("k1", "k2", "k3")),
    "disto_t2": ("OPENCV_PINHOLE", ("k1", "k2", "k3", "p1", "p2")),
    "fisheye": ("OPENCV_FISHEYE", ("k1", "k2", "k3", "k4")),
}
"""Our model, and its coefficients, by the entry that has them."""
PINHOLE, SPHERE = "pinhole", "spherical"
MODELS = (PINHOLE, "pinhole_radial_k1", "pinhole_radial_k3", "pinhole_brown_t2", "fisheye", SPHERE)


def looks(document: Document) -> bool:
    entries = document.entries
    return entries.has("sfm_data_version") or (
        entries.has("views", "extrinsics")
        and all(intrinsics.has("key", "value") for intrinsics in entries.parts("intrinsics"))
    )


def read(document: Document) -> list[Lens]:
    cameras = {str(camera.whole("key")): camera.part("value") for camera in document.entries.parts("intrinsics")}
    names = dict[str, str]()
    for camera in cameras.values():  # the first camera of a model has its name, the others its number
        if camera.has("polymorphic_name"):
            names[_number(camera)] = camera.text("polymorphic_name")
    return [one_of_several(key, _lens, camera.labeled(f"intrinsic {key}"), key, names.get(_number(camera), ""))
            for key, camera in cameras.items()]  # fmt: skip


def _number(camera: Fields) -> str:
    return str(int(camera.number("polymorphic_id", 0.0)) % (1 << 31))


def _lens(camera: Fields, key: str, kind: str) -> Lens:
    data = _flat(camera.part("ptr_wrapper").part("data"))
    entry = next(filter(data.has, TERMS), "")
    if kind or not entry:
        camera.document.one_of(kind or None, camera.said("polymorphic_name"), MODELS)
    size = data.sides("width", "height")
    if kind == SPHERE:
        return Lens(key, "EQUIRECTANGULAR", size)
    if (kind == PINHOLE) == bool(entry):
        raise camera.document.refusal(f"{camera.label} is {kind or entry}, and its coefficients are {entry or 'none'}")
    focal, center = data.number("focal_length"), data.numbers("principal_point", 2)
    model, terms = TERMS.get(entry, ("OPENCV_PINHOLE", ()))
    values = data.numbers(entry, len(terms)) if terms else []
    return Lens(key, model, size | matrix(focal, focal, *center) | dict(zip(terms, values, strict=True)))


def _flat(data: Fields) -> Fields:
    """Return entries with those of the classes that they extend."""
    for _ in range(3):
        inside = data.part("value0")
        data = data.some([name for name in data if name != "value0"]).merged(inside)
    return data


def poses(document: Document) -> list[Placed]:
    """See ProgramFiles: those of the views, in the order of the file."""
    entries = document.entries
    extrinsics = {extrinsic.whole("key"): extrinsic.part("value") for extrinsic in entries.parts("extrinsics")}
    placed = []
    for entry in entries.parts("views"):
        document.check()
        view = entry.part("value").part("ptr_wrapper").part("data")
        view = _flat(view)
        name = view.text("filename", str(entry.whole("key")))
        view = view.labeled(name)
        pose = extrinsics.get(view.whole("id_pose"))
        if pose is not None:
            matrix_to_camera, center = pose.matrix("rotation", 9), pose.numbers("center", 3)
            world = of_camera(document, matrix_to_camera, center, name)
            placed.append(Placed(str(view.whole("id_intrinsic")), name, None, world))
    return placed


PROGRAM = ProgramFiles(
    "openMVG", "sfm_data.json", looks,
    marks="sfm_data_version views intrinsics extrinsics polymorphic_name ptr_wrapper",
    reads="pinhole, pinhole_radial_k1, pinhole_radial_k3, pinhole_brown_t2, fisheye, spherical",
    lost="views without a pose", read=read, poses=poses,
)  # fmt: skip
