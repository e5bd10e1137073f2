"""Cameras and shapes with the frames that flow looks into."""

from dataclasses import replace


def with_others(camera, shapes, other_camera, other_shapes):
    """The pair with another one as its next and its previous frame."""
    return (
        replace(camera, next=other_camera, previous=other_camera),
        replace(shapes, next=other_shapes, previous=other_shapes),
    )


def at_rest(camera, shapes):
    """The pair with itself as its neighbors: nothing moves."""
    return with_others(camera, shapes, camera, shapes)
