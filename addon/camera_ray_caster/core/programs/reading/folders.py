"""Folders with a file for each picture: Polycam's cameras, the clips of HOT3D, and the intrinsics of ARKitScenes.

A clip's file has the number of its frame; the others are in the order of the times in their names, from frame 1 on.
References: polyform, Polycam's data format; HOT3D documentation, HOT3D-Clips; ARKitScenes, tenFpsDataLoader.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ...records import InputError

CLIP, PINCAM, TRAJECTORY = ".cameras.json", ".pincam", ".traj"
FILES = (
    (f"*{CLIP}", ("",)),
    (f"*{PINCAM}", ("", "lowres_wide_intrinsics")),
    ("[0-9]*.json", ("", *(f"{one}{kind}" for one in ("keyframes/", "") for kind in ("corrected_cameras", "cameras")))),
)
"""Names of files, and the folders in which they are looked for."""

NEAR = 5e-3
"""Seconds by which the times of a picture and its pose may differ."""


def files_in(folder: Path) -> list[Path]:
    """Return the files of a folder's pictures in the order of the numbers in their names, and then the trajectory of
    ARKitScenes, which has their poses; [] for any other folder. Raises InputError if that trajectory is missing.
    """
    for pattern, inside in FILES:
        for one in inside:
            found = sorted((folder / one).glob(pattern), key=number_of)
            if found and found[0].suffix == PINCAM:
                beside = [*(folder / one).parent.glob(f"*{TRAJECTORY}"), *(folder / one).glob(f"*{TRAJECTORY}")]
                if len(beside) != 1:
                    raise InputError(f"folder {str(folder)!r} has {len(beside)} trajectories ({TRAJECTORY}) beside its "
                                     f"files ({PINCAM}): there must be one, with their poses")  # fmt: skip
                found += beside
            if found:
                return found
    return []


def number_of(file: Path) -> float:
    """Return the last number in the name of a file: a time or a frame."""
    numbers = re.findall(r"\d+(?:\.\d+)?", file.name.removesuffix(file.suffix).removesuffix(".cameras"))
    return float(numbers[-1]) if numbers else 0.0


def nearest(times: np.ndarray, time: float) -> int | None:
    """Return the index of the time of a trajectory that is nearest to a time; None if none is within NEAR."""
    index = int(np.argmin(np.abs(times - time)))
    return index if abs(times[index] - time) < NEAR else None
