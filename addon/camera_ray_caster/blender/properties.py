"""What the add-on stores in a .blend: on each object what it stands for, on the scene how it is shown."""

import bpy
from bpy.props import BoolProperty, EnumProperty, PointerProperty


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


class SceneProperties(bpy.types.PropertyGroup):
    """``scene.camera_ray_caster``"""

    shading: EnumProperty(
        name="Shading",
        description="What the combined pass shows on a shape",
        items=(
            ("MATERIAL", "Material", "The viewport colour of its material, or its own, lit by sun and point lights"),
            ("GRID", "Grid", "The same with lines of constant u and v, to see what a projection does"),
        ),
        default="MATERIAL",
    )
    use_pass_distance: BoolProperty(name="Distance", description="Distance along the ray; Z is planar depth")
    use_pass_shape_index: BoolProperty(name="Shape Index", description="Number of the shape, each instance its own")
    use_pass_valid: BoolProperty(name="Valid", description="Whether the pixel has a ray at all")
    use_pass_ray_origin: BoolProperty(name="Ray Origin", description="Where the pixel's ray starts, in the world")
    use_pass_ray_direction: BoolProperty(name="Ray Direction", description="The ray's unit direction in the world")


CLASSES = (ObjectProperties, SceneProperties)
POINTERS = ((bpy.types.Object, ObjectProperties), (bpy.types.Scene, SceneProperties))


def register() -> None:
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for owner, group in POINTERS:
        owner.camera_ray_caster = PointerProperty(type=group)


def unregister() -> None:
    for owner, _ in reversed(POINTERS):
        del owner.camera_ray_caster
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
