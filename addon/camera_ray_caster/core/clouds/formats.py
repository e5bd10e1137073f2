"""Point clouds as files: each format yields the endings of its files and their contents, little endian.

PLY, PCD, LAS and NPZ have all fields of a cloud; KITTI and nuScenes have those of their own files. Their intensity is
the reflectance. KITTI, nuScenes and LAS have meters, the others Blender units, with the length of one. PCD keeps the
grid of rows, from the top, and columns, with NaN for misses; other files have the points in the order of their times.
References: G. Turk, The PLY Polygon File Format; Point Cloud Library, The PCD File Format; SemanticKITTI and nuScenes
development kits.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from io import BytesIO
from typing import Any

import numpy as np

from ..arguments import chosen
from ..records import InputError
from ..units import BLENDER_UNITS, METERS, Unit, factor, unit_name
from .cloud import SENSOR, PointCloud
from .las import las

PLY_TYPES = {"<f4": "float", "<f8": "double", "<i4": "int"}
"""The ring is an int, too, since readers do not know properties of type ushort."""
NUSCENES_FROM_SENSOR = np.array(((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
"""From the sensor's axes to x right, y ahead, z up."""

Files = Iterator[tuple[str, bytes]]


def _placed(cloud: PointCloud, axes: str) -> tuple[np.ndarray, np.ndarray]:
    """Return points and normals in one of AXES, (n, 3) each."""
    return (cloud.sensor, cloud.sensor_normal) if axes == SENSOR else (cloud.world, cloud.normal)


def _table(cloud: PointCloud, axes: str, ring: str = "<u2") -> np.ndarray:
    """Return the fields of the points, (n,) records. Places in the world have 64 bits: they may be far from 0."""
    points, normals = _placed(cloud, axes)
    real = "<f4" if axes == SENSOR else "<f8"
    columns = {name: (points[:, k], real) for k, name in enumerate("xyz")}
    columns |= {f"n{name}": (normals[:, k], "<f4") for k, name in enumerate("xyz")}
    for name in ("reflectance", "incidence", "range", "true_range"):
        columns[name] = getattr(cloud, name), "<f4"
    columns["time"] = cloud.time, "<f8"
    columns["ring"] = cloud.ring, ring
    for name in ("column", "instance", "category"):
        columns[name] = getattr(cloud, name), "<i4"
    table = np.zeros(len(cloud), [(name, kind) for name, (_, kind) in columns.items()])
    for name, (values, _) in columns.items():
        table[name] = values
    return table


def _ply(cloud: PointCloud, axes: str) -> Files:
    table = _table(cloud, axes, ring="<i4")
    kinds = [(name, PLY_TYPES[table.dtype[name].str]) for name in table.dtype.names or ()]
    head = "".join(f"property {kind} {name}\n" for name, kind in kinds)
    text = f"ply\nformat binary_little_endian 1.0\ncomment {_units(cloud)}\n"
    text += f"element vertex {len(table)}\n{head}end_header\n"
    yield ".ply", text.encode() + table.tobytes()


def _pcd(cloud: PointCloud, axes: str) -> Files:
    table, (width, height) = _table(cloud, axes), cloud.size
    grid = np.zeros((height, width), table.dtype)
    for name in table.dtype.names or ():
        if table.dtype[name].kind == "f":
            grid[name] = np.nan
    grid[height - 1 - cloud.row, cloud.column] = table
    kinds = [table.dtype[name] for name in table.dtype.names or ()]
    lines = (
        "# .PCD v0.7 - Point Cloud Data file format", f"# {_units(cloud)}", "VERSION 0.7",
        f"FIELDS {' '.join(table.dtype.names or ())}",
        f"SIZE {' '.join(str(kind.itemsize) for kind in kinds)}",
        f"TYPE {' '.join(kind.kind.upper() for kind in kinds)}", f"COUNT {' '.join('1' for _ in kinds)}",
        f"WIDTH {width}", f"HEIGHT {height}", "VIEWPOINT 0 0 0 1 0 0 0", f"POINTS {width * height}", "DATA binary\n",
    )  # fmt: skip
    yield ".pcd", "\n".join(lines).encode() + grid.tobytes()


