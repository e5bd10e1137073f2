"""NVIDIA's f-theta cameras, as JSON: the sensors of a DriveWorks rig, and the camera models of NCore and NuRec.

A rig has rig.sensors, whose properties have Model ftheta, a polynomial with its polynomial-type (or bw-poly, which is
from pixel distance to angle), and linear-c, -d and -e. NCore has both polynomials, a reference_poly that names the one
that is the model, and linear_cde. NCore's parameters are the whole file, its camera_model_parameters, or entries of
NuRec's camera_calibrations. All polynomials begin with the constant. A windshield before the lens is refused.
The center of the first pixel is (0, 0).
References: NVIDIA DriveWorks SDK documentation, Rig Configuration; NVIDIA NCore documentation, Camera Models.
"""

from __future__ import annotations

from .parts.document import Document
from .parts.lens import Lens, mapping, one_of_several

REFERENCES = {
    "angle-to-pixeldistance": "ANGLE_TO_RADIUS",
    "pixeldistance-to-angle": "RADIUS_TO_ANGLE",
    "ANGLE_TO_PIXELDIST": "ANGLE_TO_RADIUS",
    "PIXELDIST_TO_ANGLE": "RADIUS_TO_ANGLE",
}
"""Names of the polynomial that is the model, in the files of both families, and our key of it."""


def read(document: Document, key: str) -> list[Lens] | None:
    """Return the lenses of a document; see the package."""
    rig, calibrations = mapping(document.raw.get("rig")), mapping(document.raw.get("camera_calibrations"))
    if "sensors" in rig:
        sensors = rig["sensors"] if isinstance(rig["sensors"], list) else []
        cameras = [one for one in map(mapping, sensors) if mapping(one.get("properties")).get("Model") == "ftheta"]
        if not cameras:
            raise document.refusal("none of its sensors has properties with the Model 'ftheta'")
        named = [(str(camera.get("name", "")), camera["properties"]) for camera in cameras]
        return [one_of_several(name, _of_rig, document, name, properties) for name, properties in named]
    if calibrations:
        named = [(str(mapping(one).get("logical_sensor_name", key)), mapping(one)) for key, one in calibrations.items()]
        return [one_of_several(name, _of_nurec, document, name, calibration) for name, calibration in named]
    for parameters in (document.raw, mapping(document.raw.get("camera_model_parameters"))):
        if "reference_poly" in parameters:
            return [_of_parameters(document, "", parameters)]
    return None


def _of_rig(document: Document, name: str, properties: dict) -> Lens:
    kind, entry = str(properties.get("polynomial-type")), "polynomial"
    if "polynomial" not in properties and "bw-poly" in properties:
        kind, entry = "pixeldistance-to-angle", "bw-poly"
    center = [document.number(properties, one) for one in ("cx", "cy")]
    linear = [document.number(properties, f"linear-{one}", plain) for one, plain in zip("cde", (1, 0, 0), strict=True)]
    sides = [document.number(properties, one) for one in ("width", "height")]
    polynomial = str(properties.get(entry, "")).split()
    return _lens(document, name, "polynomial-type", kind, (polynomial, f"{entry} of {name}"), center, linear, sides)


def _of_nurec(document: Document, name: str, calibration: dict) -> Lens:
    model = mapping(calibration.get("camera_model"))
    if model.get("type") != "ftheta":
        raise document.refusal(f"camera_model of {name} is of type {model.get('type')!r}: it must be 'ftheta'")
    return _of_parameters(document, name, mapping(model.get("parameters")))


def _of_parameters(document: Document, name: str, parameters: dict) -> Lens:
    if parameters.get("external_distortion_parameters"):
        raise document.refusal("it has external_distortion_parameters, of a windshield: they must be null")
    kind = str(parameters.get("reference_poly"))
    entry = {"ANGLE_TO_RADIUS": "angle_to_pixeldist_poly"}.get(REFERENCES.get(kind, ""), "pixeldist_to_angle_poly")
    center, linear, sides = (
        document.numbers(parameters.get(one, default), one, count)
        for one, default, count in (("principal_point", None, 2), ("linear_cde", [1, 0, 0], 3), ("resolution", None, 2))
    )
    lens = _lens(document, name, "reference_poly", kind, (parameters.get(entry), entry), center, linear, sides)
    widest = {"ftheta_max_angle": document.number(parameters, "max_angle")} if "max_angle" in parameters else {}
    return lens._replace(settings=lens.settings | widest)


def _lens(document: Document, name: str, field: str, kind: str, polynomial, center, linear, sides) -> Lens:
    if kind not in REFERENCES:
        said = f"{field} of {name or 'the camera'} is {kind!r}"
        raise document.refusal(f"{said}: it must be one of {', '.join(REFERENCES)}")
    numbers = document.numbers(*polynomial)
    return Lens(name, "FTHETA", document.size(*sides) | {
        "cx": center[0], "cy": center[1],
        "ftheta_reference": REFERENCES[kind], f"ftheta_{REFERENCES[kind].lower()}": " ".join(map(repr, numbers)),
        **{f"ftheta_{one}": number for one, number in zip("cde", linear, strict=True)},
    })  # fmt: skip
