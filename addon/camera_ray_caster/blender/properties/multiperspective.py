"""The settings of cameras without one eye: what a .blend stores of them, beside Blender's own."""

import bpy

from .tagged import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, PointerProperty


def _is_line(self, item) -> bool:
    return item.type in {"EMPTY", "CURVE"}


def _is_curve(self, item) -> bool:
    return item.type == "CURVE"


def _ray(name: str, corner: str, default):
    description = f"The ray at the {corner} of the frame: x and y on the camera's plane, x and y at depth 1"
    return FloatVectorProperty(name=name, description=description, size=4, default=default)


class MultiperspectiveProperties:
    """A part of ``camera.camera_ray_caster``. Objects are grabbed and moved in the scene; lengths are Blender units."""

    ray_1: _ray("Ray 1", "bottom left", (0.0, 0.0, -0.36, -0.2))
    ray_2: _ray("Ray 2", "bottom right", (0.0, 0.0, 0.36, -0.2))
    ray_3: _ray("Ray 3", "top left", (0.0, 0.0, -0.36, 0.2))
    slit_1: PointerProperty(
        name="Slit", type=bpy.types.Object, poll=_is_line,
        description="A line that the rays obey: the X axis of an empty, or a curve from end to end",
    )  # fmt: skip
    slit_2: PointerProperty(
        name="Second Slit", type=bpy.types.Object, poll=_is_line,
        description="The other line that all rays meet: the X axis of an empty, or a curve from end to end",
    )  # fmt: skip
    pencil_slide: FloatProperty(
        name="Slide", default=1.0, unit="LENGTH",
        description="How far the eye moves along the slit where rays rise by 45 degrees across it; 0 is a pinhole",
    )  # fmt: skip
    twist: FloatProperty(
        name="Twist", default=0.1,
        description="How much steeper rays become across the axis over one unit along it; 0 is orthographic",
    )  # fmt: skip
    path: PointerProperty(
        name="Path", type=bpy.types.Object, poll=_is_curve,
        description="The curve along which the eye moves, from the left edge of the picture to the right one",
    )  # fmt: skip
    follow_path: BoolProperty(
        name="Follow Path", description="Turn about the camera's up axis, to look to the left of where the path leads"
    )
    eye: EnumProperty(
        name="Eye",
        description="Whose picture it is; the interocular distance is the camera's stereoscopy setting",
        items=(
            ("LEFT", "Left", "The left eye"),
            ("RIGHT", "Right", "The right eye"),
            ("TOP_BOTTOM", "Top-Bottom", "Both, the left eye above"),
            ("SIDE_BY_SIDE", "Side by Side", "Both, the left eye on the left"),
        ),
        default="LEFT",
    )


MODELS = (
    ("GENERAL_LINEAR", "General Linear", "All affine combinations of three rays"),
    ("CROSS_SLIT", "Cross-Slit", "Every ray meets two slits: objects of the scene"),
    ("PUSHBROOM", "Pushbroom", "The eye flies along a slit: perspective across it, orthographic along it"),
    ("PENCIL", "Pencil", "The eye lies elsewhere on a slit for each line of the picture"),
    ("TWISTED_ORTHOGRAPHIC", "Twisted Orthographic", "Parallel rays whose direction turns along an axis"),
    ("STRIP", "Strip", "Each column is seen from another place on a path"),
    ("OMNIDIRECTIONAL_STEREO", "Omnidirectional Stereo", "A panorama for eyes on a turning head"),
)
"""Items of ``model``."""

RAYS = ("ray_1", "ray_2", "ray_3")
COPIED = ("pencil_slide", "twist", "follow_path", "eye")
"""What a record takes over as it is; slits and path it takes as lines."""
