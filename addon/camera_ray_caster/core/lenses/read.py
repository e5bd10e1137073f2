"""Lens files, of several programs: found out by their text, and read into a ``Prescription``."""

import os
import stat
from functools import lru_cache
from pathlib import Path

from ..records import InputError
from .files import READERS
from .optics import Optics
from .prescription import Prescription, checked

LIBRARY = Path(__file__).with_name("library")
"""The lenses that come with the package."""

DEFAULT = "double_gauss_50mm"
"""Name of the lens of a camera without a file."""

LARGEST_FILE = 1 << 22
"""Largest size of a lens file, in bytes."""


def library() -> dict[str, Path]:
    """Return the lenses that come with the package: name to file."""
    return {path.stem: path for path in sorted(LIBRARY.glob("*.*"))}


def read_lens(file: str) -> Prescription:
    """Return the prescription in a file, or of a lens of the library by its name; without a name that of DEFAULT.

    Raises InputError, which names the file and the surface, for a file that cannot be read or describes no lens.
    """
    known = library()
    path = known.get(file or DEFAULT, Path(file))
    try:
        state = os.stat(path)
    except OSError as error:
        names = "" if os.sep in file else f", and no lens of the library: {', '.join(known)}"
        raise InputError(f"lens file {file!r} cannot be read ({error.strerror}){names}") from error
    except ValueError as error:
        raise InputError(f"lens file {file!r} has no name of a file") from error
    if not stat.S_ISREG(state.st_mode):
        kind = "directory" if stat.S_ISDIR(state.st_mode) else "device"
        raise InputError(f"lens file {file!r} cannot be read: it is a {kind}, not a file")
    return _read(str(path), state.st_mtime_ns, state.st_size)


@lru_cache(maxsize=16)
def _read(path: str, modified: int, size: int) -> Prescription:
    if size > LARGEST_FILE:
        raise InputError(f"lens file {path!r} has {size} bytes: a lens has a few thousand")
    try:
        text = _text(Path(path).read_bytes())
    except OSError as error:
        raise InputError(f"lens file {path!r} cannot be read ({error.strerror})") from error
    try:
        for recognizes, read in READERS:
            if recognizes(text, path):
                lens = checked(read(text, Path(path).stem))
                Optics.of(lens.in_state(0.0))  # refused here if it does not focus
                return lens
        raise InputError("it is none of the known formats: pbrt, Optical Bench, ISETCam, Zemax, RayOptics, Optiland")
    except InputError as error:
        raise InputError(f"lens file {path!r}: {error}") from error
    except OverflowError as error:
        raise InputError(f"lens file {path!r} has a number that is too large") from error
    except RecursionError as error:
        raise InputError(f"lens file {path!r} is nested too deeply") from error


def _text(data: bytes) -> str:
    """Return a file's text: UTF-16 with a mark, UTF-8, or Latin-1."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")
