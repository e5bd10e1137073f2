"""Physics that are not baked: cloth, soft bodies, particles, rigid bodies, dynamic paint, simulation nodes.

Blender simulates them from one frame to the next, only in the viewport's evaluation, and keeps each frame in a cache
that a render and other frames read. A jump to a frame that is not in the cache shows something else. So all frames from
the first one of the simulation are evaluated in their order; then any frame is read from the cache, with the same
numbers however it is reached.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy

from ...core.records import InputError
from ..process.signals import raise_if_stopping

CLOTH = {"CLOTH", "SOFT_BODY"}
"""Types of modifiers with one point cache."""

STATELESS = {"NO", "KEYED"}
"""Physics of particles that follow from the frame alone: Blender keeps no cache of them."""

SHARED = "its cache is a folder that other processes may change"

_simulated: dict[int, tuple[int, list]] = {}
"""The frame to which the physics of a scene have been simulated, and the caches that are kept, by its session_uid."""


@dataclass(frozen=True)
class Physics:
    """One simulation that is not baked, or not known to be."""

    item: Any
    """Its object; one of the bodies, if a scene simulates them."""
    first: int
    last: float
    """The first and the last frame of the simulation; the last of simulation nodes is infinite."""
    cache: Any = None
    """Its point cache; None for fluids and simulation nodes."""
    obstacle: str = ""
    """Reason why it cannot be simulated here; else empty."""
    is_known: bool = True
    """False for simulation nodes that may be baked into the file, which Blender does not tell."""

    def refusal(self, reason: str) -> InputError:
        """Return the error that asks for a bake."""
        return InputError(f"the physics of {self.item.name!r} is not baked, and {reason}: bake it first")


def simulate(depsgraph, frame: float) -> None:
    """Simulate the physics that are not baked of the scene of a viewport's depsgraph, up to the first whole frame that
    is not before ``frame``.

    Their caches then count as baked, so that no later change empties them: this is for a process that reads a file, not
    for a user's session. A later call with a later frame simulates all frames again, since Blender does not go on from
    a frame that it has read from a cache with the same numbers. The frame is not restored. Raises InputError, which
    names the object, for physics that Blender does not simulate in the viewport, or not frame by frame; and Cancelled
    if stopped.
    """
    scene = depsgraph.scene
    reached, kept = _simulated.get(scene.session_uid, (-math.inf, []))
    if frame <= reached:
        return
    _keep(kept, False)
    every = list(unbaked(depsgraph))
    for simulation in every:
        # at its first frame nothing is simulated; ``frame`` is for flow
        if simulation.obstacle and frame - 1 > simulation.first:
            raise simulation.refusal(simulation.obstacle)
    playable = [simulation for simulation in every if not simulation.obstacle]
    for simulation in playable:
        simulation.item.update_tag(refresh={"DATA"})  # the file may hold frames that were simulated from others
    if playable:
        first = min(simulation.first for simulation in playable)
        last = max(first, math.ceil(min(frame, max(simulation.last for simulation in playable))))
        _play(scene, first, last)
        kept = [simulation.cache for simulation in playable if simulation.cache is not None]
        _keep(kept, True)
        _simulated[scene.session_uid] = max(last, math.ceil(frame)), kept


def release() -> None:
    """Let the caches of simulations count as not baked again: the file that is open may stay open in Blender."""
    for scene in bpy.data.scenes:
        _, kept = _simulated.get(scene.session_uid, (0, []))
        _keep(kept, False)
    _simulated.clear()


def prepare(depsgraph, frames: Iterable[float]) -> None:
    """Prepare the scene of a depsgraph for the reading of other frames than its own.

    Raises InputError, which names the object, if one of them is after the first frame of physics that are not baked.
    Simulation nodes, of which Blender does not tell whether they are baked into the file, are simulated, but not within
    a render. The frame is not restored.
    """
    last = math.ceil(max(frames))
    simulations = list(unbaked(depsgraph))
    for simulation in _jumped(simulations, last):
        raise simulation.refusal(f"frame {last} was not simulated")
    reached, _ = _simulated.get(depsgraph.scene.session_uid, (-math.inf, []))
    if simulations and last > reached and depsgraph.mode == "VIEWPORT":
        _play(depsgraph.scene, min(simulation.first for simulation in simulations), last + 1)


def warning(depsgraph, frame: float) -> tuple[str, ...]:
    """Return a line, in a tuple, if physics are not baked and a frame is after their first; else ()."""
    names = [simulation.item.name for simulation in _jumped(unbaked(depsgraph), frame)]
    if not names:
        return ()
    return (f"the physics of {names[0]!r} is not baked: unless all frames were rendered in order, bake it first",)


def unbaked(depsgraph) -> Iterator[Physics]:
    """Yield the simulations that a render of a depsgraph's view layer shows and that are not known to be baked."""
    scene, layer = depsgraph.scene, depsgraph.view_layer
    stretched = scene.render.frame_map_old != scene.render.frame_map_new
    skips = "Time Stretching leaves out frames of it" if stretched else ""
    world = scene.rigidbody_world
    if world is not None and world.enabled and world.collection is not None:
        bodies = sorted(world.collection.objects, key=lambda item: item.name)
        for item in [body for body in bodies if body.rigid_body is not None and body.rigid_body.type == "ACTIVE"][:1]:
            yield from _of_cache(item, world.point_cache, skips)
    layer_objects = set(layer.objects)
    evaluated = {item.original for item in depsgraph.ids if isinstance(item, bpy.types.Object)}
    for item in sorted(layer_objects | evaluated, key=lambda item: item.name):
        hidden = item in layer_objects and not item.hide_render and not item.visible_get(view_layer=layer)
        for modifier in item.modifiers:
            if modifier.show_render:
                unseen = hidden or not modifier.show_viewport
                obstacle = "it is hidden in the viewport, which simulates it" if unseen else skips
                yield from _of_modifier(item, modifier, scene, obstacle)


