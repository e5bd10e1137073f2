"""The setting that is a table of vectors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...arguments import shown
from ...records import BlenderCamera
from .settings import Setting


@dataclass(frozen=True)
class Vectors(Setting):
    """A table of vectors, (rows, columns, 3) from the bottom left, or None."""

    kind = "VECTORS"

    def read(self, raw: BlenderCamera) -> np.ndarray | None:
        """Return the table as float64. Raises InputError, which names the setting, for what is no such table."""
        table = self.given(raw)
        if table is None:
            return None
        try:
            vectors = np.asarray(table, np.float64)
        except (TypeError, ValueError) as error:
            raise self.refusal(raw, shown(table), "rows of equal length, of three numbers each entry") from error
        if vectors.ndim != 3 or vectors.shape[2] != 3:
            raise self.refusal(raw, f"of shape {vectors.shape}", "(rows, columns, 3)")
        return vectors

    def reported(self, raw: BlenderCamera) -> Any:
        """Return the shape of the table for a report, which would be too long with all numbers; None without one."""
        table = self.read(raw)
        return None if table is None else list(table.shape)
