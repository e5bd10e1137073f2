"""Which of the objects that a depsgraph lists a render would show its camera.

A render's own depsgraph has hidden the others by itself. The viewport's has not, so the rules are applied here; what it
does not list at all can only be named. One case it cannot tell: objects that are hidden from render inside a whole
collection that geometry nodes or particles instance count as shown, like the hidden prototypes of single objects.
"""

from collections.abc import Iterator

RAYS = "camera", "diffuse", "glossy", "transmission", "volume_scatter", "shadow"
"""The kinds in an object's Ray Visibility."""


class Visibility:
    """The answers for one depsgraph. Every question is about an item of its ``object_instances``."""

    def __init__(self, depsgraph):
        self.layer = depsgraph.view_layer
        self.in_viewport = depsgraph.mode == "VIEWPORT"
        self.rendered = set(_of_scene(depsgraph.scene, self.layer)) if self.in_viewport else set()

    def is_rendered(self, instance) -> bool:
        """Return whether a render shows it: what the user has hidden is left out without a word."""
        if not self.in_viewport:
            return instance.show_self
        if not instance.is_instance:
            return instance.object.original in self.rendered and _shows_itself(instance.object)
        source, owner = original_source(instance), instance.parent.original
        if owner not in self.rendered:
            return False
        if owner.instance_type == "COLLECTION":
            collection = owner.instance_collection
            return source in set(_of_collection(collection)) or source not in set(
                _of_collection(collection, every=True)
            )
        return owner.instance_type == "NONE" or not source.hide_render

    def objection(self, instance) -> str:
        """Return in words why the camera does not see what a render shows otherwise; "" if it does."""
        objects = _involved(instance)
        if not all(item.visible_camera for item in objects):
            return "it is hidden from the camera by its Ray Visibility"
        if objects[-1].indirect_only_get(view_layer=self.layer):
            return "its collection is indirect only"
        return ""

    def is_met(self, instance) -> bool:
        """Return whether any kind of ray meets what a render shows: Cycles has no geometry of anything else."""
        objects = _involved(instance)
        return any(all(getattr(item, f"visible_{ray}") for item in objects) for ray in RAYS)

    def is_holdout(self, instance) -> bool:
        """Return whether it cuts a hole into the picture instead of showing itself."""
        objects = _involved(instance)
        return any(item.is_holdout for item in objects) or objects[-1].holdout_get(view_layer=self.layer)

    def strands(self, item) -> list[str]:
        """Return the names of the particle systems whose hair a render draws on an evaluated object."""
        systems = () if self.in_viewport and item.original not in self.rendered else item.particle_systems
        return [one.name for one in systems if one.settings.type == "HAIR" and one.settings.render_type == "PATH"]

    def unlisted(self, listed: set) -> list:
        """Return the objects that a render shows and the viewport has not evaluated, by name."""
        missing = [item for item in self.rendered - listed if item.is_instancer or _shows_itself(item)]
        return sorted(missing, key=lambda item: item.name)


def original_source(instance):
    """Return the object in the file that an item of ``object_instances`` shows."""
    return (instance.instance_object or instance.object).original


def _involved(instance) -> list:
    """Return the object and, last, the one that instances it."""
    owner = [instance.parent.original] if instance.is_instance else []
    return [original_source(instance), *owner]


def _shows_itself(item) -> bool:
    """Return whether a render shows the object where it stands, apart from where it is instanced."""
    if item.is_instancer and not item.show_instancer_for_render:
        return False
    return item.parent is None or item.parent.instance_type not in {"VERTS", "FACES"}


def _of_scene(scene, view_layer) -> Iterator:
    """Yield the objects of a view layer that a render shows, and those of the scenes that are its background set."""
    yield from _of_layer(view_layer.layer_collection)
    behind = scene.background_set
    if behind is not None:  # Blender shows the first of its layers that is rendered
        yield from _of_scene(behind, next((one for one in behind.view_layers if one.use), behind.view_layers[0]))


def _of_layer(layer) -> Iterator:
    """Yield the objects of a layer collection that a render shows."""
    if layer.collection.hide_render:
        return
    if not layer.exclude:
        yield from (item for item in layer.collection.objects if not item.hide_render)
    for child in layer.children:
        yield from _of_layer(child)


def _of_collection(collection, every: bool = False) -> Iterator:
    """Yield the objects of an instanced collection and of those that it instances itself: every, or what renders."""
    if collection.hide_render and not every:
        return
    for item in collection.objects:
        if every or not item.hide_render:
            yield item
            if item.instance_type == "COLLECTION" and item.instance_collection is not None:
                yield from _of_collection(item.instance_collection, every)
    for child in collection.children:
        yield from _of_collection(child, every)
