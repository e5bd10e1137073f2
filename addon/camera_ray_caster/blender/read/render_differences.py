"""Objects that a render evaluates otherwise than the viewport: hidden in the viewport, or shown in less detail."""

from .render_visibility import ItemVisibility

OF_MODIFIERS = (
    ("show_viewport", "show_render"),
    ("levels", "render_levels"),  # subdivision surface, multiresolution
    ("steps", "render_steps"),  # screw
    ("viewport_resolution", "resolution"),  # ocean
)
OF_DATA = (
    ("resolution_u", "render_resolution_u"),  # curves and texts, where 0 stands for the viewport's
    ("resolution_v", "render_resolution_v"),
    ("resolution", "render_resolution"),  # metaballs
)
"""Settings of the viewport and of a render, by Blender's names."""

UNSEEN = {"EMPTY", "CAMERA", "ARMATURE", "SPEAKER", "LIGHT_PROBE", "LATTICE"}
"""Types of objects that neither are seen nor give light, unless they are instancers."""


def evaluated_otherwise(depsgraph) -> tuple[str, ...]:
    """Return the names, sorted, of the objects in a render of a depsgraph's view layer that Blender evaluates otherwise
    for the viewport.

    Compared are the visibility of objects and modifiers, and numbers of subdivisions, steps and particles. What
    geometry nodes make of a render is not known.
    """
    layer, render = depsgraph.view_layer, depsgraph.scene.render
    simplified = render.use_simplify and render.simplify_subdivision != render.simplify_subdivision_render
    layer_objects = set(layer.objects)
    return tuple(sorted(
        item.name
        for item in ItemVisibility(depsgraph).rendered
        if (item.type not in UNSEEN or item.is_instancer)
        and ((item in layer_objects and not item.visible_get(view_layer=layer)) or _differs(item, simplified))
    ))  # fmt: skip


def _differs(item, simplified: bool) -> bool:
    modifiers, systems = item.modifiers, item.particle_systems
    return (
        any(getattr(modifier, here, None) != getattr(modifier, there, None) for modifier in modifiers
            for here, there in OF_MODIFIERS if hasattr(modifier, here) and hasattr(modifier, there))
        or any(getattr(item.data, there, 0) not in (0, getattr(item.data, here, 0)) for here, there in OF_DATA)
        or any(system.settings.display_percentage < 100 for system in systems)
        or (simplified and any(modifier.type in {"SUBSURF", "MULTIRES"} for modifier in modifiers))
    )  # fmt: skip
