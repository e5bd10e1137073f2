"""Visibility in a render: which of the objects that a depsgraph lists the camera would see.

A render's own depsgraph has already hidden the others. The viewport's depsgraph has not, so the rules are applied here;
objects that it does not list at all can only be named. One case cannot be decided: if geometry nodes or particles
instance a whole collection, objects in it that are hidden from render count as shown, like the hidden prototypes of
single objects.
"""

from collections.abc import Iterator

RAYS = "camera", "diffuse", "glossy", "transmission", "volume_scatter", "shadow"
"""Kinds of rays in an object's Ray Visibility."""


class ItemVisibility:
    """Visibility of the items of a depsgraph's ``object_instances``."""

    def __init__(self, depsgraph):
        self.layer = depsgraph.view_layer
        self.in_viewport = depsgraph.mode == "VIEWPORT"
        self.rendered = set(_of_scene(depsgraph.scene, self.layer)) if self.in_viewport else set()

    def is_rendered(self, instance) -> bool:
        """Return whether a render shows an instance. Instances that the user has hidden are not reported."""
        if not self.in_viewport:
            return instance.show_self
        if not instance.is_instance:
            return instance.object.original in self.rendered and _shows_itself(instance.object)
        source, owner = original_source(instance), instance.parent.original
        if owner not in self.rendered:
            return False
        if owner.instance_type == "COLLECTION":
            collection = owner.instance_collection
            if source in set(_of_collection(collection)):
                return True
            return source not in set(_of_collection(collection, every=True))  # rarely asked
        return owner.instance_type == "NONE" or source in self.rendered

    def objection(self, instance) -> str:
        """Return the reason why the camera does not see an instance that a render shows; "" if the camera sees it."""
        objects = _involved(instance)
        if not all(item.visible_camera for item in objects):
            return "it is hidden from the camera by its Ray Visibility"
        if objects[-1].indirect_only_get(view_layer=self.layer):
            return "its collection is set to Indirect Only"
        return ""

    def is_met(self, instance) -> bool:
        """Return whether any kind of ray can hit an instance: otherwise Cycles has no geometry of it."""
        objects = _involved(instance)
        return any(all(getattr(item, f"visible_{ray}") for item in objects) for ray in RAYS)

    def is_holdout(self, instance) -> bool:
        """Return whether an instance is a holdout, which cuts a hole into the picture: as in Cycles, if the object that
        instances it is one.
        """
        owner = _involved(instance)[-1]
        return owner.is_holdout or owner.holdout_get(view_layer=self.layer)

    def strands(self, item) -> list[str]:
        """Return the names of the particle systems whose hair a render draws on an evaluated object."""
        systems = () if self.in_viewport and item.original not in self.rendered else item.particle_systems
        kinds = {system.name: (system.settings.type, system.settings.render_type) for system in systems}
        return [name for name, kind in kinds.items() if kind == ("HAIR", "PATH")]

    def unlisted(self, listed: set, instanced: set) -> list:
        """Return the objects that a render shows and the viewport has not evaluated, by name.

        listed: the objects that the depsgraph lists where they stand; instanced: those whose instances it lists.
        """
        missing = {item for item in self.rendered - listed if _shows_itself(item) or _instances_others(item)}
        sources = {item for item in self.rendered if _is_instanced(item) and item.parent in self.rendered}
        for item in self.rendered:
            if item.instance_type == "COLLECTION" and item.instance_collection is not None:
                sources.update(_of_collection(item.instance_collection))
        return sorted(missing | (sources - instanced), key=lambda item: item.name)


def original_source(instance):
    """Return the object in the file that an item of ``object_instances`` shows."""
    return (instance.instance_object or instance.object).original


def _involved(instance) -> list:
    """Return the object of an instance and, if there is one, the object that instances it."""
    owner = [instance.parent.original] if instance.is_instance else []
    return [original_source(instance), *owner]


def _instances_others(item) -> bool:
    """Return whether geometry nodes or particles of an object instance others; parents and empties name their own."""
    return item.is_instancer and item.instance_type == "NONE"


def _shows_itself(item) -> bool:
    """Return whether a render shows an object at its own place, regardless of its instances."""
    if item.is_instancer and not item.show_instancer_for_render:
        return False
    return not _is_instanced(item)


def _is_instanced(item) -> bool:
    """Return whether its parent instances it at vertices or faces."""
    return item.parent is not None and item.parent.instance_type in {"VERTS", "FACES"}


def _of_scene(scene, view_layer) -> Iterator:
    """Yield the objects of a view layer that a render shows, and those of the scene's background set."""
    yield from _of_layer(view_layer.layer_collection)
    behind = scene.background_set
    if behind is not None:  # Blender shows its first layer that is rendered
        yield from _of_scene(behind, next((layer for layer in behind.view_layers if layer.use), behind.view_layers[0]))


def _of_layer(layer) -> Iterator:
    """Yield the objects of a layer collection that a render shows."""
    if layer.collection.hide_render:
        return
    if not layer.exclude:
        yield from (item for item in layer.collection.objects if not item.hide_render)
    for child in layer.children:
        yield from _of_layer(child)


def _of_collection(collection, every: bool = False) -> Iterator:
    """Yield the objects of an instanced collection and of collections instanced in it: all, or those that render."""
    if collection.hide_render and not every:
        return
    for item in collection.objects:
        if every or not item.hide_render:
            yield item
            if item.instance_type == "COLLECTION" and item.instance_collection is not None:
                yield from _of_collection(item.instance_collection, every)
    for child in collection.children:
        yield from _of_collection(child, every)
