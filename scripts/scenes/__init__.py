"""The example scenes by name, each a function that fills an empty Blender scene; its docstring is its line in the README."""

from .showcase import spheres_and_planes

SCENES = {
    make.__name__: make
    for make in (
        spheres_and_planes,
    )
}