def _kitti(cloud: PointCloud, axes: str) -> Files:
    for name, values in (("category", cloud.category), ("instance", cloud.instance)):
        if len(cloud) and not 0 <= values.min() <= values.max() < 1 << 16:
            raise InputError(
                f"labels of SemanticKITTI have 16 bits, and a point has the {name} {values.max()}: give categories and "
                "shapes numbers up to 65535, or choose another format"
            )
    points, _ = _placed(cloud, axes)
    yield ".bin", np.column_stack((points, np.clip(cloud.reflectance, 0, 1))).astype("<f4").tobytes()
    yield ".label", (cloud.category.astype("<u4") | cloud.instance.astype("<u4") << 16).tobytes()


def _nuscenes(cloud: PointCloud, axes: str) -> Files:
    points, _ = _placed(cloud, axes)
    points = points @ NUSCENES_FROM_SENSOR.T if axes == SENSOR else points
    numbers = np.zeros(len(cloud), int)
    for category in np.unique(cloud.category):
        selected = cloud.category == category
        numbers[selected] = np.unique(cloud.instance[selected], return_inverse=True)[1] + 1
    if len(cloud) and not (0 <= cloud.category.min() <= cloud.category.max() < 65 and numbers.max() < 1000):
        raise InputError(
            f"panoptic labels of nuScenes have categories up to 64 and 999 instances of each, and the points have "
            f"category {cloud.category.max()} and {numbers.max()} instances: choose another format"
        )
    intensity = 255 * np.clip(cloud.reflectance, 0, 1)
    yield ".pcd.bin", np.column_stack((points, intensity, cloud.ring)).astype("<f4").tobytes()
    yield "_lidarseg.bin", cloud.category.astype("u1").tobytes()
    yield "_panoptic.npz", _npz_bytes(data=(1000 * cloud.category + numbers).astype("<u2"))


def _las(cloud: PointCloud, axes: str) -> Files:
    yield ".las", las(cloud, *_placed(cloud, axes))


def _npz(cloud: PointCloud, axes: str) -> Files:
    points, normals = _placed(cloud, axes)
    names = "range", "true_range", "row", "column", "ring", "time", "instance", "category", "incidence", "reflectance"
    values = {name: getattr(cloud, name) for name in names}
    yield "_points.npz", _npz_bytes(points=points, normals=normals, pose=cloud.pose, size=np.array(cloud.size),
                                     meters=cloud.meters, **values)  # fmt: skip


def _npz_bytes(**arrays: Any) -> bytes:
    content = BytesIO()
    np.savez(content, **arrays)
    return content.getvalue()


POINT_FORMATS: dict[str, tuple[Callable[[PointCloud, str], Files], Unit]] = {
    "ply": (_ply, BLENDER_UNITS), "pcd": (_pcd, BLENDER_UNITS), "kitti": (_kitti, METERS),
    "nuscenes": (_nuscenes, METERS), "las": (_las, METERS), "npz": (_npz, BLENDER_UNITS),
}  # fmt: skip
"""Functions of a cloud and one of AXES, and units of lengths, by the keys of their formats."""
ENDINGS = {".pcd.bin": "nuscenes", ".ply": "ply", ".pcd": "pcd", ".bin": "kitti", ".las": "las", ".npz": "npz"}
"""Formats by the ends of their files' names; the first one that fits counts."""
IN_WORDS = "PLY, PCD, KITTI with SemanticKITTI's labels, nuScenes, LAS or NPZ"
SEQUENCED = "kitti"
"""Key of the format that has sequences; see ``sequences``."""


def _units(cloud: PointCloud) -> str:
    """Return a comment on the unit of lengths."""
    return f"lengths are in {unit_name(BLENDER_UNITS)} of {cloud.meters:.6g} m"


def _in_unit(cloud: PointCloud, unit: Unit) -> PointCloud:
    """Return a cloud with its lengths in a unit."""
    size = factor(unit, cloud.meters)
    if size == 1:
        return cloud
    pose = cloud.pose.copy()
    pose[:3, 3] *= size
    lengths = {name: size * getattr(cloud, name) for name in ("sensor", "world", "range", "true_range")}
    return replace(cloud, pose=pose, meters=cloud.meters / size, **lengths)


def files_of(cloud: PointCloud, key: str, axes: str = SENSOR) -> Files:
    """Return the endings and contents of a cloud's files in a format. Raises InputError for an unknown format, and for
    numbers that it cannot store.
    """
    files, unit = POINT_FORMATS[chosen(key, "format of points", POINT_FORMATS)]
    return files(_in_unit(cloud, unit), axes)
