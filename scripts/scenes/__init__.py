"""The example scenes by name: functions that fill an empty Blender scene. The docstring is the line in the README."""

from . import cameras, contents, showcase

SCENES = {
    make.__name__: make
    for make in (
        showcase.spheres_and_planes,
        cameras.portrait,
        cameras.vertical_fit,
        cameras.orthographic,
        cameras.border,
        cameras.sheared_and_mirrored,
        cameras.animated,
        cameras.inside_a_sphere,
        cameras.far_and_small,
        contents.instances,
        contents.left_out,
        contents.cast_as,
        contents.view_layers,
        contents.empty,
    )
}
