"""Declarations of the add-on's settings in a .blend: settings of objects and scenes; those of cameras are in core.

Files store the number of a choice's item, so numbers are never changed and never reused.
"""

from ...core.camera import pixel_time
from ...core.cameras import MODELS
from ...core.cameras.model import GROUPS
from ...core.cameras.parts import port_settings
from ...core.cameras.parts.settings import OWN, Choice, Flag, Item, Setting, Whole
from . import pass_properties

GROUP = "camera_ray_caster"
"""Name of the property groups ``camera.camera_ray_caster``, ``object.camera_ray_caster`` and
``scene.camera_ray_caster``.
"""

ENGINE = "CAMERA_RAY_CASTER"
"""The identifier of the render engine."""

BLENDERS_OWN = "BLENDER"
"""Item of MODEL for the model of Blender's own camera type."""


def _models() -> list[Item]:
    models = sorted(MODELS, key=lambda model: GROUPS.index(model.group))
    numbered = [model for model in models if model.number is not None]
    items = [Item(model.key, model.label, model.description, model.number, model.group) for model in numbered]
    text = "Model of the camera's Type in Blender, as in Cycles"
    return [Item(BLENDERS_OWN, "Blender's Own", text, 0, GROUPS[0]), *items]


def _of_cameras() -> list[Setting]:
    read = (*(model.SETTINGS for model in MODELS), *port_settings.SETTINGS.values(), *pixel_time.SETTINGS.values())
    of_camera_data = {setting.name: setting for settings in read for setting in settings if setting.owner == OWN}
    return [MODEL, port_settings.PORT, pixel_time.MODE, *of_camera_data.values()]


def renew() -> None:
    """Add the models that were registered since."""
    MODEL.items[:], CAMERA[:] = _models(), _of_cameras()


MODEL = Choice("model", "Model", "How the camera maps rays to pixels", BLENDERS_OWN, _models())
CAMERA = _of_cameras()
"""Settings in ``camera.camera_ray_caster``: the model, the port, the pixel time mode, and the settings these read."""


def files() -> list[Setting]:
    """Return the settings of cameras that name a file."""
    return [setting for setting in CAMERA if setting.kind == "FILE"]


PRIMITIVE = Choice(
    "primitive", "Cast As", "Shape that the rays intersect in place of this object",
    "AUTOMATIC",
    (
        Item(
            "AUTOMATIC", "Automatic",
            "A sphere or a plane if the object's mesh is a sphere or a plane, otherwise its triangles. Points of "
            "a point cloud are spheres", 0,
        ),
        Item(
            "SPHERE", "Sphere",
            "Always a sphere, around the center of the object's bounding box, through its farthest vertex", 1,
        ),
        Item("PLANE", "Plane", "Always a plane: the object's bounding rectangle in its local XY plane", 2),
        Item("INFINITE_PLANE", "Infinite Plane", "An unbounded plane: the plane of the object's face, or else "
                                                 "its local XY plane", 3),
        Item("MESH", "Mesh", "The object's triangles, even if the mesh is a sphere or a plane", 5),
        Item("IGNORE", "Ignore", "Nothing: the rays pass through the object", 4),
    ),
)  # fmt: skip

OBJECT = (PRIMITIVE,)
"""Settings in ``object.camera_ray_caster``."""

SHADING = Choice(
    "shading", "Shading", "Colors of shapes in the combined pass",
    "MATERIAL",
    (
        Item(
            "MATERIAL", "Material",
            "Color of the material's nodes and textures, or its viewport color, lit by the lamps without shadows",
            0,
        ),
        Item("GRID", "Grid", "As Material, with lines of constant u and v, or with the edges of faces if there "
                             "is no UV map", 1),
    ),
)  # fmt: skip
SAMPLES = Whole(
    "samples", "Samples", "Number of rays per pixel for the combined pass, distributed over the pixel and the "
                          "camera's aperture",
    1, 1, soft_high=256,
)  # fmt: skip
EXACT_SHAPES = Flag(
    "exact_shapes", "Exact Shapes",
    "Cast meshes that are spheres or planes as exact shapes. If disabled, they are cast as triangles, except objects "
    "whose Cast As setting names a shape",
    True,
)  # fmt: skip
PASSES = tuple(Flag(entry.tick, entry.label, entry.text, False) for entry in pass_properties.PASSES if entry.on_scene)
"""Check boxes of the passes that Blender does not have."""

SCENE = (SHADING, SAMPLES, EXACT_SHAPES, *PASSES)
"""Settings in ``scene.camera_ray_caster``."""
