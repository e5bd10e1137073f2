"""What the add-on stores in a .blend: what an object stands for, what model a camera has, how a scene is shown."""

import bpy

from .central import MODELS as CENTRAL
from .central import CentralProperties
from .multiperspective import MODELS, MultiperspectiveProperties
from .tagged import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty


class ObjectProperties(bpy.types.PropertyGroup):
    """``object.camera_ray_caster``"""

    primitive: EnumProperty(
        name="Cast As",
        description="What the rays meet in place of this object",
        items=(
            ("AUTOMATIC", "Automatic", "A sphere or plane if its mesh is one, spheres for the points of a cloud"),
            ("SPHERE", "Sphere", "A sphere in any case: around the middle of its bounding box, to its farthest vertex"),
            ("PLANE", "Plane", "A plane in any case: its bounding rectangle in its own XY"),
            ("INFINITE_PLANE", "Infinite Plane", "The plane of its face, or else its own XY, without an edge"),
            ("IGNORE", "Ignore", "Nothing: the rays pass"),
        ),
        default="AUTOMATIC",
    )


class CameraProperties(CentralProperties, MultiperspectiveProperties, bpy.types.PropertyGroup):
    """``camera.camera_ray_caster``: a model that Blender does not have, and the time of each pixel"""

    model: EnumProperty(
        name="Model",
        description="How the camera maps rays to pixels",
        items=(
            ("BLENDER", "Blender's Own", "The camera's type, as Blender and Cycles have it"),
            ("CAMERA_OBSCURA", "Camera Obscura", "A dark box with a tiny hole: the world upside down on its back wall"),
            *CENTRAL,
            *MODELS,
        ),
        default="BLENDER",
    )
    obscura_depth: FloatProperty(
        name="Box Depth", description="From the hole to the back wall", default=2.0, min=1e-6, unit="LENGTH"
    )
    obscura_width: FloatProperty(
        name="Wall Size", description="The fitted side of the picture on the back wall",
        default=3.0, min=1e-6, unit="LENGTH",
    )  # fmt: skip
    obscura_hole: FloatProperty(
        name="Hole Diameter", description="A larger hole lets in more light and blurs the picture",
        default=0.02, min=1e-9, unit="LENGTH", precision=4,
    )  # fmt: skip
    time_mode: EnumProperty(
        name="Time",
        description="The frame at which each pixel's ray is cast",
        items=(
            ("NONE", "One Time", "All pixels show the current frame"),
            ("ROWS", "Rows", "Slit scan: from the first row, at the bottom, to the last one"),
            ("COLUMNS", "Columns", "Slit scan: from the left column to the right one"),
            ("IMAGE", "Image", "Time displacement: black pixels of an image show the start, white ones the end"),
            ("ROLLING_SHUTTER", "Rolling Shutter", "Rows from top to bottom, in the shutter of Cycles' motion blur"),
        ),
        default="NONE",
    )
    time_start: FloatProperty(name="Start", description="Frame of the first row, column or of black", default=1.0)
    time_end: FloatProperty(name="End", description="Frame of the last row, column or of white", default=25.0)
    time_image: PointerProperty(name="Image", description="Gray image, stretched over the frame", type=bpy.types.Image)
    time_tolerance: FloatProperty(
        name="Tolerance", description="Pixels by which motion between evaluations of the scene may be off",
        default=0.1, min=1e-4, soft_max=10.0,
    )  # fmt: skip
    time_evaluations: IntProperty(
        name="Most Evaluations", description="Times at which the scene may be evaluated; what that leaves is reported",
        default=256, min=2, soft_max=4096,
    )  # fmt: skip


class SceneProperties(bpy.types.PropertyGroup):
    """``scene.camera_ray_caster``"""

    shading: EnumProperty(
        name="Shading",
        description="What the combined pass shows on a shape",
        items=(
            ("MATERIAL", "Material", "The viewport color of its material, or its own, lit by sun and point lights"),
            ("GRID", "Grid", "The same with lines of constant u and v, to see what a projection does"),
        ),
        default="MATERIAL",
    )
    samples: IntProperty(
        name="Samples", description="Rays a pixel for the combined pass, over the pixel and the camera's aperture",
        default=1, min=1, soft_max=256,
    )  # fmt: skip
    precision: EnumProperty(
        name="Precision",
        description="What hits are searched with. The report has the error bounds of what was found",
        items=(
            ("AUTOMATIC", "Automatic", "As Robust: Fast was never found right to the rounding of a stored float32"),
            ("ROBUST", "Robust", "float64: error bounds of about 1e-14 of the distance, as measured"),
            ("FAST", "Fast", "float32, for previews: as measured 1.0 to 1.3 times as fast, and right to about 1e-6 of "
             "the distance; it may miss what is smaller than 1e-7 of its distance"),
        ),
        default="AUTOMATIC",
    )  # fmt: skip
    use_pass_distance: BoolProperty(name="Distance", description="Distance along the ray; Z is planar depth")
    use_pass_shape_index: BoolProperty(name="Shape Index", description="Number of the shape, each instance its own")
    use_pass_valid: BoolProperty(name="Valid", description="Whether the pixel has a ray at all")
    use_pass_ray_origin: BoolProperty(name="Ray Origin", description="Where the pixel's ray starts, in the world")
    use_pass_ray_direction: BoolProperty(name="Ray Direction", description="The ray's unit direction in the world")
    use_pass_distance_bound: BoolProperty(
        name="Distance Bound", description="The most that rounding has moved distance and depth, in Blender units"
    )
    use_pass_position_bound: BoolProperty(
        name="Position Bound", description="The most that rounding has moved the position, in Blender units"
    )
    use_pass_normal_bound: BoolProperty(
        name="Normal Bound", description="The most that rounding has moved the unit normal"
    )


CLASSES = (ObjectProperties, CameraProperties, SceneProperties)
POINTERS = (
    (bpy.types.Object, ObjectProperties),
    (bpy.types.Camera, CameraProperties),
    (bpy.types.Scene, SceneProperties),
)


def register() -> None:
    """Give every object and scene its properties."""
    """See ``registration``."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for owner, group in POINTERS:
        owner.camera_ray_caster = PointerProperty(type=group)


def unregister() -> None:
    """Take them back; what is stored in the file stays in it."""
    """See ``registration``."""
    for owner, _ in reversed(POINTERS):
        del owner.camera_ray_caster
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
