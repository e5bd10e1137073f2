"""The passes of a tile of hits, written into parts of images: block by block, or shape by shape."""

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
            write_where(out, meant[name], where)
        return
    layered = [name for name in outs if PASSES[name].missed is not None and hits.windows is not None]
    for window, block in hits.blocks():
        values = HitValues(block)
        with whole_rows(block.t.shape[1]):
            for name, out in outs.items():
                if name not in layered:
                    PASSES[name].write(values, out[window])
                _write_missed(name, values, out[window], name in layered)
    for window, layer in hits.layers() if layered else ():
        values = HitValues(layer)
        with whole_rows(layer.t.shape[1]):
            for name in layered:
                PASSES[name].write(values, outs[name][window])


def _write_missed(name: str, values: HitValues, out: np.ndarray, everywhere: bool) -> None:
    """Write what a pass of surfaces is where nothing is hit, or ``everywhere`` if there are such pixels."""
    missed = PASSES[name].missed
    if missed is None or values.hits.missed is None:
        return
    if callable(missed):
        missed(values, out)
    elif everywhere:
        out[...] = missed
    else:
        write_where(out, missed, values.hits.missed)


def add_combined(hits: Hits, total: np.ndarray) -> None:
    """Add the combined pass to a sum, (rows, columns, 4), its colors multiplied by the rays' light; rays without a
    direction are then black and opaque, since the lens is in their way.
    """
    light = hits.rays.light
    parts = light if isinstance(light, tuple) else (light,)
    lights = None if light is None else np.stack([np.broadcast_to(color, total.shape[:2]) for color in parts], axis=-1)
    for window, block in hits.blocks():
        in_window = total[window]
        once = hits.rays.scratch("once", in_window.shape, np.float64)
        store(block, {"combined": once})
        if lights is not None:
            dark = np.broadcast_to(np.isnan(block.rays.direction[0]), in_window.shape[:2])
            once[..., :3] *= np.where(dark[..., None], 0.0, lights[window])
            once[..., 3][dark] = 1.0
        in_window += once
