"""Scenes that are difficult because of their objects, or of missing objects."""

from __future__ import annotations

from math import cos, pi, sin

import bpy

from .parts import (
    add,
    camera,
    ico_sphere,
    instances_of_points,
    mesh,
    points,
    render,
    spheres_of_points,
    square,
    sun,
    uv_sphere,
)


def instances(scene):
    """The scene has collection instances, instances and points of geometry nodes, and particles. None of these are in
    the list of objects.
    """
    add(scene, "Floor", square(), scale=(5, 4, 1), color="d9d2c6", index=1)
    snowman = bpy.data.collections.new("Snowman")
    for height, size, color in ((0.5, 0.5, "eae1d0"), (1.2, 0.35, "f0b941")):
        ball = add(scene, "Part", uv_sphere(), (0, 0, height), scale=size, color=color, index=2)
        scene.collection.objects.unlink(ball)
        snowman.objects.link(ball)
    for x, scale in ((-3, 1), (-1.6, (0.7, 0.7, -1.3))):
        stand = add(scene, "Stand", None, (x, -1, 0 if x == -3 else 1.8), (0, 0, 0), scale)
        stand.instance_type, stand.instance_collection = "COLLECTION", snowman

    helix = [(cos(k / 2), sin(k / 2), k / 12) for k in range(40)]
    cloud = points(helix, [0.06 + 0.002 * k for k in range(40)])
    spheres_of_points(add(scene, "Points", cloud, (0.4, 0, 0), color="e2674a", index=3))
    ball = add(scene, "Ball", ico_sphere(), (3.6, -1.6, 0.3), scale=0.3, color="2a9d8f", index=4)
    circle = [(1.2 * cos(pi * k / 5), 0, 1.5 + 1.2 * sin(pi * k / 5)) for k in range(10)]
    instances_of_points(add(scene, "Wheel", points(circle, [0.0] * 10), (3.2, 1, 0), color="2a9d8f"), ball)
    particles(add(scene, "Emitter", square(), (0, 3.6, 1.7), (90, 0, 0), (4.5, 1.2, 1), index=6), ball)
    sun(scene, (46, 0, -46), 2)
    camera(scene, (0.5, -11, 4.2), (0, 0, 1.1), lens=42)
    render(scene)


def particles(emitter, instance, count: int = 40) -> None:
    """Let an object emit resting instances of another object; hide the emitter."""
    settings = emitter.modifiers.new("Particles", "PARTICLE_SYSTEM").particle_system.settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime = count, 0, 0, 1000
    settings.physics_type, settings.render_type = "NO", "OBJECT"
    settings.instance_object, settings.particle_size, settings.size_random = instance, 0.5, 0.5
    emitter.show_instancer_for_render = False


def left_out(scene):
    """Hair, a volume and a quad with an infinite corner are left out and named in the report. Hidden objects are not
    drawn.
    """
    add(scene, "Floor", square(), scale=4, color="d9d2c6", index=1)
    add(scene, "Sphere", uv_sphere(), (0, 0, 0.8), scale=0.8, color="e2674a", index=2)
    add(scene, "Monkey", mesh("monkey"), (-2.2, 0, 1), index=3)
    add(scene, "Flat sphere", uv_sphere(), (0, -1.5, 0.5), scale=(0.5, 0.5, 0), index=4)
    add(scene, "Hair", bpy.data.hair_curves.new("Hair"), (2.2, 0, 0.5), index=5)
    add(scene, "Volume", bpy.data.volumes.new("Volume"), (-0.8, -2.5, 0.1), index=7)
    endless = bpy.data.meshes.new("endless quad")
    endless.from_pydata([(-1, -1, 0), (1, -1, 0), (1, float("inf"), 0.5), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    add(scene, "Endless quad", endless, (-2.2, 2, 0.5), index=8)
    add(scene, "Hidden", uv_sphere(), (0, -2.5, 1.2), color="f0b941", index=9).hide_render = True
    sun(scene, (46, 0, -46), 2)
    camera(scene, (1, -9, 3.5), (0, 0, 0.8), lens=40)
    render(scene)


def cast_as(scene):
    """Cast As sets an object's shape: a cube is cast as a sphere, a monkey as a plane, the floor as an infinite plane,
    and a sphere is ignored.
    """
    things = (
        ("INFINITE_PLANE", add(scene, "Floor", square(), color="d9d2c6", index=1)),
        ("SPHERE", add(scene, "Cube", mesh("cube", size=1.2), (-1.3, 0, 1.1), color="e2674a", index=2)),
        ("PLANE", add(scene, "Monkey", mesh("monkey"), (1.3, 0, 1), (70, 0, 20), color="2a9d8f", index=3)),
        ("IGNORE", add(scene, "Nothing", uv_sphere(), (0, -2, 0.6), scale=0.6, color="f0b941", index=4)),
    )
    for primitive, thing in things:
        thing.camera_ray_caster.primitive = primitive
    sun(scene, (46, 0, -46), 2)
    camera(scene, (0.5, -7, 2.5), (0, 0, 0.9), lens=35)
    render(scene)


def view_layers(scene):
    """Two view layers have their own shapes. One contains the sphere and has all passes; the other contains the plane
    and has few passes.
    """
    for name in ("Spheres", "Planes"):
        scene.collection.children.link(bpy.data.collections.new(name))
    floor = add(scene, "Floor", square(), scale=3, color="d9d2c6", index=1)
    ball = add(scene, "Ball", uv_sphere(), (0, 0, 1), color="e2674a", index=2)
    for thing, name in ((ball, "Spheres"), (floor, "Planes")):
        scene.collection.objects.unlink(thing)
        scene.collection.children[name].objects.link(thing)
    sun(scene, (46, 0, -46), 2)
    camera(scene, (1, -7, 3), (0, 0, 0.7))
    scene.view_layers[0].name = "Spheres"
    planes = scene.view_layers.new("Planes")
    render(scene)
    scene.view_layers["Spheres"].layer_collection.children["Planes"].exclude = True
    planes.layer_collection.children["Spheres"].exclude = True
    planes.use_pass_normal = planes.use_pass_position = planes.use_pass_object_index = False


def empty(scene):
    """The scene has a camera and no other objects. The whole picture is background."""
    camera(scene, (0, -5, 1))
    render(scene)
