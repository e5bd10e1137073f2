"""Camera Ray Caster: the rays of Blender's cameras, cast at meshes, spheres and planes.

    import camera_ray_caster as crc

    camera = crc.read_camera(bpy.context.scene)
    images = crc.cast(camera, crc.read_shapes(bpy.context.scene), passes=("depth", "normal"))

``register`` adds the interface and the engine to Blender; reading and casting do not need it. Each name is imported on
first access, so that ``core`` runs without Blender.
"""

from importlib import import_module

__all__ = [
    "Cancelled",
    "InputError",
    "camera_from_json",
    "camera_to_json",
    "cast",
    "read_camera",
    "read_scene",
    "read_shapes",
    "register",
    "unregister",
    "visible",
]

_MODULES = {
    "Cancelled": ".core.records",
    "InputError": ".core.records",
    "camera_from_json": ".core.exports.camera_json",
    "camera_to_json": ".core.exports.camera_json",
    "cast": ".core.cast",
    "read_camera": ".blender.read",
    "read_scene": ".blender.read",
    "read_shapes": ".blender.read",
    "visible": ".core.casting.visibility",
}
"""Module of each public name."""


def __getattr__(name: str):
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_MODULES[name], __name__), name)


def register() -> None:
    """Add the engine, operators, panels and properties to Blender; do nothing if they are registered already."""
    from .blender import registration

    registration.register()


def unregister() -> None:
    """Remove everything that ``register`` added."""
    from .blender import registration

    registration.unregister()
