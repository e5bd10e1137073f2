"""COLMAP by pycolmap, in a process of its own: in one with bpy each library's memory is corrupted by the other."""

import pickle
import subprocess
import sys
from functools import cache


def project(model, width, height, parameters, points):
    """The pixels at which a camera sees points in its own frame."""
    import pycolmap

    return pycolmap.Camera(model=model, width=width, height=height, params=parameters).img_from_cam(points)


def read(folder):
    """The names of the models of the cameras by number, and the images by number: name, camera, camera from world."""
    import pycolmap

    model = pycolmap.Reconstruction(folder)
    cameras = {number: camera.model.name for number, camera in model.cameras.items()}
    images = {
        number: (image.name, image.camera_id, image.cam_from_world().matrix()) for number, image in model.images.items()
    }
    return cameras, images


def write(folder, kinds):
    """Write cameras of these models, as binary and as text."""
    import pycolmap

    reconstruction = pycolmap.Reconstruction()
    for number, kind in enumerate(kinds, 1):
        reconstruction.add_camera(pycolmap.Camera.create_from_model_name(number, kind, 300.125, 640, 480))
    reconstruction.write_binary(folder)
    reconstruction.write_text(folder)


def errors(folder):
    """For each point of a model: the largest distance in pixels of its track to its projections, and the length."""
    import numpy
    import pycolmap

    reconstruction = pycolmap.Reconstruction(folder)
    results = []
    for point in reconstruction.points3D.values():
        seen = [(reconstruction.images[element.image_id], element.point2D_idx) for element in point.track.elements]
        apart = [numpy.abs(image.project_point(point.xyz) - image.points2D[k].xy).max() for image, k in seen]
        results.append((max(apart), len(seen)))
    return results


def to_binary(text, folder):
    """Write a model of text as binary."""
    import pycolmap

    pycolmap.Reconstruction(text).write_binary(folder)


def seen(folder, image, points):
    """The pixels at which an image of a model sees points of the world."""
    import pycolmap

    picture = pycolmap.Reconstruction(folder).images[image]
    return [picture.project_point(point) for point in points]


@cache
def _process():
    return subprocess.Popen([sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def colmap(function, *arguments):
    """What a function of this module returns in that process, which ends with this one."""
    process = _process()
    pickle.dump((function.__name__, arguments), process.stdin)
    process.stdin.flush()
    return pickle.load(process.stdout)


def serve():
    """Answer until nobody asks any more."""
    while True:
        try:
            name, arguments = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        pickle.dump(globals()[name](*arguments), sys.stdout.buffer)
        sys.stdout.buffer.flush()


if __name__ == "__main__":
    serve()
