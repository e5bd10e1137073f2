"""The calibrations of Agisoft Metashape, as XML: of one camera, or the sensors of a project's cameras.

f is in pixels, cx and cy are measured from the middle of the picture; b1 and b2 are affinity and skew. With p1 and p2
swapped its distortion is OpenCV's; a fisheye's is the same of the angle, which is COLMAP's THIN_PRISM_FISHEYE.
A sensor of a label that others have is named LABEL 1, LABEL 2, ...; metashape_poses reads where the cameras are.
Reference: Agisoft Metashape manual, appendix Camera models.
"""

from __future__ import annotations

from collections import Counter

from ..text_forms.xml_subset import Element, XmlError, tree
from .parts.document import Document
from .parts.lens import Lens, one_of_several

MODELS = {"frame": "OPENCV_PINHOLE", "fisheye": "THIN_PRISM_FISHEYE", "equidistant_fisheye": "THIN_PRISM_FISHEYE"}
TERMS = {"k1": "k1", "k2": "k2", "k3": "k3", "k4": "k4", "p1": "p2", "p2": "p1"}
"""Our settings for Metashape's coefficients."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    root = root_of(document)
    if root is None:
        return None
    if root.name == "calibration":
        return [_lens(document, "", root)]
    return [one_of_several(name, _of_sensor, document, one, name) for name, one in named_sensors(root)] or None


def root_of(document: Document) -> Element | None:
    """Return the outermost element of a file with a calibration; None of any other file. Raises InputError."""
    if not document.text.lstrip().startswith("<") or "<calibration" not in document.text:
        return None
    try:
        return tree(document.text, document.check)
    except XmlError as error:
        raise document.refusal(f"it is not XML: {error}") from error


def all_of(element: Element, name: str) -> list[Element]:
    """Return the elements of a name, in any depth."""
    found = [element] if element.name == name else []
    return found + [one for child in element.children for one in all_of(child, name)]


def named_sensors(root: Element) -> list[tuple[str, Element]]:
    """Return the sensors that have a calibration, with names of their own."""
    sensors = [one for one in all_of(root, "sensor") if any(child.name == "calibration" for child in one.children)]
    labels = [one.attributes.get("label") or one.attributes.get("id", "") for one in sensors]
    total, count = Counter(labels), Counter[str]()
    named = []
    for label, sensor in zip(labels, sensors, strict=True):
        count[label] += 1
        named.append((label if total[label] == 1 else f"{label} {count[label]}", sensor))
    return named


def _of_sensor(document: Document, sensor: Element, name: str) -> Lens:
    own = [child for child in sensor.children if child.name == "calibration"]
    adjusted = [one for one in own if one.attributes.get("class") == "adjusted"]
    return _lens(document, name, (adjusted or own)[0])


def _lens(document: Document, name: str, calibration: Element) -> Lens:
    entries = {child.name: child.text for child in calibration.children}
    sides = next((child.attributes for child in calibration.children if child.name == "resolution"), entries)
    kind = calibration.attributes.get("type") or entries.get("projection") or "frame"
    model = MODELS[document.one_of(kind, "projection", MODELS)]
    width, height = document.number(sides, "width"), document.number(sides, "height")
    focal = document.number(entries, "f")
    settings = document.size(width, height) | {
        "fx": focal + document.number(entries, "b1", 0.0), "fy": focal, "skew": document.number(entries, "b2", 0.0),
        "cx": width / 2 - 0.5 + document.number(entries, "cx", 0.0),
        "cy": height / 2 - 0.5 + document.number(entries, "cy", 0.0),
    }  # fmt: skip
    settings |= {own: document.number(entries, theirs, 0.0) for theirs, own in TERMS.items()}
    unread = [one for one in ("p3", "p4", *(("k4",) if kind == "frame" else ())) if document.number(entries, one, 0.0)]
    if unread:
        raise document.refusal(f"its {', '.join(unread)} of a {kind} camera is not 0, which no model here has")
    if kind == "frame":
        del settings["k4"]
    return Lens(name, model, settings)
