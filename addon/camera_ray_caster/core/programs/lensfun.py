"""lensfun's database, XML: lenses with a distortion for each focal length; it has no pictures.

ptlens is a, b, c of Panorama Tools, poly3 is 1 - k1 + k1 r^2, poly5 is 1 + k1 r^2 + k2 r^4, times r, in halves of the
shorter side of the sensor on which the lens was calibrated: its diagonal is that of 36 x 24 mm over the crop factor.
focal is the focal length of the ideal picture, real-focal that of the real one near the center. The frame is as
large as the sensor's diagonal, and its middle the center unless the lens has another.
Reference: lensfun documentation, The lens database; Lens distortion models.
"""

from math import hypot

from ..text_forms.xml_subset import Element
from .parts.document import Document
from .parts.fields import Fields
from .parts.lens import FRAME_SIZE, Lens, one_of_several
from .parts.panorama_tools import FISHEYE, RECTILINEAR, lens_of, ptlens
from .parts.program import ProgramFiles

PROJECTIONS = {"rectilinear": RECTILINEAR, "fisheye": FISHEYE}
MODELS = "ptlens", "poly3", "poly5"
FULL_FRAME = hypot(36.0, 24.0)


def looks(document: Document) -> bool:
    return document.xml.name == "lensdatabase"


def read(document: Document) -> list[Lens]:
    lenses = []
    for lens in document.xml.all("lens"):
        texts = Fields(document, dict(lens.texts()), lens.texts().get("model", "lens"))
        for distortion in lens.all("distortion"):
            numbers = Fields(document, dict(distortion.attributes), texts.label)
            name = f"{texts.label} {numbers.text('focal')} mm"
            lenses.append(one_of_several(name, _lens, document, numbers, texts, name, lens))
    if not lenses:
        raise document.refusal("it has no lens with a distortion")
    return lenses


def _lens(document: Document, distortion: Fields, texts: Fields, name: str, lens: Element) -> Lens:
    kind = distortion.word("model", MODELS)
    k1, k2 = (distortion.number(name, 0.0) for name in ("k1", "k2"))
    terms = {
        "ptlens": ptlens(*(distortion.number(name, 0.0) for name in "abc")),
        "poly3": [1 - k1, 0.0, k1],
        "poly5": [1.0, 0.0, k1, 0.0, k2],
    }[kind]
    focal = distortion.number("focal")
    if distortion.has("real-focal"):
        focal = distortion.number("real-focal") / (terms[0] or 1.0)
    crop, ratio = texts.number("cropfactor"), _ratio(texts)
    if min(focal, crop, ratio) <= 0:
        raise document.refusal(f"focal, cropfactor and aspect-ratio of {name} must be above 0")
    width, height = document.picture_size or (1, 1)
    pixels = hypot(width, height) / (FULL_FRAME / crop)
    half = FULL_FRAME / crop / hypot(max(ratio, 1 / ratio), 1) / 2
    model = PROJECTIONS[texts.word("type", PROJECTIONS, "rectilinear")]
    offset = lens.child("center")
    moved = Fields(document, dict(offset.attributes) if offset else {}, name)
    center = [side / 2 + moved.number(axis, 0.0) * min(width, height) / 2
              for axis, side in (("x", width), ("y", height))]  # fmt: skip
    return lens_of(name, model, dict(FRAME_SIZE), focal * pixels, (center[0], center[1]), half * pixels, terms)


def _ratio(texts: Fields) -> float:
    """Return width over height of the sensor, which a file tells as a number or as 3:2."""
    wide, _, high = texts.text("aspect-ratio", "3:2").partition(":")
    sides = Fields(texts.document, {"aspect-ratio": [wide, high or "1"]}, texts.label).numbers("aspect-ratio", 2)
    return sides[0] / sides[1] if sides[1] else 0.0


PROGRAM = ProgramFiles(
    "lensfun", "its database as .xml", looks, marks="lensdatabase lens maker model cropfactor distortion calibration",
    reads="rectilinear and fisheye with ptlens, poly3, poly5",
    lost="the size of the pictures; vignetting and color fringes; other projections are refused", read=read,
)  # fmt: skip
