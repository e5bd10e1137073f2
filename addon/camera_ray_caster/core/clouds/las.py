"""LAS 1.4, point record format 6, with extra bytes for the fields that it does not have.

Coordinates are whole multiples of a tenth of a millimeter, or of what the extent needs. GPS time is the time of the
points in seconds; intensity is the reflectance times 65,535.
Reference: ASPRS, LAS Specification 1.4 - R15.
"""

import struct

import numpy as np

from ..records import InputError
from .cloud import PointCloud

SCALE = 1e-4
EXTRA = {
    "ring": (3, "<u2"), "column": (5, "<u4"), "instance": (5, "<u4"), "range": (9, "<f4"), "true range": (9, "<f4"),
    "incidence": (9, "<f4"), "normal x": (9, "<f4"), "normal y": (9, "<f4"), "normal z": (9, "<f4"),
}  # fmt: skip
"""Names, types in the file, and types in numpy."""

POINT = [
    ("X", "<i4"), ("Y", "<i4"), ("Z", "<i4"), ("intensity", "<u2"), ("returns", "u1"), ("flags", "u1"),
    ("classification", "u1"), ("user", "u1"), ("angle", "<i2"), ("source", "<u2"), ("gps_time", "<f8"),
]  # fmt: skip


def las(cloud: PointCloud, points: np.ndarray, normals: np.ndarray) -> bytes:
    """Return a file. Raises InputError for categories that LAS cannot store, those above 255."""
    if len(cloud) and not 0 <= cloud.category.min() <= cloud.category.max() <= 255:
        raise InputError(
            f"LAS has classes from 0 to 255, and the points have categories from {cloud.category.min()} to "
            f"{cloud.category.max()}: change pass indices or categories"
        )
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else np.zeros((2, 3))
    offset = np.floor((low + high) / 2)
    scale = np.maximum(SCALE, np.abs(np.stack((low, high)) - offset).max(axis=0) / (2**31 - 2))
    records = np.zeros(len(points), [*POINT, *((name, kind) for name, (_, kind) in EXTRA.items())])
    for axis, name in enumerate("XYZ"):
        records[name] = np.rint((points[:, axis] - offset[axis]) / scale[axis])
        records[f"normal {name.lower()}"] = normals[:, axis]
    records["intensity"] = np.rint(65535 * np.clip(cloud.reflectance, 0, 1))
    records["returns"] = 0x11  # the first of one
    records["classification"], records["gps_time"] = cloud.category, cloud.time
    for name in ("ring", "column", "instance", "range", "incidence"):
        records[name] = getattr(cloud, name)
    records["true range"] = cloud.true_range
    extra = b"".join(
        struct.pack("<2xBB32s4x120x32s", kind, 0, name.encode(), b"") for name, (kind, _) in EXTRA.items()
    )
    vlr = struct.pack("<H16sHH32s", 0, b"LASF_Spec", 4, len(extra), b"") + extra
    header = struct.pack(
        "<4sHH16sBB32s32sHHHIIBHI5I", b"LASF", 0, 16, b"", 1, 4, b"", b"Camera Ray Caster", 0, 0, 375,
        375 + len(vlr), 1, 6, records.dtype.itemsize, 0, 0, 0, 0, 0, 0,
    )  # fmt: skip
    stored = np.stack([records[name] for name in "XYZ"], axis=1) * scale + offset if len(points) else np.zeros((1, 3))
    ends = np.stack((stored.max(axis=0), stored.min(axis=0)), axis=1).ravel()
    header += struct.pack("<6d6dQQIQ15Q", *scale, *offset, *ends, 0, 0, 0, len(points), len(points), *[0] * 14)
    return header + vlr + records.tobytes()
