"""Tables of rays: arrays of numpy, EXR images, and meshes of rays as text or as .obj.

The formats are told in parts/: ray_arrays, ray_exr, ray_mesh.
"""

from pathlib import Path

from .parts import ray_arrays, ray_exr, ray_mesh
from .parts.document import Document
from .parts.lens import Lens
from .parts.program import FileWriter, ProgramFiles

READERS = ray_arrays, ray_exr, ray_mesh
BINARY = {
    ".npy": ("an array of numpy", ray_arrays.NPY), ".npz": ("a file of numpy's arrays", ray_arrays.ZIP),
    ".exr": ("an EXR image", ray_exr.MAGIC),
}  # fmt: skip
"""What files are by the ends of their names, and the bytes that such a file begins with."""


def looks(document: Document) -> bool:
    return any(kind.looks(document) for kind in READERS)


def read(document: Document) -> list[Lens]:
    return [next(kind for kind in READERS if kind.looks(document)).lens_of(document)]


def hint(document: Document) -> str | None:
    ending = Path(document.path).suffix.lower()
    if ending == ".obj":
        lost = [line.strip().decode() for line in ray_mesh.LINES if line not in b"\n" + document.data]
        return f"it is no mesh of rays: it has no lines {', '.join(lost)}" if lost else None
    kind, magic = BINARY[ending]
    if document.data.startswith(magic):
        return None
    return f"by its name it is {kind}, but it does not begin as one: it is damaged, or another file"


PROGRAM = ProgramFiles(
    "ray tables",
    "ray maps as .npz; .npy or float32 .exr of directions, also with origins; .csv and .obj of a mesh of rays", looks,
    reads="a ray for each pixel, or fewer", lost="pixel times", read=read,
    marks="x y dx dy dz", endings=(".obj", *BINARY), hint=hint,
    export=FileWriter("npz", "Ray Maps (NPZ)", "", ending=".npz"),
)  # fmt: skip
