"""Rational polynomials of satellites, RPC00B: as text, also of GDAL, as .RPB, and in the XML of Maxar and DIMAP.

Line and sample are quotients of cubic polynomials of latitude, longitude and height (WGS 84), each less its offset and
over its scale; the center of the first pixel is (0, 0), in DIMAP (1, 1). A picture without a size, which XML has, is as
large as offset and scale together. It becomes
a table of rays in local axes, x east, y north, z up, in meters from the offsets of longitude, latitude and height. A
ray leads straight through its places at the file's largest and least height: a file whose rays leave their pixels by
more than STRAIGHT half way is refused. The table's own error is among the facts of the camera.
References: NIMA, The Compendium of Controlled Extensions for NITF: RPC00B; GDAL documentation, RPCs in GeoTIFF;
DigitalGlobe, Imagery Support Data Documentation; Airbus, Pleiades Imagery User Guide.
"""

import re
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from .parts.document import Document
from .parts.earth import axes_at, place_of
from .parts.lens import Lens
from .parts.program import ProgramFiles
from .parts.ray_arrays import sampled

ENTRY = re.compile(r"^[ \t]*([A-Za-z_]+(?:_\d+)?)[ \t]*[:=][ \t]*(\([^()]*\)|[^\n;]+)", re.MULTILINE)
GROUND, PICTURE = ("LONG", "LAT", "HEIGHT"), ("SAMP", "LINE")
MARK = re.compile("samp_?off", re.IGNORECASE)
MAXAR, DIMAP = ("IMD", "IMAGE"), ("Direct_Model_Validity_Domain", "Inverse_Model", "RFM_Validity")
SIDES = ("NUMROWS", "NUMCOLUMNS"), ("LASTROW", "LASTCOL")
"""Elements with entries, and the entries that are the picture's size: of Maxar and of DIMAP."""
TERMS = 20
STRAIGHT = 0.05
"""Largest distance in pixels between a ray and the polynomials half way."""
STEP, NEWTON_STEPS, NEAR = 1e-5, 8, 1e-15
"""Of Newton's method with differences, in scaled longitude and latitude: each step gains five digits, until all pixels
are this near. Where a pixel is not seen, all steps are made.
"""


class Rational(NamedTuple):
    """The entries of a file: their texts by their names in capitals without _, and what its kind of file has."""

    texts: dict[str, str]
    sides: tuple[str | None, str | None] = (None, None)
    """Samples and lines of the picture."""
    first: float = 0.0
    """Number of the first line and sample."""


def looks(document: Document) -> bool:
    return bool(MARK.search(document.text)) and f"LINENUMCOEFF{TERMS}" in _rational(document).texts


def _rational(document: Document) -> Rational:
    """Return the entries of a file of any kind. Lists of coefficients are entries with numbers."""
    if not document.text.lstrip().startswith("<"):
        return Rational(_by_name(ENTRY.findall(document.text)))
    top = document.xml
    is_dimap = top.name == "Dimap_Document"
    parts = [element for name in (DIMAP if is_dimap else MAXAR) for element in top.all(name)]
    texts = _by_name((leaf.name, leaf.text) for element in parts for group in (element, *element.children)
                     for leaf in group.children)  # fmt: skip
    rows, columns = SIDES[is_dimap]
    return Rational(texts, (texts.get(columns), texts.get(rows)), float(is_dimap))


def _by_name(entries: Iterable[tuple[str, str]]) -> dict[str, str]:
    texts: dict[str, str] = {}
    for name, text in entries:
        name, words = name.upper().replace("_", "").replace("OFFSET", "OFF"), text.strip("()").replace(",", " ").split()
        if name.endswith(("COEF", "COEFF")):
            texts |= {f"{name.rstrip('F')}FF{i}": term for i, term in enumerate(words, 1)}
        texts[name] = words[0] if words else ""
    return texts


def read(document: Document) -> list[Lens]:
    rational = _rational(document)

    def number(name: str) -> float:
        text = rational.texts.get(name.replace("_", ""))
        return document.numbers(text if text is None else [text], name, 1)[0]

    offset, scale = (np.array([number(f"{name}_{kind}") for name in (*GROUND, *PICTURE)]) for kind in ("OFF", "SCALE"))
    offset[3:] -= rational.first
    terms = np.array([[[number(f"{name}_{kind}_COEFF_{i}") for i in range(1, TERMS + 1)] for kind in ("NUM", "DEN")]
                      for name in PICTURE])  # fmt: skip
    sides = [round(side) if text is None else round(document.numbers([text], "size of the picture", 1)[0])
             for side, text in zip((offset + scale)[3:], rational.sides, strict=True)]  # fmt: skip
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
        for _ in range(NEWTON_STEPS):
            short = pixel(x, y, height) - wanted
            if np.abs(short).max() < NEAR:
                break
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
    xx, yy, zz = x * x, y * y, z * z
    return [
        np.ones_like(x), x, y, z, x * y, x * z, y * z, xx, yy, zz, x * y * z, xx * x, x * yy, x * zz, xx * y, yy * y,
        y * zz, xx * z, yy * z, zz * z,
    ]  # fmt: skip


PROGRAM = ProgramFiles(
    "RPC", "rational polynomials of satellites: _RPC.TXT, .RPB, XML of Maxar and DIMAP", looks,
    marks="LINE_OFF SAMP_OFF LAT_OFF LONG_OFF HEIGHT_OFF LINE_NUM_COEFF_1 SAMP_DEN_COEFF_20", reads="RPC00B",
    lost="the size of the picture, except in XML: it is taken as offset and scale together", read=read,
)  # fmt: skip
