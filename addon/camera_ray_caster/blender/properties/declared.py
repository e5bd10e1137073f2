"""The add-on's settings in a .blend: those of objects and scenes are declared here, those of cameras in core.

Each item of a choice has its number in files: it is never changed and never used again.
"""

from ...core.camera import pixel_time
from ...core.cameras import MODELS
from ...core.cameras.model import GROUPS
from ...core.cameras.parts.settings import OWN, Choice, Flag, Item, Whole

GROUP = "camera_ray_caster"
"""The name of the property groups: ``camera.camera_ray_caster``, ``object.``, ``scene.`` likewise."""

ENGINE = "CAMERA_RAY_CASTER"
"""The identifier of the render engine."""

BLENDERS_OWN = "BLENDER"
"""The item of MODEL for the model that Blender's camera type names."""

MODEL = Choice(
    "model", "Model", "How the camera maps rays to pixels",
    BLENDERS_OWN,
    (
        Item(BLENDERS_OWN, "Blender's Own", "The camera's type, as Blender and Cycles have it", 0, GROUPS[0]),
        *(
            Item(it.key, it.label, it.description, it.number, it.group)
            for it in sorted(MODELS, key=lambda it: GROUPS.index(it.group))
            if it.number is not None
        ),
    ),
)  # fmt: skip

_read = (*(it.SETTINGS for it in MODELS), *pixel_time.SETTINGS.values())
_own = {setting.name: setting for settings in _read for setting in settings if setting.owner == OWN}

CAMERA = (MODEL, pixel_time.MODE, *_own.values())
"""``camera.camera_ray_caster``: the model, the time of each pixel, and what the models and the times read."""

PRIMITIVE = Choice(
    "primitive", "Cast As", "What the rays meet in place of this object",
    "AUTOMATIC",
    (
        Item(
            "AUTOMATIC", "Automatic",
            "A sphere or plane if its mesh is one, else its triangles; spheres for the points of a cloud", 0,
        ),
        Item(
            "SPHERE", "Sphere",
            "A sphere in any case: around the middle of its bounding box, to its farthest vertex", 1,
        ),
        Item("PLANE", "Plane", "A plane in any case: its bounding rectangle in its own XY", 2),
        Item("INFINITE_PLANE", "Infinite Plane", "The plane of its face, or else its own XY, without an edge", 3),
        Item("MESH", "Mesh", "Its triangles, also where they are a sphere or a plane", 5),
        Item("IGNORE", "Ignore", "Nothing: the rays pass", 4),
    ),
)  # fmt: skip

OBJECT = (PRIMITIVE,)
"""``object.camera_ray_caster``"""

SHADING = Choice(
    "shading", "Shading", "What the combined pass shows on a shape",
    "MATERIAL",
    (
        Item(
            "MATERIAL", "Material",
            "The Base Color of its material where it was changed, else its viewport color, lit by sun and point lights",
            0,
        ),
        Item("GRID", "Grid", "The same with lines of constant u and v, or the edges of faces without a UV map", 1),
    ),
)  # fmt: skip
SAMPLES = Whole(
    "samples", "Samples", "Rays a pixel for the combined pass, over the pixel and the camera's aperture",
    1, 1, soft_high=256,
)  # fmt: skip
PRECISION = Choice(
    "precision", "Precision", "What hits are searched with. The report has the error bounds of what was found",
    "AUTOMATIC",
    (
        Item("AUTOMATIC", "Automatic", "As Robust: Fast was never found right to the rounding of a stored float32", 0),
        Item("ROBUST", "Robust", "float64: error bounds of about 1e-14 of the distance, as measured", 1),
        Item(
            "FAST", "Fast",
            "float32, for previews: as measured 1.0 to 1.3 times as fast, and right to about 1e-6 of the distance; it "
            "may miss what is smaller than 1e-7 of its distance", 2,
        ),
    ),
)  # fmt: skip
EXACT_SHAPES = Flag(
    "exact_shapes", "Exact Shapes",
    "Meshes that are spheres or planes are cast as those exact shapes; off: as their triangles, but where an object's "
    "own Cast As says what it is",
    True,
)  # fmt: skip
PASSES = tuple(
    Flag(f"use_pass_{name}", name.replace("_", " ").title(), text, False)
    for name, text in (
        ("distance", "Distance along the ray; Z is planar depth"),
        ("shape_index", "Number of the shape, each instance its own"),
        ("face_index", "Number of the face of a mesh after its modifiers, -1 where there is none"),
        ("valid", "Whether the pixel has a ray at all"),
        ("ray_origin", "Where the pixel's ray starts, in the world"),
        ("ray_direction", "The ray's unit direction in the world"),
        ("solid_angle", "Solid angle of the pixel, in steradians, to first order"),
        ("footprint", "Area of the surface that the pixel covers, in square Blender units, to first order"),
        ("flow_forward", "Pixels to where the next frame sees the surface point, x and y; NaN where it does not"),
        ("flow_backward", "Pixels to where the previous frame sees the surface point, x and y; NaN where it does not"),
        ("flow_hidden", "Whether the next frame (X) or the previous one (Y) has something before the surface point"),
        ("distance_bound", "The most that rounding has moved distance and depth, in Blender units"),
        ("position_bound", "The most that rounding has moved the position, in Blender units"),
        ("normal_bound", "The most that rounding has moved the unit normal"),
    )
)

SCENE = (SHADING, SAMPLES, PRECISION, EXACT_SHAPES, *PASSES)
"""``scene.camera_ray_caster``"""
