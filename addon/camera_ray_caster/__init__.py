"""Camera Ray Caster: the rays of Blender's cameras, cast at spheres and planes.

Blender is imported inside the two functions, so that ``core`` runs where no Blender is installed.
"""


def register() -> None:
    """Add the engine, operators, panels and properties to Blender."""
    from .blender import registration

    registration.register()


def unregister() -> None:
    """Take back all that ``register`` added."""
    from .blender import registration

    registration.unregister()
