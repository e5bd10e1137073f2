"""The settings of a real lens, beside Blender's focal length, focus distance, f-stop and sensor."""

from ...lenses.prescription import D_LINE
from .settings import Choice, FilePath, Flag, Item, Number

LENS_FILE = FilePath(
    "lens_file", "Lens File", "Prescription of the lens: of pbrt, Optical Bench, ISETCam, Zemax, RayOptics or "
    "Optiland, or the name of a lens that comes with the add-on. If empty, a double Gauss lens", "",
)  # fmt: skip
PARAXIAL = "PARAXIAL"
FOCUS = Choice(
    "lens_focus", "Focus", "Where the film stands for the focus distance", "SHARPEST",
    (
        Item("SHARPEST", "Sharpest", "Where a point on the axis has the least blur, for the f-stop", 0),
        Item(PARAXIAL, "Paraxial", "Where rays close to the axis meet, as in other programs", 1),
    ),
)  # fmt: skip
STATE = Number(
    "lens_state", "Configuration", "Of a zoom lens or of floating elements: 0 is the first of the file; between two "
    "configurations, gaps are interpolated", 0.0, 0.0, 100.0,
)  # fmt: skip
WAVELENGTH = Number(
    "lens_wavelength", "Wavelength", "Of the light, in nm, if the file has the dispersion of its glasses", D_LINE,
    350.0, 1100.0,
)  # fmt: skip
COLOR = Flag(
    "lens_color", "Chromatic Aberration", "With depth of field, trace red, green and blue light (610, 546 and 450 nm) "
    "apart, if the file has the dispersion of its glasses; it takes three times as many samples", False,
)  # fmt: skip
COLORS = 610.0, 546.0, 450.0
"""Wavelengths of red, green and blue light in nm."""
VIGNETTING = Flag(
    "lens_vignetting", "Vignetting", "Rays that a rim stops are dark; otherwise the others make up for them", True
)
FALLOFF = Flag(
    "lens_falloff", "Natural Falloff", "Light in proportion to the fourth power of the cosine at the film", True
)
