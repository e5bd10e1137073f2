"""The passes of a tile of hits, written into parts of images: block by block, or shape by shape."""

from __future__ import annotations

import numpy as np

from ..maths.speed import whole_rows, write_where
from .hit_values import HitValues
from .hits import Hits
from .passes import PASSES


def store(hits: Hits, outs: dict[str, np.ndarray], where=None) -> None:
    """Write passes into parts of images, only where ``where``, (rows, columns) bool, is set; None for all pixels."""
    if where is not None:
        meant = {name: np.empty_like(out) for name, out in outs.items()}
        store(hits, meant)
        for name, out in outs.items():
            put(meant[name], out, where)
        return
    for window, block in hits.blocks():
        write(HitValues(block), {name: out[window] for name, out in outs.items()})


def write(values: HitValues, outs: dict[str, np.ndarray]) -> None:
    """Write passes of a block of rows into parts of images."""
    block = values.hits
    layered = {name: out for name, out in outs.items() if PASSES[name].missed is not None and block.plan.is_layered}
    with whole_rows(block.t.shape[1]):
        for name, out in outs.items():
            if name not in layered:
                PASSES[name].write(values, out)
            if (missed := PASSES[name].missed) is None or block.missed is None:
                continue
            if callable(missed):
                missed(values, out)
            elif name in layered:
                out[...] = missed
            else:
                write_where(out, missed, block.missed)
    for window, layer in block.layers() if layered else ():
        own = HitValues(layer)
        with whole_rows(layer.t.shape[1]):
            for name, out in layered.items():
                PASSES[name].write(own, out[window])


def add_combined(hits: Hits, total: np.ndarray) -> None:
    """Add the combined pass to a sum, (rows, columns, 4)."""
    for window, block in hits.blocks():
        part = total[window]
        once = hits.rays.scratch("once", part.shape, np.float64)
        write(HitValues(block), {"combined": once})
        part += once


def put(image: np.ndarray, out: np.ndarray, where) -> None:
    """Copy an image, (rows, columns[, channels]), only where ``where`` is set; None for all pixels."""
    if where is None:
        np.copyto(out, image, casting="same_kind")
    write_where(out, image, where)
