"""Rational polynomials of satellites, RPC00B: _RPC.TXT and _rpc.txt, lines NAME: number.

Line and sample are quotients of cubic polynomials of latitude, longitude and height (WGS 84), each less its offset and
over its scale; the center of the first pixel is (0, 0). A picture is as large as offset and scale together. It becomes
a table of rays in local axes, x east, y north, z up, in meters from the offsets of longitude, latitude and height. A
ray leads straight through its places at the file's largest and least height: a file whose rays leave their pixels by
more than STRAIGHT half way is refused. The table's own error is among the facts of the camera.
References: NIMA, The Compendium of Controlled Extensions for NITF: RPC00B; GDAL documentation, RPCs in GeoTIFF.
"""

from __future__ import annotations

import re

import numpy as np

from .parts.document import Document
from .parts.earth import axes_at, place_of
from .parts.lens import Lens
from .parts.program import ProgramFiles
from .parts.ray_arrays import sampled

LINE = re.compile(r"([A-Z_]+[A-Z](?:_\d+)?)\s*[:=]\s*(\S+)")
GROUND, PICTURE = ("LONG", "LAT", "HEIGHT"), ("SAMP", "LINE")
TERMS = 20
STRAIGHT = 0.05
"""Largest distance in pixels between a ray and the polynomials half way."""
STEP, STEPS = 1e-5, 8
"""Of Newton's method with differences, in scaled longitude and latitude: each step gains five digits."""


def looks(document: Document) -> bool:
    """See ProgramFiles."""
    return "SAMP_OFF" in document.text and document.text.count("_NUM_COEFF_") >= TERMS


def read(document: Document) -> list[Lens]:
    """See ProgramFiles."""
    texts = {found[1]: [found[2]] for line in document.lines() if (found := LINE.match(line))}

    def number(name: str) -> float:
        return document.numbers(texts.get(name), name, 1)[0]

    offset, scale = (np.array([number(f"{name}_{kind}") for name in (*GROUND, *PICTURE)]) for kind in ("OFF", "SCALE"))
    terms = np.array([[[number(f"{name}_{kind}_COEFF_{i}") for i in range(1, TERMS + 1)] for kind in ("NUM", "DEN")]
                      for name in PICTURE])  # fmt: skip
    sides = [round(side) for side in (offset + scale)[3:]]
    if min(scale) <= 0 or min(sides) < 1:
        raise document.refusal("its scales must be above 0, and so must offset and scale of the picture together")
    middle = place_of(np.radians(offset[0]), np.radians(offset[1]), offset[2])
    axes = axes_at(middle)

    def pixel(x, y, height):
        powers = np.stack(_terms(x, y, height), axis=-1)
        return (powers @ terms[:, 0].T) / (powers @ terms[:, 1].T)

    def seen(wanted, height):
        """Return the scaled longitude and latitude of pixels at a height, by Newton's method."""
        x = y = np.zeros(wanted.shape[:-1])
        for _ in range(STEPS):
            short = pixel(x, y, height) - wanted
            by_x, by_y = ((pixel(x + dx, y + dy, height) - pixel(x - dx, y - dy, height)) / (2 * STEP)
                          for dx, dy in ((STEP, 0.0), (0.0, STEP)))  # fmt: skip
            volume = by_x[..., 0] * by_y[..., 1] - by_x[..., 1] * by_y[..., 0]
            x = x - (short[..., 0] * by_y[..., 1] - short[..., 1] * by_y[..., 0]) / volume
            y = y - (short[..., 1] * by_x[..., 0] - short[..., 0] * by_x[..., 1]) / volume
        is_seen = np.abs(pixel(x, y, height) - wanted).max(axis=-1) * scale[3:].max() < STRAIGHT
        return np.where(is_seen, x, np.nan), np.where(is_seen, y, np.nan)

    def rays(sample, line):
        wanted = (np.stack((sample, line), axis=-1) - offset[3:]) / scale[3:]
        with np.errstate(all="ignore"):  # what is not seen is NaN
            high, low = seen(wanted, 1.0), seen(wanted, -1.0)
            half = pixel((high[0] + low[0]) / 2, (high[1] + low[1]) / 2, 0.0) - wanted
            away = np.nanmax(np.abs(half) * scale[3:], initial=0.0)
        if away > STRAIGHT or np.isnan(half).all():
            raise document.refusal(
                f"its rays are bent by {away:.3g} pixels: up to {STRAIGHT:g} are read" if away else "no pixel has a ray"
            )
        top, bottom = (
            (place_of(np.radians(x * scale[0] + offset[0]), np.radians(y * scale[1] + offset[1]), height) - middle)
            @ axes.T for (x, y), height in ((high, offset[2] + scale[2]), (low, offset[2] - scale[2]))
        )  # fmt: skip
        directions = bottom - top
        ahead = np.nanmean(directions, axis=(0, 1))  # origins on a plane across the rays: none is behind its neighbor
        behind = (np.nanmin(top @ ahead) - top @ ahead) / (directions @ ahead)
        return directions, top + behind[..., None] * directions

    return [sampled(document, sides, rays, "BLENDER")]


def _terms(x, y, z) -> list[np.ndarray]:
    """Return the terms of a polynomial in their order; x is the longitude, y the latitude, z the height."""
    x, y, z = np.broadcast_arrays(x, y, z)
    return [
        np.ones_like(x), x, y, z, x * y, x * z, y * z, x * x, y * y, z * z, x * y * z, x**3, x * y * y, x * z * z,
        x * x * y, y**3, y * z * z, x * x * z, y * y * z, z**3,
    ]  # fmt: skip


PROGRAM = ProgramFiles(
    "RPC", "rational polynomials of satellites as text, _RPC.TXT, _rpc.txt", looks,
    marks="LINE_OFF SAMP_OFF LAT_OFF LONG_OFF HEIGHT_OFF LINE_NUM_COEFF_1 SAMP_DEN_COEFF_20", reads="RPC00B",
    lost="the size of the picture: it is taken as offset and scale together", read=read,
)  # fmt: skip
