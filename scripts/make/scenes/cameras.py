"""Scenes that are difficult because of the camera's position or its frame."""

from __future__ import annotations

from math import cos, pi, sin

from .parts import add, camera, ico_sphere, lamp, render, square, sun, uv_sphere


def stage(scene, *, parent=None):
    """Add a floor, three spheres that make left, right, up and down distinguishable, and sunlight."""
    add(scene, "Floor", square(), scale=3, color="d9d2c6", index=1, parent=parent)
    add(scene, "Red", uv_sphere(), (-1.4, 0, 1), color="e2674a", index=2, parent=parent)
    add(scene, "Green", uv_sphere(), (1.2, 0.6, 0.6), scale=0.6, color="2a9d8f", index=3, parent=parent)
    pill = (0.6, -1.4, 0.3), (0, 0, 30), (0.5, 0.3, 0.3)
    add(scene, "Yellow", uv_sphere(), *pill, color="f0b941", index=4, parent=parent)
    sun(scene, (46, 0, -46), 2)


def portrait(scene):
    """AUTO sensor fit uses the sensor's width in a portrait frame. The camera has shift, pixels are wide, and the
    percentage truncates the resolution.
    """
    stage(scene)
    camera(scene, (1.5, -8, 3), (0, 0, 0.8), lens=40, sensor_height=20, shift_x=0.11, shift_y=-0.17)
    render(scene, 401, 533, resolution_percentage=67, pixel_aspect_x=1.25)


def vertical_fit(scene):
    """VERTICAL sensor fit uses the sensor's height in a landscape frame. The shift is measured in units of that height.
    """
    stage(scene)
    camera(
        scene, (-3, -6, 4), (0, 0, 0.6), lens=28, sensor_fit="VERTICAL", sensor_width=50, sensor_height=18, shift_x=-0.1
    )
    render(scene, 640, 359)


def orthographic(scene):
    """Orthographic rays are parallel and have no common viewpoint. The camera has shift and tall pixels, and its near
    clip plane cuts a sphere open.
    """
    stage(scene)
    camera(scene, (6, -6, 5), (0, 0, 0.5), type="ORTHO", ortho_scale=6.5, shift_x=0.05, shift_y=0.08, clip_start=8.8)
    render(scene, 500, 400, pixel_aspect_y=1.2)


def border(scene):
    """A render border without crop keeps the frame, and only a part of it is cast. The border's edges fall between
    pixels.
    """
    stage(scene)
    camera(scene, (1, -8, 2.5), (0, 0, 0.7), lens=42)
    edges = dict(border_min_x=0.2, border_max_x=0.7, border_min_y=0.15, border_max_y=0.8)
    render(scene, 630, 355, use_border=True, use_crop_to_border=False, **edges)


def sheared_and_mirrored(scene):
    """Parents with unequal scales shear the camera and the shapes. A negative scale mirrors the picture."""
    leaning = add(scene, "Leaning", None, (0, 0, 0.3), (10, 0, 35), (1.4, 0.8, 1.0))
    turned = add(scene, "Turned", None, turn=(0, 12, 20), parent=leaning)
    stage(scene, parent=turned)
    rig = add(scene, "Rig", None, (0, 0, 0), (0, 0, 0), (-1.3, 0.7, 1.1))
    camera(scene, (-3, -8, 4), (0, 0, 0.8), lens=40).parent = rig
    render(scene)


def animated(scene):
    """A constraint, a driver and keyframes move one camera. In this dolly zoom, the focal length follows the distance
    from the red sphere.
    """
    stage(scene)
    red = scene.objects["Red"]
    eye = camera(scene, (0, 0, 2.5))
    scene.frame_start, scene.frame_end = 1, 25
    for frame in range(1, 26, 4):
        share = (frame - 1) / 24
        angle, distance = pi * (share / 2 - 0.6), 4 + 8 * share
        eye.location = red.location.x + distance * cos(angle), distance * sin(angle), 2.5
        eye.keyframe_insert("location", frame=frame)
    track = eye.constraints.new("TRACK_TO")
    track.target, track.track_axis, track.up_axis = red, "TRACK_NEGATIVE_Z", "UP_Y"
    driver = eye.data.driver_add("lens").driver
    variable = driver.variables.new()
    variable.name, variable.type = "distance", "LOC_DIFF"
    variable.targets[0].id, variable.targets[1].id = eye, red
    driver.expression = "5 * distance"
    render(scene)


def inside_a_sphere(scene):
    """The camera is inside a sphere, away from its center. Every pixel shows the inside of the sphere or one of two
    smaller shapes in it.
    """
    add(scene, "Room", uv_sphere(), (0, 0, 0), scale=6, color="9fb4c7", index=1)
    add(scene, "Ball", ico_sphere(), (0.5, 2, -0.4), color="e2674a", index=2)
    add(scene, "Pill", uv_sphere(), (-1.8, 1, 0.7), (0, 40, 0), (0.4, 0.4, 1.1), color="2a9d8f", index=3)
    lamp(scene, (2, -3, 3), 1000)
    camera(scene, (0.4, -4.5, 0.3), (0, 0, 0), lens=20)
    render(scene, world="2b2d42")


def far_and_small(scene):
    """Spheres of radius 0.1 are seen at a distance of 400 units through a 5 m lens. They would be lost in single
    precision.
    """
    for k in range(5):
        location = (0.55 * (k - 2), 0.15 * k, 0.2 * sin(2.4 * k))
        add(scene, f"Ball {k}", ico_sphere(), location, scale=0.1, color=("e2674a", "2a9d8f")[k % 2], index=k + 1)
    sun(scene, (46, 0, -46), 2)
    camera(scene, (0, -400, 0), lens=5000)
    render(scene)
