"""The settings of a port: what glass is before the lens of a camera, and what is behind it."""

from math import pi

from .settings import Choice, Item, Number, Numbers, Setting

NONE, FLAT, DOME = "NONE", "FLAT", "DOME"
STEEPEST = pi / 2 - 1e-3
"""Largest tilt of a plate, rad."""
PORT = Choice(
    "port", "Port", "Glass before the lens and what is behind it; lengths are in mm, 1/1000 of a Blender unit", NONE,
    (
        Item(NONE, "None", "Light reaches the lens straight", 0),
        Item(FLAT, "Flat Port", "A plate: an underwater housing, a fish tank, a windshield", 1),
        Item(DOME, "Dome Port", "A spherical shell around the eye: a dome port, a bubble", 2),
    ),
)  # fmt: skip
THICKNESS = Number("port_thickness", "Thickness", "Of the glass of the port", 10.0, 0.0, unit="mm")
GLASS = Number("port_glass", "Index of Glass", "Refractive index of the port's glass", 1.49, 1.0, 10.0, digits=4)
MEDIUM = Number(
    "port_medium", "Index of Medium", "Refractive index of what is behind the port", 1.333, 1.0, 10.0, digits=4
)
INSIDE = Number(
    "port_inside", "Index Inside", "Refractive index of what is between the lens and the port: air, water, oil",
    1.0, 1.0, 10.0, digits=4,
)  # fmt: skip
DISTANCE = Number(
    "port_distance", "Distance", "From the eye to the inner face of the plate, along its normal", 50.0, 0.0, unit="mm"
)
TILTS = tuple(
    Number(f"port_tilt_{axis}", f"Tilt {axis.upper()}", f"Rotation of the plate about the camera's {axis.upper()} axis",
           0.0, -STEEPEST, STEEPEST, "angle")
    for axis in "xy"
)  # fmt: skip
RADIUS = Number("port_radius", "Radius", "Of the outer face of the dome", 100.0, 0.0, unit="mm")
DECENTER = Numbers("port_decenter", "Decentering", "Center of the dome in the camera's frame, in mm: the eye is at 0",
                   (0.0, 0.0, 0.0), ("X", "Y", "Z"))  # fmt: skip
SETTINGS: dict[str, tuple[Setting, ...]] = {
    NONE: (),
    FLAT: (DISTANCE, *TILTS, THICKNESS, GLASS, MEDIUM, INSIDE),
    DOME: (RADIUS, DECENTER, THICKNESS, GLASS, MEDIUM, INSIDE),
}
"""The settings that each item of PORT reads."""
