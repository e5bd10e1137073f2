"""What Blender does to a picture after the cast: the compositor, Freestyle and Grease Pencil; and warnings about it."""

from collections.abc import Collection, Iterator

from ...core.cameras.orthographic import Orthographic
from ...core.cameras.perspective import Perspective
from ..properties.pass_properties import PASSES, RenderPass
from ..read.compositor import compositor_nodes

ALWAYS = {"Image", "Alpha", "Noisy Image"}
"""Sockets of a Render Layers node that show the combined pass, which Blender always stores."""

FREESTYLE = (
    "Freestyle draws its lines after the cast, which may take a hundred times as long (7 to 42 s were measured beside "
    "a cast of 0.06 s): disable it where lines are not needed (Render properties)"
)


def warnings(depsgraph, model: str, passes: Collection[RenderPass]) -> tuple[str, ...]:
    """Return warnings of what Blender will do to the picture of a view layer; ``model`` is the label of the camera's
    model, ``passes`` are those that are cast.
    """
    scene, layer = depsgraph.scene, depsgraph.view_layer
    freestyle = scene.render.use_freestyle and layer.use_freestyle
    return (*_drawn_over(depsgraph, model, freestyle), *_missing(scene, layer, passes), *[FREESTYLE] * freestyle)


def _missing(scene, layer, passes: Collection[RenderPass]) -> Iterator[str]:
    """Yield warnings of the compositor's nodes that read passes of a view layer which are not cast."""
    known = {entry.label for entry in PASSES}
    there = ALWAYS | {entry.label for entry in passes}
    for node in compositor_nodes(scene):
        for name in _read(node, scene, layer.name):
            if name not in there:
                why = "is not cast: enable it" if name in known else "this engine does not have: render with Cycles"
                yield (
                    f"the compositor's node {node.name!r} reads the pass {name!r} of {layer.name!r}, which {why}, or "
                    "disable Compositing; it is black or missing in the picture"
                )


def _read(node, scene, layer: str) -> list[str]:
    """Return the names of the passes of a view layer that a node reads."""
    used = [output.name for output in node.outputs if any(not link.is_muted for link in output.links)]
    if node.type == "R_LAYERS" and node.scene == scene and node.layer == layer:
        return used
    if node.type == "CRYPTOMATTE_V2" and node.source == "RENDER" and node.scene == scene:
        of, _, name = node.layer_name.rpartition(".")
        return [name] if used and of == layer else []
    return []


def _drawn_over(depsgraph, model: str, freestyle: bool) -> Iterator[str]:
    """Yield a warning of the lines that Blender itself draws over a picture, in perspective."""
    pencil = any(item.type == "GREASEPENCIL" for item in depsgraph.objects)
    lines = " and ".join(["Freestyle"] * freestyle + ["Grease Pencil"] * pencil)
    if lines and model not in (Perspective.label, Orthographic.label):
        yield f"Blender draws {lines} over the picture in perspective, not through {model}: disable it"
