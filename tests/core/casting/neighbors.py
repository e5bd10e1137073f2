"""Cameras and shapes with the motion and the frames that flow looks into."""

from camera_ray_caster.core.scene import Scene


def with_others(camera, shapes, other_camera, other_shapes):
    """The pair with another one as its next and its previous frame, beside its own motion."""
    scene, other = Scene(camera, shapes), Scene(other_camera, other_shapes)
    return pair(scene.with_timeline(scene.motion, other, other))


def at_rest(camera, shapes):
    """The pair with itself as its neighbors: nothing moves."""
    return with_others(camera, shapes, camera, shapes)


def with_motion(camera, shapes, motion):
    """The pair with a motion."""
    return pair(Scene(camera, shapes).with_timeline(motion))


def pair(scene):
    """The camera and the shapes of a scene."""
    return scene.camera, scene.shapes
