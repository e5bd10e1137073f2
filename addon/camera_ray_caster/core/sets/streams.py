"""What exports hold as they go from picture to picture: what is of all pictures waits on disk."""

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import pairwise
from tempfile import TemporaryFile

import numpy as np

from ..exports import records
from ..exports.format import Each
from ..programs.parts.program import CameraRecord
from ..records import InputError
from .finished_set import View

CHUNK = 1 << 16
"""Number of characters that are read back at once."""

BUCKETS = 64
"""Number of files among which the tracks of points are divided: one of them is held at a time."""


class Waiting:
    """Parts of a text, in a file without a name."""

    def __init__(self) -> None:
        self._file = TemporaryFile("w+", encoding="utf-8")  # noqa: SIM115 (closed when it is forgotten)
        self._empty = True

    def add(self, text: str, between: str = ", ") -> None:
        """Add a part, after ``between`` unless it is the first."""
        self._file.write(text if self._empty else between + text)
        self._empty = False

    def __iter__(self) -> Iterator[str]:
        self._file.seek(0)
        return iter(partial(self._file.read, CHUNK), "")


def records_of(key: str, views: Sequence[View]) -> Sequence[CameraRecord]:
    """Return the plain records of the views of a set for a program, made at each iteration. They raise InputError for a
    camera that the program cannot represent.
    """

    def record(view: View) -> CameraRecord:
        try:
            return records(key, [view.shot])[0]
        except InputError as error:
            several = any(view.camera_name != other.camera_name for other in views)
            raise InputError(f"{error}, or export the other cameras (--cameras)") if several else error from error

    return Each(views, record)


class Tracks:
    """Which pictures see each of some points, and as which of their points."""

    def __init__(self, count: int):
        self._ends = np.linspace(0, count, BUCKETS + 1).astype(int)
        self._files = [TemporaryFile() for _ in range(BUCKETS)]  # noqa: SIM115

    def add(self, picture: int, rows: np.ndarray) -> None:
        """Add a picture that sees the points ``rows``, (m,) ascending, in this order."""
        seen = np.stack((rows, np.full(len(rows), picture), np.arange(len(rows))), axis=1).astype(np.int64)
        cuts = np.searchsorted(rows, self._ends)
        for file, first, end in zip(self._files, cuts, cuts[1:], strict=False):
            file.write(seen[first:end].tobytes())

    def __iter__(self) -> Iterator[str]:
        """Yield each point's track: picture and number, one after the other."""
        for file, first, end in zip(self._files, self._ends, self._ends[1:], strict=False):
            file.seek(0)
            seen = np.frombuffer(file.read(), np.int64).reshape(-1, 3)
            seen = seen[np.argsort(seen[:, 0], kind="stable")]
            cuts = np.searchsorted(seen[:, 0], np.arange(first, end + 1))
            for low, high in pairwise(cuts):
                yield " ".join(f"{picture} {number}" for picture, number in seen[low:high, 1:].tolist())
