"""What the formats of finished data sets are."""

from collections.abc import Callable
from typing import NamedTuple

from .finished_set import Files


class SetFormat(NamedTuple):
    """A format of data sets."""

    description: str
    files: Callable[..., Files]
    """Yields the files of a list of views."""
    splits: bool = False
    """Whether files tell the splits of views."""
    option: str = ""
    """The option of ``export.py`` that only this format has, "points" or "models"; "" without one."""