def _of_modifier(item, modifier, scene, obstacle: str) -> Iterator[Physics]:
    for cache in _caches(modifier):
        yield from _of_cache(item, cache, obstacle)
    if modifier.type == "FLUID" and modifier.fluid_type == "DOMAIN":
        domain = modifier.domain_settings
        if domain.domain_type == "LIQUID" and not domain.has_cache_baked_any:
            yield Physics(item, domain.cache_frame_start, domain.cache_frame_end, obstacle=SHARED)
    for bake in modifier.bakes if modifier.type == "NODES" and modifier.node_group is not None else ():
        if bake.node is not None and bake.node.bl_idname == "GeometryNodeSimulationOutput":
            on_disk = (modifier.bake_target if bake.bake_target == "INHERIT" else bake.bake_target) == "DISK"
            if not (on_disk and _has_files(modifier, bake)):
                first = scene.simulation_frame_start if scene.use_custom_simulation_range else scene.frame_start
                first = bake.frame_start if bake.use_custom_simulation_frame_range else first
                yield Physics(item, first, math.inf, obstacle=obstacle, is_known=on_disk)


def _of_cache(item, cache, obstacle: str) -> Iterator[Physics]:
    """Yield the simulation of a point cache, unless it is baked."""
    if not (cache.is_baked or cache.use_external):
        obstacle = SHARED if cache.use_disk_cache else obstacle
        yield Physics(item, cache.frame_start, cache.frame_end, cache, obstacle)


def _caches(modifier) -> Iterator:
    """Yield the point caches of a modifier's simulations."""
    if modifier.type in CLOTH:
        yield modifier.point_cache
    elif modifier.type == "PARTICLE_SYSTEM":
        system = modifier.particle_system
        is_hair, physics = system.settings.type == "HAIR", system.settings.physics_type
        if system.use_hair_dynamics if is_hair else physics not in STATELESS:
            yield system.point_cache
    elif modifier.type == "DYNAMIC_PAINT" and modifier.canvas_settings is not None:
        for surface in modifier.canvas_settings.canvas_surfaces:
            if surface.is_active and surface.surface_format == "VERTEX":
                yield surface.point_cache


def _has_files(modifier, bake) -> bool:
    """Return whether the folder of a simulation that is baked to the disk has frames."""
    path = bake.directory if bake.use_custom_path else f"{modifier.bake_directory}/{bake.bake_id}"
    folder = Path(bpy.path.abspath(path, library=modifier.id_data.library))
    return any((folder / "meta").glob("*.json"))


def _jumped(simulations: Iterable[Physics], frame: float) -> list[Physics]:
    return [simulation for simulation in simulations if simulation.is_known and frame > simulation.first]


def _play(scene, first: int, last: int) -> None:
    for frame in range(first, last + 1):
        raise_if_stopping()
        scene.frame_set(frame)


def _keep(caches, keep: bool) -> None:
    """Let Blender take caches as they are for baked, or no longer."""
    for cache in caches:
        with bpy.context.temp_override(point_cache=cache):
            bpy.ops.ptcache.bake_from_cache() if keep else bpy.ops.ptcache.free_bake()
